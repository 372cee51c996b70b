// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <vector>

#include "common/sensor_data.hpp"
#include "io/cloud/point_records.hpp"
#include "io/scan/point_times.hpp"

namespace nvm::io {

/// The field with the points' times, by one of the names in use; nullptr without.
const Field* find_time_field(const PointRecords& records);

/// How the times in `field` are stored.
TickType tick_type(const Field& field);

/// Where the points lie, to the metre, when that is too far from zero for a sensor's view: they are
/// in a map's coordinates. Else zero.
std::array<double, 3> map_origin(const PointRecords& records);

/// All points: x y z less `origin` [m]; intensity (or reflectivity); ring (or line, channel).
/// Throws std::runtime_error, naming the source, without x y z, and for float32 coordinates that
/// are too large for a sensor's accuracy.
std::vector<TimedPoint> read_scan_points(
    const PointRecords& records, const std::array<double, 3>& origin);

/// The first value of `field` in each record.
std::vector<double> read_column(const PointRecords& records, const Field& field);

/// Drops the points without a position, or a finite tick; `ticks` is empty or as long as they are.
void drop_no_returns(std::vector<TimedPoint>& points, std::vector<double>& ticks);

void sort_by_time(std::vector<TimedPoint>& points);

}  // namespace nvm::io
