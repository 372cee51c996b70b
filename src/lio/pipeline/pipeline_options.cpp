// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/pipeline_options.hpp"

#include <stdexcept>

#include "lio/match/aligned_matcher.hpp"
#include "lio/match/continuous_matcher.hpp"
#include "lio/match/coupled_matcher.hpp"
#include "lio/match/filter_matcher.hpp"
#include "lio/pipeline/lidar_odometry.hpp"

namespace nvm::lio {

namespace {

std::unique_ptr<ScanMatcher> make_matcher(
    const PipelineOptions& options, const Executor& executor) {
  switch (options.type) {
    case PipelineType::kCtLio:
      if (options.coupling == Coupling::kTight) {
        return std::make_unique<CoupledMatcher>(
            options.align, options.residual_deviation, executor);
      }
      return std::make_unique<AlignedMatcher>(options.align, options.observation, executor);
    case PipelineType::kCtLioContinuous:
      return std::make_unique<ContinuousMatcher>(
          options.align, options.residual_deviation, executor);
    default:
      return std::make_unique<FilterMatcher>(options.measurement, options.iteration, executor);
  }
}

LidarOdometryOptions lidar_only_options(const PipelineOptions& options) {
  LidarOdometryOptions lidar_only = options.lidar_only;
  const InertialOptions& shared = options.inertial;
  lidar_only.returns = shared.returns;
  lidar_only.normals = shared.normals;
  lidar_only.keypoints = shared.keypoints;
  lidar_only.min_inlier_share = shared.min_inlier_share;
  lidar_only.T_body_lidar = shared.T_imu_lidar;
  return lidar_only;
}

}  // namespace

PipelineOptions::PipelineOptions() {
  map.min_point_distance = 0.07;
  map.points_per_surface = 30;
  map.max_merged_points = 8;
  map.columns.intensity = true;
  inertial.imu_noise.gyro = 0.0;  // to be learned
  inertial.imu_noise.accel = 0.0;
  inertial.normals.min_range = inertial.returns.min_range;
  inertial.normals.max_range = inertial.returns.max_range;
  inertial.normals.widening = 2.0;
  align.max_iterations = 10;
  align.converged_translation = 2e-4;
  align.converged_rotation = 5e-5;
  lidar_only.align = align;  // without an IMU predictions are farther off
  align.association.neighbors = 8;
  align.association.max_neighbor_distance = 0.6;
  align.kernel.scale = 0.02;
}

PipelineType resolve(PipelineType type, bool has_imu) {
  if (type == PipelineType::kAutomatic) {
    return has_imu ? PipelineType::kFastLio : PipelineType::kLidarOnly;
  }
  if (!has_imu && type != PipelineType::kLidarOnly) {
    throw std::invalid_argument("this pipeline needs an IMU: without one, set pipeline=lidar_only");
  }
  return type;
}

std::unique_ptr<Pipeline> make_pipeline(const PipelineOptions& options) {
  return make_pipeline(options, make_map(options.map_type, options.map));
}

std::unique_ptr<Pipeline> make_pipeline(
    const PipelineOptions& options, std::unique_ptr<LioMap> map) {
  const Executor executor(options.threads);
  if (options.type == PipelineType::kLidarOnly) {
    return std::make_unique<LidarOdometry>(lidar_only_options(options), std::move(map), executor);
  }
  LidarOdometryOptions alone = lidar_only_options(options);
  alone.max_weak_duration = options.inertial.max_weak_duration;
  return std::make_unique<InertialPipeline>(
      options.inertial, make_matcher(options, executor), alone, std::move(map), executor);
}

}  // namespace nvm::lio
