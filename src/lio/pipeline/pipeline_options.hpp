// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>

#include "lio/match/plane_measurement.hpp"
#include "lio/match/pose_observation.hpp"
#include "lio/pipeline/inertial_pipeline.hpp"
#include "lio/pipeline/lidar_odometry_options.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::config {
class Schema;
}

namespace nvm::lio {

enum class PipelineType {
  kAutomatic,        ///< fast_lio with an IMU, lidar_only without; see resolve()
  kFastLio,          ///< iterated Kalman filter, tightly coupled
  kCtLio,            ///< scan-to-map optimisation, one pose per scan
  kCtLioContinuous,  ///< the same with a pose at the scan's begin and one at its end
  kLidarOnly,        ///< constant velocity, no IMU
};

/// How a scan-to-map optimisation and the IMU come together.
enum class Coupling {
  kTight,  ///< the IMU's prediction is part of the optimisation
  kLoose,  ///< the filter takes the optimised pose as an observation, as in CT-LIO
};

/// All that a run can configure.
struct PipelineOptions {
  PipelineType type = PipelineType::kAutomatic;
  int threads = 1;  ///< 1 to 256
  MapType map_type = MapType::kNvm;
  MapOptions map;
  InertialOptions inertial;
  MeasurementOptions measurement;        ///< fast_lio
  IterationOptions iteration;            ///< fast_lio
  AlignOptions align;                    ///< ct_lio
  Coupling coupling = Coupling::kTight;  ///< ct_lio
  /// Tightly coupled: of a point from its plane [m], positive.
  double residual_deviation = 0.01;
  PoseObservation observation;  ///< loosely coupled
  /// Its own part only: what it shares with the inertial pipelines comes from `inertial`.
  LidarOdometryOptions lidar_only;

  PipelineOptions();
};

/// Binds the keys of a run's configuration to `options`.
void bind(config::Schema& schema, PipelineOptions& options);

/// `type` for a sequence with or without an IMU. Throws std::invalid_argument when it needs the IMU
/// that there is not.
PipelineType resolve(PipelineType type, bool has_imu);

/// The pipeline that `options` describe, whose type is resolved. Throws std::invalid_argument for
/// the first bad option.
std::unique_ptr<Pipeline> make_pipeline(const PipelineOptions& options);

/// The same on a map of its own, which may be one that others have begun (see Pipeline::start_at);
/// what `options` say of the map is ignored.
std::unique_ptr<Pipeline> make_pipeline(
    const PipelineOptions& options, std::unique_ptr<LioMap> map);

}  // namespace nvm::lio
