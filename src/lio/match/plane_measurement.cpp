// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/plane_measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "nvm/core/require.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

constexpr std::size_t kGrain = 256;

}  // namespace

PlaneMeasurement::PlaneMeasurement(const MeasurementOptions& options, const Executor& executor)
    : options_(options), executor_(executor) {
  options.validate();
}

void PlaneMeasurement::start(
    const DeskewedScan& scan,
    const std::vector<Eigen::Vector3f>& normals,
    const std::vector<std::uint32_t>& chosen,
    const NavState& predicted) {
  predicted_ = predicted;
  mean_range_ = 0.0;
  residuals_.resize(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::uint32_t index = chosen[i];
    PlaneResidual& r = residuals_[i];
    r.p_lidar = scan.points[index].cast<double>();
    r.n_lidar = normals[index];
    r.age = scan.ages[index];
    r.beam = scan.points[index] - scan.viewpoints[index];
    r.range = r.beam.norm();
    r.beam /= r.range;
    r.valid = false;
    mean_range_ += static_cast<double>(r.range) / static_cast<double>(chosen.size());
  }
}

Eigen::Vector3d PlaneMeasurement::world_point(const NavState& state, const PlaneResidual& r) const {
  const auto age = static_cast<double>(r.age);
  const Eigen::Vector3d q = state.T_body_lidar * r.p_lidar;
  const Eigen::Vector3d unturned = q + age * (state.gyro_bias - predicted_.gyro_bias).cross(q);
  // The scan was sheared by the predicted velocity as seen from the predicted attitude.
  const Eigen::Vector3d v0_body =
      predicted_.T_world_body.linear().transpose() * predicted_.velocity;
  return state.T_world_body * (unturned + age * v0_body) - age * state.velocity;
}

double PlaneMeasurement::variance(const NavState& state, const PlaneResidual& r) const {
  const Eigen::Vector3d n_lidar = state.T_world_lidar().linear().transpose() * r.plane_normal;
  const double cosine = n_lidar.dot(r.beam.cast<double>());
  const double along = options_.range_deviation * cosine;
  const double across = options_.beam_deviation * static_cast<double>(r.range);
  return along * along + across * across * (1.0 - cosine * cosine) + r.plane_variance;
}

void PlaneMeasurement::associate(const LioMap& map, const NavState& state) {
  contexts_.resize(std::max(contexts_.size(), residuals_.size() / kGrain + 1));
  executor_.for_blocks(residuals_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    LioMap::QueryContext& context = contexts_[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      associate_one(map, state, context, residuals_[i]);
    }
  });
}

void PlaneMeasurement::associate_one(
    const LioMap& map,
    const NavState& state,
    LioMap::QueryContext& context,
    PlaneResidual& r) const {
  r.valid = false;
  const Eigen::Vector3d point = world_point(state, r);
  const Eigen::Vector3f n_map = state.T_world_lidar().linear().cast<float>() * r.n_lidar;
  std::array<Neighbor, kMaxNeighbors> found;
  const std::size_t count = map.nearest(
      point, n_map, {options_.neighbors, options_.max_neighbor_distance}, found.data(), context);
  if (count < options_.min_neighbors) {
    return;
  }
  const std::optional<Plane> plane = fit_plane(found.data(), count);
  if (!plane || !belongs(*plane, n_map)) {
    return;
  }
  const Eigen::Vector3d offset = point - plane->centroid;
  if (std::abs(plane->normal.dot(offset)) > options_.max_plane_distance) {
    return;
  }
  // Variance of a least-squares plane at a place off its centroid, from its residual scatter.
  const double along = (offset - plane->normal.dot(offset) * plane->normal).squaredNorm();
  const double lever = 1.0 + along / (plane->deviation[1] * plane->deviation[1]);
  const double scatter = plane->deviation[0] * plane->deviation[0] / static_cast<double>(count - 2);
  r.plane_normal = plane->normal;
  r.plane_offset = plane->normal.dot(plane->centroid);
  r.plane_variance = scatter * lever;
  r.planarity = plane->planarity;
  r.valid = true;
}

/// Whether `plane` is one that a keypoint with this normal or sighting [map frame] can lie on.
bool PlaneMeasurement::belongs(const Plane& plane, const Eigen::Vector3f& n_map) const {
  if (is_sighting(n_map)) {
    return options_.sighting.accept(plane, n_map);
  }
  return plane.deviation[0] <= options_.max_plane_deviation &&
         plane.planarity >= options_.min_planarity &&
         std::abs(plane.normal.dot(n_map.cast<double>())) >= std::cos(options_.max_normal_angle);
}

