// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>

#include "lio/aligned_matcher.hpp"
#include "lio/inertial_pipeline.hpp"
#include "lio/lidar_odometry.hpp"
#include "lio/pipeline.hpp"
#include "lio/plane_measurement.hpp"

namespace nvm::config {
class Schema;
}

namespace nvm::lio {

enum class PipelineType {
  kFastLio,          ///< iterated Kalman filter, tightly coupled
  kCtLio,            ///< scan-to-map optimisation, one pose per scan, loosely coupled
  kCtLioContinuous,  ///< the same with a pose at the scan's begin and one at its end
  kLidarOnly,        ///< constant velocity, no IMU
};

/// All that a run can configure.
struct PipelineOptions {
  PipelineType type = PipelineType::kFastLio;
  int threads = 1;  ///< 1 to 256
  MapType map_type = MapType::kNvm;
  MapOptions map;
  InertialOptions inertial;
  MeasurementOptions measurement;  ///< fast_lio
  IterationOptions iteration;      ///< fast_lio
  AlignOptions align;              ///< ct_lio
  PoseObservation observation;     ///< ct_lio
  LidarOdometryOptions lidar_only;

  PipelineOptions();
};

/// Binds the keys of a run's configuration to `options`.
void bind(config::Schema& schema, PipelineOptions& options);

/// The pipeline that `options` describe. Throws std::invalid_argument for the first bad option.
std::unique_ptr<Pipeline> make_pipeline(const PipelineOptions& options);

}  // namespace nvm::lio
