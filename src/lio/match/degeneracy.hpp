// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "lio/match/unobserved_directions.hpp"
#include "lio/state/error_state_filter.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::lio {

/// Takes out of `information` the directions of the pose that the scan hardly tells, so that the
/// update leaves them to the IMU (solution remapping: Zhang, Kaess and Singh, ICRA 2016): in a
/// corridor, noise in the normals would else pass for knowledge of the position along it. The same
/// directions of the velocity and the gyro bias go too: a sweep tells them by the same planes.
///
/// A direction counts as unobserved when its share of the information, with rotations measured by
/// the arc [m] that they make at `mean_range` [m], is below `min_observability` (0: none of it, 1:
/// every residual). Returns those removed.
UnobservedDirections remove_unobserved(
    Information& information, double mean_range, double min_observability);

/// The `count` (0 to 6) directions that an alignment of points at `mean_range` [m] tells least of;
/// `R_body_scan` is the extrinsic's rotation.
UnobservedDirections faintest_directions(
    const AlignResult& aligned, int count, double mean_range, const Eigen::Matrix3d& R_body_scan);

/// The directions along which an alignment of points at `mean_range` [m] has kept its guess;
/// `R_body_scan` is the extrinsic's rotation.
UnobservedDirections unobserved_by(
    const AlignResult& aligned, double mean_range, const Eigen::Matrix3d& R_body_scan);

}  // namespace nvm::lio
