// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "common/sensor_data.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "lio/state/error_state_filter.hpp"
#include "lio/state/nav_state.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// Covariance of the body's pose, as FrameResult has it, that an alignment's residuals give.
/// Directions that the scan does not tell get 100 m^2 and rad^2: far more than a step can be wrong.
Covariance6 covariance_of(const AlignResult& aligned, const Pose& T_body_lidar);

/// Sets the velocities of `result` to those of `predicted`, whose gyroscope reads zero, and the
/// covariances of its motion in the `duration` [s] since the last believed pose. A pose without a
/// covariance of its own is the prediction.
void describe_prediction(const NavState& predicted, double duration, FrameResult& result);

/// Sets the velocities and covariances of `result` to the filter's; `last` is the last reading of
/// the IMU, if there was one.
void describe_motion(const ErrorStateFilter& filter, const ImuSample* last, FrameResult& result);

}  // namespace nvm::lio
