// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/prior_pipeline.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lio/has_planes.hpp"

namespace nvm::lio {

namespace {

std::unique_ptr<LioMap> usable(const PipelineOptions& options, VoxelMap prior, bool extends) {
  if (options.map_type != MapType::kNvm) {
    throw std::invalid_argument("a prior map needs map.type=nvm");
  }
  if (!has_planes(prior)) {
    throw std::invalid_argument(
        prior.empty() ? "the prior map has no points"
                      : "the points of the prior map have no normals: make it with map.type=nvm");
  }
  return continued_map(std::move(prior), !extends);
}

}  // namespace

PriorPipeline::PriorPipeline(
    const PipelineOptions& options, VoxelMap prior, const std::optional<Start>& start, bool extends)
    : start_(start),
      returns_(options.inertial.returns),
      executor_(options.threads),
      normal_estimator_(options.inertial.normals),
      pipeline_(make_pipeline(options, usable(options, std::move(prior), extends))),
      search_(*pipeline_->map().voxel_map(), executor_) {
  body_.T_body_lidar = options.inertial.T_imu_lidar;
}

void PriorPipeline::add_imu(const ImuSample& sample) {
  constexpr double kMemory = 0.5;  // [s]
  if (!is_placed_ && sample.accel.allFinite()) {
    const double age = force_ ? sample.time - force_time_ : 0.0;
    const double weight = force_ ? -std::expm1(-std::max(age, 0.0) / kMemory) : 1.0;
    force_ = (1.0 - weight) * force_.value_or(sample.accel) + weight * sample.accel;
    force_time_ = sample.time;
  }
  pipeline_->add_imu(sample);
}

FrameResult PriorPipeline::process(const Scan& scan) {
  if (is_placed_) {
    return pipeline_->process(scan);
  }
  FrameResult result;
  result.time = scan.t_end;
  if (!is_to_search(scan.t_end)) {
    result.message = "not found in the prior map yet";
    return result;
  }
  const Place place = find(scan);
  if (!place.is_found()) {
    result.message = "not found in the prior map: " + place.why_not;
    return result;
  }
  start_at(place.T_map_scan * body_.T_body_lidar.inverse());
  pipeline_->start_at(start_->T_map_body);
  result = pipeline_->process(scan);
  is_placed_ =
      result.status != FrameStatus::kInitializing && result.status != FrameStatus::kSkipped;
  return result;
}

// A search of the whole map takes the time of many scans: the longer it fails the rarer it is.
bool PriorPipeline::is_to_search(double time) {
  constexpr double kPatience = 0.1;  // of the time since the first try
  first_try_ = first_try_.value_or(time);
  if (!start_ && time < next_try_) {
    return false;
  }
  next_try_ = time + kPatience * (time - *first_try_);
  return true;
}

Place PriorPipeline::find(const Scan& scan) {
  deskew(scan, {{scan.t_end, Pose::Identity()}}, body_, returns_, scan_);
  const std::vector<Eigen::Vector3f>& normals =
      normal_estimator_.estimate(scan_.points, scan_.viewpoints, executor_).normals;
  if (start_) {
    return search_.near(scan_.points, normals, guess() * body_.T_body_lidar);
  }
  const Eigen::Vector3d up = (level() * body_.T_body_lidar.linear()).row(2);
  return search_.anywhere(scan_.points, normals, up);
}

// At rest the specific force points up. The heading is kept: that of the body's x axis.
Eigen::Matrix3d PriorPipeline::level() const {
  constexpr double kSteep = 0.1;
  if (!force_) {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::Matrix3d level =
      Eigen::Quaterniond::FromTwoVectors(*force_, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d ahead = level.col(0);
  const bool has_heading = ahead.head<2>().norm() > kSteep;
  const double heading = has_heading ? std::atan2(ahead.y(), ahead.x()) : 0.0;
  return so3_exp({0.0, 0.0, -heading}) * level;
}

Pose PriorPipeline::guess() const {
  Pose guess = start_->T_map_body;
  if (start_->is_upright) {
    guess.linear() *= level();
  }
  return guess;
}

}  // namespace nvm::lio
