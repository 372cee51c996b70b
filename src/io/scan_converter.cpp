// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan_converter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/file.hpp"

namespace nvm::io {
namespace {

double seconds_per_tick(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kMillisecond:
      return 1e-3;
    case TimeUnit::kMicrosecond:
      return 1e-6;
    case TimeUnit::kNanosecond:
      return 1e-9;
    case TimeUnit::kSecond:
    case TimeUnit::kAutomatic:
      break;
  }
  return 1.0;
}

/// The unit in which `duration`, which is positive, is nearest to 0.1 s on a logarithmic scale.
TimeUnit likely_unit(double duration, bool is_whole) {
  const auto distance = [duration](TimeUnit unit) {
    return std::abs(std::log10(duration * seconds_per_tick(unit) / 0.1));
  };
  TimeUnit best = is_whole ? TimeUnit::kMillisecond : TimeUnit::kSecond;
  for (const TimeUnit unit :
       {TimeUnit::kMillisecond, TimeUnit::kMicrosecond, TimeUnit::kNanosecond}) {
    best = distance(unit) < distance(best) ? unit : best;
  }
  return best;
}

/// The time of a scan's first point, whose time field says `first` [s].
double begin_time(double first, double stamp) {
  constexpr double kNear = 10.0;
  constexpr double kEpochTime = 1e8;
  if (std::abs(first - stamp) < std::min(std::abs(first), kNear) || first > kEpochTime) {
    return first;
  }
  return std::abs(first) <= kNear ? stamp + first : stamp;
}

template <class Member>
void read_member(const PointRecords& records, const Field* field, Member member, lio::Scan& scan) {
  using Value = std::remove_reference_t<decltype(scan.points[0].*member)>;
  constexpr double kMax = std::numeric_limits<Value>::max();
  if (field != nullptr) {
    for_each_value(records, *field, [&](std::size_t i, double value) {
      const bool fits = std::is_floating_point_v<Value> || (value >= 0.0 && value <= kMax);
      scan.points[i].*member = fits ? static_cast<Value>(value) : Value{};
    });
  }
}

std::vector<double> read_column(const PointRecords& records, const Field& field) {
  std::vector<double> values(records.size);
  for_each_value(records, field, [&](std::size_t i, double value) { values[i] = value; });
  return values;
}

bool is_finite(const lio::TimedPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// Drops the points without a finite position and tick; `ticks` is empty or as long as the points.
void drop_no_returns(lio::Scan& scan, std::vector<double>& ticks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (is_finite(scan.points[i]) && (ticks.empty() || std::isfinite(ticks[i]))) {
      scan.points[kept] = scan.points[i];
      if (!ticks.empty()) {
        ticks[kept] = ticks[i];
      }
      ++kept;
    }
  }
  scan.points.resize(kept);
  ticks.resize(std::min(kept, ticks.size()));
}

}  // namespace

const Field* find_time_field(const PointRecords& records) {
  return records.find({"time", "t", "timestamp", "offset_time", "time_stamp"});
}

lio::Scan ScanConverter::convert(const PointRecords& records, double stamp) {
  lio::Scan scan;
  scan.t_begin = stamp;
  scan.t_end = stamp;
  scan.points.resize(records.size);
  const std::array<std::pair<const char*, float lio::TimedPoint::*>, 3> coordinates = {
      {{"x", &lio::TimedPoint::x}, {"y", &lio::TimedPoint::y}, {"z", &lio::TimedPoint::z}}};
  for (const auto& [name, member] : coordinates) {
    const Field* field = records.find({name});
    if (field == nullptr) {
      fail(records.source, std::string("has no field '") + name + "'");
    }
    read_member(records, field, member, scan);
  }
  read_member(
      records, records.find({"intensity", "reflectivity"}), &lio::TimedPoint::intensity, scan);
  read_member(records, records.find({"ring", "line", "channel"}), &lio::TimedPoint::ring, scan);

  const Field* time = find_time_field(records);
  std::vector<double> ticks = time ? read_column(records, *time) : std::vector<double>{};
  drop_no_returns(scan, ticks);
  if (!ticks.empty()) {
    set_times(ticks, is_integer(time->type), scan);
  }
  return scan;
}

void ScanConverter::set_times(const std::vector<double>& ticks, bool is_whole, lio::Scan& scan) {
  const auto [min, max] = std::minmax_element(ticks.begin(), ticks.end());
  if (unit_ == TimeUnit::kAutomatic && *max > *min) {
    unit_ = likely_unit(*max - *min, is_whole);
  }
  const double seconds = seconds_per_tick(unit_);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    scan.points[i].dt = static_cast<float>((ticks[i] - *min) * seconds);
  }
  scan.t_begin = begin_time(*min * seconds, scan.t_begin);
  scan.t_end = scan.t_begin + (*max - *min) * seconds;
  const auto is_earlier = [](const lio::TimedPoint& a, const lio::TimedPoint& b) {
    return a.dt < b.dt;
  };
  if (!std::is_sorted(scan.points.begin(), scan.points.end(), is_earlier)) {
    std::stable_sort(scan.points.begin(), scan.points.end(), is_earlier);
  }
}

}  // namespace nvm::io
