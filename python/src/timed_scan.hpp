// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>

#include <vector>

#include "common/sensor_data.hpp"

namespace nvm::python {

/// The finite points of a scan by ascending time. `times` is an array of one time per point, or a
/// number for all. Without a `begin` they are absolute [s]; with one they count from it [s], are
/// kept as they are, and the scan ends at `end`, by default with its last point. `intensity` is an
/// array, or None. Throws ValueError
/// for other shapes, for times before `begin` or after `end`, over more than 10 s, and for absolute
/// ones in float32, which lost their digits.
Scan timed_scan(
    nanobind::handle points,
    nanobind::handle times,
    nanobind::handle begin,
    nanobind::handle end,
    nanobind::handle intensity);

/// Readings of an IMU: a time, (3,) and (3,), or arrays (N,), (N, 3) and (N, 3). Throws ValueError
/// for other shapes and for numbers that are not finite.
std::vector<ImuSample> imu_samples(
    nanobind::handle times, nanobind::handle gyro, nanobind::handle accel);

}  // namespace nvm::python
