// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/host_shapes/host_odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "nvm/registration/plane.hpp"

namespace nvm::test {
namespace {

constexpr double kMaxGap = 0.05;  // [s]
// What the hosts' gyr_cov = acc_cov = 0.1 and their bias covariances of 1e-4 are at 200 Hz.
constexpr lio::ImuNoise kHostNoise{0.022, 0.022, 7e-4, 7e-4};
constexpr double kPointVariance = 0.001;  // [m^2]

using Cube = std::array<int, 3>;

Cube cube_of(const Eigen::Vector3d& point, double size) {
  const Eigen::Vector3i index = (point / size).array().floor().cast<int>();
  return {index.x(), index.y(), index.z()};
}

/// One point for each cube: the centroid, or the first as it is.
HostPoints one_per_cube(const HostPoints& points, double size, bool centroid) {
  std::map<Cube, std::vector<std::size_t>> cubes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cubes[cube_of(position(points[i]), size)].push_back(i);
  }
  HostPoints kept;
  for (const auto& [cube, indices] : cubes) {
    kept.push_back(points[indices[0]]);
    if (centroid) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const std::size_t i : indices) {
        sum += position(points[i]);
      }
      adapters::set_position(kept.back(), sum / static_cast<double>(indices.size()));
    }
  }
  return kept;
}

std::optional<Plane> plane_through(const HostPoints& points, double max_distance) {
  std::vector<Neighbor> neighbors(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    neighbors[i].position = position(points[i]);
  }
  const std::optional<Plane> plane = fit_plane(neighbors.data(), neighbors.size());
  const auto is_off = [&](const Neighbor& n) {
    return std::abs(plane->normal.dot(n.position - plane->centroid)) > max_distance;
  };
  if (!plane || std::any_of(neighbors.begin(), neighbors.end(), is_off)) {
    return std::nullopt;
  }
  return plane;
}

}  // namespace

HostShape shape_of(HostFamily family) {
  HostShape shape;
  shape.family = family;
  if (family == HostFamily::kFasterLio) {
    shape.min_neighbors = 3;
  } else if (family == HostFamily::kCtLio) {
    shape.filter_size = 0.2;
    shape.neighbors = 20;
    shape.min_neighbors = 20;
    shape.max_from_plane = 1e3;
  }
  return shape;
}

HostOdometry::HostOdometry(const HostShape& shape, HostMapKind kind, const Pose& T_imu_lidar)
    : shape_(shape),
      T_imu_lidar_(T_imu_lidar),
      map_(make_host_map(shape.family, kind)),
      kind_(kind) {
  map_->start(shape.filter_size);
}

std::optional<Pose> HostOdometry::process(const Scan& scan) {
  if (!filter_ && !initialize(scan.t_end)) {
    return std::nullopt;
  }
  predict(scan);
  thin();
  nearest_.assign(keypoints_.size(), {});
  if (is_built_) {
    shape_.family == HostFamily::kCtLio ? update_loosely() : update();
  }
  extend_map();
  return filter_->state().T_world_body;
}

bool HostOdometry::initialize(double until) {
  std::vector<ImuSample> samples;
  imu_.between(initialized_until_, until, 0.0, samples);
  for (const ImuSample& sample : samples) {
    if (sample.time > initialized_until_) {
      initializer_.add(sample);
      initialized_until_ = sample.time;
    }
  }
  if (auto initial = initializer_.state()) {
    initial->state.T_body_lidar = T_imu_lidar_;
    filter_.emplace(initial->state, initial->covariance, kHostNoise);
  }
  return filter_.has_value();
}

void HostOdometry::predict(const Scan& scan) {
  std::vector<ImuSample> samples;
  std::vector<lio::MotionSegment> segments;
  imu_.between(filter_->state().time, scan.t_end, kMaxGap, samples);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].time > filter_->state().time) {
      segments.push_back(filter_->predict(samples[i - 1], samples[i]));
    }
  }
  if (segments.empty()) {
    segments.push_back(filter_->coast(scan.t_end, Eigen::Vector3d::Zero()));
  }
  imu_.use_until(scan.t_end);
  Scan kept{scan.t_begin, scan.t_end, {}};
  for (std::size_t i = 0; i < scan.points.size(); i += shape_.keep_every) {
    kept.points.push_back(scan.points[i]);
  }
  deskew(kept, segments, filter_->state(), {0.5, 100.0, kept.points.size() + 1}, scan_);
}

void HostOdometry::thin() {
  constexpr double kFrameSpacing = 0.05;  // ct-lio's [m]
  HostPoints full;
  for (const Eigen::Vector3f& point : scan_.points) {
    full.push_back(host_point(point.cast<double>()));
  }
  const bool loose = shape_.family == HostFamily::kCtLio;
  frame_ = one_per_cube(full, loose ? kFrameSpacing : shape_.filter_size, !loose);
  if (kind_ == HostMapKind::kPatchB) {
    normals_.write(frame_, full);
  }
  keypoints_ = loose ? one_per_cube(frame_, shape_.filter_size, false) : frame_;
}

