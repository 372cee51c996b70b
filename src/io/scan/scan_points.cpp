// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/scan_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "common/median.hpp"
#include "io/file/file.hpp"

namespace nvm::io {
namespace {

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

template <class Member>
void read_member(
    const PointRecords& records,
    const Field* field,
    Member member,
    std::vector<TimedPoint>& points,
    double origin = 0.0) {
  using Value = std::remove_reference_t<decltype(points[0].*member)>;
  constexpr double kMax = std::numeric_limits<Value>::max();
  if (field != nullptr) {
    for_each_value(records, *field, [&](std::size_t i, double value) {
      const bool fits = std::is_floating_point_v<Value> || (value >= 0.0 && value <= kMax);
      points[i].*member = fits ? static_cast<Value>(value - origin) : Value{};
    });
  }
}

const Field& coordinate(const PointRecords& records, const char* name) {
  const Field* field = records.find({name});
  if (field == nullptr) {
    fail(records.source, std::string("has no field '") + name + "'");
  }
  return *field;
}

/// Sensors and drivers give a direction without return as NaN, or as zero.
bool is_return(const TimedPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z) &&
         (point.x != 0.0F || point.y != 0.0F || point.z != 0.0F);
}

}  // namespace

const Field* find_time_field(const PointRecords& records) {
  return records.find({"time",       "t",           "timestamp",     "offset_time",
                       "time_stamp", "time_offset", "timeoffset",    "timestamps",
                       "ts",         "stamp",       "point_time",    "pointtime",
                       "rel_time",   "dt",          "relative_time", "delta_time",
                       "time_us",    "time_ns",     "t_offset",      "gps_time",
                       "GpsTime",    "Time",        "Timestamp",     "TimeStamp",
                       "time_sec",   "toffset",     "offset",        "timestamp_offset"});
}

TickType tick_type(const Field& field) {
  TickType type;
  type.is_whole = is_integer(field.type);
  if (field.type == ScalarType::kUint16 || field.type == ScalarType::kUint32) {
    type.modulus = std::exp2(8.0 * static_cast<double>(size_of(field.type)));
  }
  type.resolution = field.type == ScalarType::kFloat32 ? std::exp2(-23.0) : 0.0;
  return type;
}

std::array<double, 3> map_origin(const PointRecords& records) {
  constexpr double kFar = 1e4;  // [m]: beyond the range of any sensor
  std::array<double, 3> origin{};
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    std::vector<double> values = read_column(records, coordinate(records, kAxes[axis]));
    const auto is_nothing = [](double value) { return !std::isfinite(value) || value == 0.0; };
    values.erase(std::remove_if(values.begin(), values.end(), is_nothing), values.end());
    if (!values.empty()) {
      const double middle = median(std::move(values));
      origin[axis] = std::abs(middle) > kFar ? std::round(middle) : 0.0;
    }
  }
  return origin;
}

std::vector<TimedPoint> read_scan_points(
    const PointRecords& records, const std::array<double, 3>& origin) {
  constexpr double kFloatSteps = 1.2e-7;  // of a float32, relative
  constexpr double kMaxStep = 0.02;       // [m]
  constexpr std::array<float TimedPoint::*, 3> kMembers = {
      &TimedPoint::x, &TimedPoint::y, &TimedPoint::z};
  std::vector<TimedPoint> points(records.size);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const Field& field = coordinate(records, kAxes[axis]);
    const double step = kFloatSteps * std::abs(origin[axis]);
    if (field.type == ScalarType::kFloat32 && step > kMaxStep) {
      fail(
          records.source,
          std::string("coordinates ") + kAxes[axis] + " near " + std::to_string(origin[axis]) +
              " m are float32, which has steps of " + std::to_string(step) +
              " m there: scans must be in the frame of the LiDAR, or map coordinates in float64");
    }
    read_member(records, &field, kMembers[axis], points, origin[axis]);
  }
  read_member(records, records.find({"intensity", "reflectivity"}), &TimedPoint::intensity, points);
  read_member(records, records.find({"ring", "line", "channel"}), &TimedPoint::ring, points);
  return points;
}

std::vector<double> read_column(const PointRecords& records, const Field& field) {
  std::vector<double> values(records.size);
  for_each_value(records, field, [&](std::size_t i, double value) { values[i] = value; });
  return values;
}

void drop_no_returns(std::vector<TimedPoint>& points, std::vector<double>& ticks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_return(points[i]) && (ticks.empty() || std::isfinite(ticks[i]))) {
      points[kept] = points[i];
      if (!ticks.empty()) {
        ticks[kept] = ticks[i];
      }
      ++kept;
    }
  }
  points.resize(kept);
  ticks.resize(std::min(kept, ticks.size()));
}

void sort_by_time(std::vector<TimedPoint>& points) {
  const auto is_earlier = [](const TimedPoint& a, const TimedPoint& b) { return a.dt < b.dt; };
  if (!std::is_sorted(points.begin(), points.end(), is_earlier)) {
    std::stable_sort(points.begin(), points.end(), is_earlier);
  }
}

}  // namespace nvm::io
