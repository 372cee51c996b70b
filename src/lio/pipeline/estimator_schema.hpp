// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "config/schema.hpp"
#include "lio/pipeline/pipeline_options.hpp"

namespace nvm::lio {

/// What most options of the pipelines allow.
constexpr config::Range kShare{0.0, 1.0};
constexpr config::Range kPositive{1e-12, 1e12};
constexpr config::Range kNotNegative{0.0, 1e12};

/// The keys of the iterated Kalman filter, of the scan-to-map optimisation, and of the odometry
/// without an IMU: the sections fast_lio, ct_lio and lidar_only.
void bind_filter(config::Schema& schema, PipelineOptions& options);
void bind_optimization(config::Schema& schema, PipelineOptions& options);
void bind_lidar_only(config::Schema& schema, LidarOdometryOptions& lidar_only);

}  // namespace nvm::lio