HostPoint HostOdometry::to_map(const HostPoint& point, const lio::NavState& state) const {
  const Pose T = state.T_world_lidar();
  HostPoint placed = host_point(T * position(point));
  adapters::rotate_normal(T.linear(), point, placed);
  return placed;
}

bool HostOdometry::linearize(const lio::NavState& state, bool is_new, lio::Information& out) {
  if (is_new) {
    associate(state);
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < keypoints_.size(); ++i) {
    const Residual& r = residuals_[i];
    if (r.weight == 0.0) {
      continue;
    }
    ++count;
    const Eigen::Vector3d p_body = state.T_body_lidar * position(keypoints_[i]);
    lio::MeasuredVector h = lio::MeasuredVector::Zero();
    h.segment<3>(lio::kPosition) = r.normal;
    h.segment<3>(lio::kRotation) = p_body.cross(state.T_world_body.linear().transpose() * r.normal);
    const double distance = r.normal.dot(state.T_world_body * p_body) - r.offset;
    out.matrix += r.weight * h * h.transpose();
    out.vector += r.weight * distance * h;
  }
  return count > 0;
}

void HostOdometry::associate(const lio::NavState& state) {
  residuals_.assign(keypoints_.size(), {});
  for (std::size_t i = 0; i < keypoints_.size(); ++i) {
    const HostPoint placed = to_map(keypoints_[i], state);
    map_->search(placed, shape_.neighbors, nearest_[i]);
    if (nearest_[i].size() >= shape_.min_neighbors) {
      residuals_[i] = residual_of(keypoints_[i], placed, nearest_[i]);
    }
  }
}

HostOdometry::Residual HostOdometry::residual_of(
    const HostPoint& point, const HostPoint& placed, const HostPoints& near) const {
  const std::optional<Plane> plane = plane_through(near, shape_.max_from_plane);
  if (!plane) {
    return {};
  }
  const double offset = plane->normal.dot(plane->centroid);
  const double distance = std::abs(plane->normal.dot(position(placed)) - offset);
  if (shape_.family == HostFamily::kCtLio) {
    constexpr double kMaxDistance = 0.3, kPlanarityShare = 0.9;
    const double nearness =
        std::exp(-(position(near[0]) - position(placed)).norm() / (kMaxDistance * 20.0));
    const double weight =
        kPlanarityShare * plane->planarity * plane->planarity + (1.0 - kPlanarityShare) * nearness;
    return {
        plane->normal, offset, distance < kMaxDistance ? weight * weight / kPointVariance : 0.0};
  }
  const double range = position(point).norm();
  const bool fits = 0.9 * distance < 0.1 * std::sqrt(range);
  return {plane->normal, offset, fits ? 1.0 / kPointVariance : 0.0};
}

void HostOdometry::update() {
  constexpr lio::IterationOptions kIteration{4, 1e-3, 1e-3};
  filter_->update(
      [this](const lio::NavState& state, bool is_new, lio::Information& out) {
        return linearize(state, is_new, out);
      },
      kIteration);
}

// Gauss-Newton on the pose alone, which the filter takes as a measurement.
void HostOdometry::update_loosely() {
  constexpr int kIterations = 8;
  constexpr double kPoseVariance = 1e-2;
  lio::NavState state = filter_->state();
  for (int i = 0; i < kIterations; ++i) {
    lio::Information information;
    if (!linearize(state, true, information)) {
      return;
    }
    lio::NavVector step = lio::NavVector::Zero();
    step.head<6>() =
        -information.matrix.topLeftCorner<6, 6>().ldlt().solve(information.vector.head<6>());
    state = boxplus(state, step);
    if (step.head<6>().norm() < 1e-4) {
      break;
    }
  }
  filter_->observe_pose(
      state.T_world_body, kPoseVariance * Eigen::Matrix<double, 6, 6>::Identity());
}

void HostOdometry::extend_map() {
  const lio::NavState& state = filter_->state();
  HostPoints crowded, alone;
  for (std::size_t i = 0; i < frame_.size(); ++i) {
    const HostPoint placed = to_map(frame_[i], state);
    switch (shape_.family == HostFamily::kCtLio ? Place::kCrowded : place(placed, nearest_[i])) {
      case Place::kCrowded:
        crowded.push_back(placed);
        break;
      case Place::kAlone:
        alone.push_back(placed);
        break;
      case Place::kNone:
        break;
    }
  }
  if (is_built_) {
    map_->add(crowded, alone);
  } else if (crowded.size() > 5) {
    map_->build(crowded);
    is_built_ = true;
  }
}

HostOdometry::Place HostOdometry::place(const HostPoint& placed, const HostPoints& near) const {
  if (near.empty()) {
    return Place::kCrowded;
  }
  const double size = shape_.filter_size;
  const Eigen::Vector3d center = ((position(placed) / size).array().floor() + 0.5) * size;
  if ((position(near[0]) - center).cwiseAbs().minCoeff() > 0.5 * size) {
    return Place::kAlone;
  }
  const double distance = (position(placed) - center).norm();
  const bool is_taken =
      near.size() >= 5 && std::any_of(near.begin(), near.end(), [&](const HostPoint& p) {
        return (position(p) - center).norm() < distance;
      });
  return is_taken ? Place::kNone : Place::kCrowded;
}

}  // namespace nvm::test