bool PlaneMeasurement::linearize(const NavState& state, Information& out) {
  evaluated_ = state;
  const std::size_t blocks = (residuals_.size() + kGrain - 1) / kGrain;
  block_information_.assign(blocks, Information{});
  executor_.for_blocks(residuals_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    add_block(state, begin, end, block_information_[begin / kGrain]);
  });
  std::size_t count = 0;
  for (const PlaneResidual& r : residuals_) {
    count += r.valid ? 1 : 0;
  }
  for (const Information& block : block_information_) {
    out.matrix += block.matrix;
    out.vector += block.vector;
  }
  return count >= options_.min_residuals;
}

void PlaneMeasurement::add_block(
    const NavState& state, std::size_t begin, std::size_t end, Information& out) {
  const Eigen::Matrix3d R = state.T_world_body.linear();
  const Eigen::Vector3d v_body = predicted_.T_world_body.linear().transpose() * predicted_.velocity;
  for (std::size_t i = begin; i < end; ++i) {
    PlaneResidual& r = residuals_[i];
    if (!r.valid) {
      continue;
    }
    r.distance = r.plane_normal.dot(world_point(state, r)) - r.plane_offset;
    const auto age = static_cast<double>(r.age);
    const Eigen::Vector3d n_body = R.transpose() * r.plane_normal;
    const Eigen::Vector3d n_lidar = state.T_body_lidar.linear().transpose() * n_body;
    const Eigen::Vector3d q = state.T_body_lidar * r.p_lidar;
    MeasuredVector h;
    h.segment<3>(kPosition) = r.plane_normal;
    h.segment<3>(kRotation) = (q + age * v_body).cross(n_body);
    h.segment<3>(kVelocity) = -age * r.plane_normal;
    h.segment<3>(kGyroBias) = age * q.cross(n_body);
    h.segment<3>(kLidarPosition) = n_body;
    h.segment<3>(kLidarRotation) = r.p_lidar.cross(n_lidar);
    const double sigma = std::sqrt(variance(state, r));
    const double excess = std::abs(r.distance) / (options_.huber * sigma);
    const double weight = (excess > 1.0 ? 1.0 / excess : 1.0) /
                          (sigma * sigma * options_.correlation) * r.planarity * r.planarity;
    out.matrix.selfadjointView<Eigen::Lower>().rankUpdate(h, weight);
    out.vector += (weight * r.distance) * h;
  }
  out.matrix = out.matrix.selfadjointView<Eigen::Lower>().toDenseMatrix().eval();
}

FitSummary PlaneMeasurement::summary() const {
  FitSummary fit;
  std::size_t inliers = 0;
  double sq_sum = 0.0;
  for (const PlaneResidual& r : residuals_) {
    fit.keypoints += r.valid || !is_sighting(r.n_lidar) ? 1 : 0;
    if (!r.valid) {
      continue;
    }
    ++fit.residuals;
    if (r.distance * r.distance < 9.0 * variance(evaluated_, r)) {
      ++inliers;
      sq_sum += r.distance * r.distance;
    }
  }
  if (inliers > 0) {
    fit.inlier_share = static_cast<double>(inliers) / static_cast<double>(fit.keypoints);
    fit.residual_share = static_cast<double>(inliers) / static_cast<double>(fit.residuals);
    fit.rms = std::sqrt(sq_sum / static_cast<double>(inliers));
  }
  return fit;
}

void MeasurementOptions::validate() const {
  require(neighbors >= 3 && neighbors <= kMaxNeighbors, "neighbors", neighbors, "3 to 64");
  require(
      min_neighbors >= 3 && min_neighbors <= neighbors,
      "min_neighbors",
      min_neighbors,
      "3 to neighbors");
  const auto positive = [](double value, const char* name) {
    require(value > 0.0 && std::isfinite(value), name, value, "positive");
  };
  positive(max_neighbor_distance, "max_neighbor_distance");
  positive(max_plane_distance, "max_plane_distance");
  positive(max_plane_deviation, "max_plane_deviation");
  positive(max_normal_angle, "max_normal_angle");
  require(min_planarity >= 0.0 && min_planarity < 1.0, "min_planarity", min_planarity, "0 to 1");
  positive(range_deviation, "range_deviation");
  positive(beam_deviation, "beam_deviation");
  positive(huber, "huber");
  require(correlation >= 1.0, "correlation", correlation, "1 or more");
  require(
      min_observability >= 0.0 && min_observability < 1.0,
      "min_observability",
      min_observability,
      "0 to 1");
  require(min_residuals >= 6, "min_residuals", min_residuals, "6 or more");
}

}  // namespace nvm::lio
