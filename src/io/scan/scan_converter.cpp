// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/scan_converter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/file/file.hpp"
#include "io/scan/scan_points.hpp"
#include "io/scan/sweep_azimuth.hpp"
#include "io/scan/tick_window.hpp"

namespace nvm::io {
namespace {

/// Ticks that sample a cloud's times.
constexpr std::size_t kSampleSize = 500;

}  // namespace

const Field* ScanConverter::time_field(const PointRecords& records) const {
  if (options_.field.empty()) {
    return find_time_field(records);
  }
  if (options_.field == "none" || options_.field == "azimuth") {
    return nullptr;
  }
  const Field* field = records.find({options_.field});
  if (field == nullptr) {
    std::string names;
    for (const Field& other : records.fields) {
      names += (names.empty() ? "" : ", ") + other.name;
    }
    fail(
        records.source, "has no field '" + options_.field + "' for the times; there are: " + names);
  }
  return field;
}

SweepSample ScanConverter::sample_of(const CloudMessage& cloud) const {
  SweepSample sample{cloud.stamp, cloud.record_time, {}};
  const Field* field = time_field(cloud.records);
  if (field == nullptr) {
    return sample;
  }
  std::vector<TimedPoint> points = read_scan_points(cloud.records, {});
  std::vector<double> ticks = read_column(cloud.records, *field);
  drop_no_returns(points, ticks);
  const std::size_t step = ticks.size() / kSampleSize + 1;
  for (std::size_t i = 0; i < ticks.size(); i += step) {
    sample.ticks.push_back(ticks[i]);
  }
  if (!ticks.empty()) {
    sample.ticks.push_back(ticks.back());
  }
  std::sort(sample.ticks.begin(), sample.ticks.end());
  return sample;
}

void ScanConverter::learn(const std::vector<CloudMessage>& clouds) {
  has_learnt_ = true;
  std::vector<SweepSample> samples;
  TickType type;
  for (const CloudMessage& cloud : clouds) {
    samples.push_back(sample_of(cloud));
    source_ = cloud.records.source;
    if (samples.size() == 1) {
      origin_ = map_origin(cloud.records);
    }
    if (const Field* field = time_field(cloud.records)) {
      field_ = field->name;
      type = tick_type(*field);
    }
  }
  modulus_ = type.modulus;
  times_ = learn_point_times(samples, type, options_);
  if (times_.base != PointTimes::Base::kNone || clouds.empty()) {
    return;
  }
  std::vector<TimedPoint> points = read_scan_points(clouds.back().records, {});
  std::vector<double> no_ticks;
  drop_no_returns(points, no_ticks);
  const bool is_wanted =
      options_.field == "azimuth" || (options_.is_raw && options_.field != "none");
  uses_azimuth_ = is_wanted && !sweep_fractions(points).empty();
}

std::vector<std::string> ScanConverter::notes() const {
  std::vector<std::string> notes;
  const std::string prefix = source_ + ": ";
  if (times_.base != PointTimes::Base::kNone) {
    notes.push_back(prefix + "point times: field '" + field_ + "' " + times_.description);
  } else if (!source_.empty()) {
    std::string note =
        prefix + (times_.problem.empty() ? "there are no point times"
                                         : "the point times '" + field_ + "' " + times_.problem);
    note += uses_azimuth_ ? "; they are taken from the azimuth, as of a spinning sensor in sweeps "
                            "of " +
                                std::to_string(times_.period) + " s"
                          : "; each scan counts as taken at one instant, which is wrong while the "
                            "sensor moves: set input.point_time_field to the field with the times, "
                            "or to azimuth for raw scans of a spinning sensor";
    notes.push_back(note + (times_.is_stamp_at_end ? "; the stamp dates the sweep's end" : ""));
  }
  if (origin_ != std::array<double, 3>{}) {
    notes.push_back(fmt::format(
        "{}the points lie around ({:.0f}, {:.0f}, {:.0f}) m, as in a map's coordinates: this is "
        "taken off as the local origin",
        prefix,
        origin_[0],
        origin_[1],
        origin_[2]));
  }
  if (wrong_times_ > 0) {
    notes.push_back(
        prefix + std::to_string(wrong_times_) +
        " points whose times do not fit into a sweep are left out");
  }
  if (untimed_scans_ > 0) {
    notes.push_back(
        prefix + std::to_string(untimed_scans_) +
        " scans have no times, or some that do not fit into a sweep; they are replaced by the " +
        (uses_azimuth_ || options_.is_raw ? "azimuth's, or" : "") + " begin of the sweep");
  }
  return notes;
}

std::vector<Scan> ScanConverter::preview(const std::vector<CloudMessage>& clouds) const {
  ScanConverter converter = *this;
  std::vector<Scan> scans;
  for (const CloudMessage& cloud : clouds) {
    try {
      scans.push_back(converter.convert(cloud.records, cloud.stamp));
    } catch (const std::runtime_error&) {
      continue;  // it is told when it comes again
    }
  }
  return scans;
}

Scan ScanConverter::convert(const PointRecords& records, double stamp) {
  if (!has_learnt_) {
    learn({{stamp, records}});
  }
  Scan scan;
  scan.points = read_scan_points(records, origin_);
  const Field* time = times_.base == PointTimes::Base::kNone ? nullptr : time_field(records);
  std::vector<double> ticks = time ? read_column(records, *time) : std::vector<double>{};
  drop_no_returns(scan.points, ticks);
  scan.t_begin = times_.sweep_begin(stamp);
  scan.t_end = scan.t_begin;
  const bool lacks_times = times_.base != PointTimes::Base::kNone && !scan.points.empty();
  if (!ticks.empty()) {
    set_times(ticks, stamp, scan);
  } else if (uses_azimuth_ || lacks_times) {
    const bool is_timed = set_times_by_azimuth(stamp, scan);
    untimed_scans_ += lacks_times || !is_timed ? 1 : 0;
  }
  return scan;
}

bool ScanConverter::is_plausible(double first, double last, double stamp) const {
  const double seconds = times_.seconds_per_tick;
  if ((last - first) * seconds > times_.max_duration) {
    return false;
  }
  switch (times_.base) {
    case PointTimes::Base::kStamp:
      return std::abs(first * seconds - times_.begin) <= times_.max_duration;
    case PointTimes::Base::kAbsolute:
      return options_.has_assumed_stamps || stamp == 0.0 ||
             std::abs(first * seconds - stamp) <= kMaxStampOffset;
    default:
      return true;
  }
}

void ScanConverter::set_times(std::vector<double>& ticks, double stamp, Scan& scan) {
  auto [min, max] = std::minmax_element(ticks.begin(), ticks.end());
  double first = *min;
  double last = *max;
  if (!is_plausible(first, last, stamp)) {
    mend_times(ticks, scan);
    if (ticks.empty() || scan.points.empty()) {
      untimed_scans_ += 1;
      set_times_by_azimuth(stamp, scan);
      return;
    }
    std::tie(min, max) = std::minmax_element(ticks.begin(), ticks.end());
    first = *min;
    last = *max;
  }
  const double seconds = times_.seconds_per_tick;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    scan.points[i].dt = static_cast<float>((ticks[i] - first) * seconds);
  }
  if (times_.base == PointTimes::Base::kStamp) {
    const bool is_near = std::abs(first * seconds - times_.begin) <= times_.max_duration;
    scan.t_begin += is_near ? first * seconds : times_.begin;
  } else if (times_.base == PointTimes::Base::kAbsolute && is_plausible(first, last, stamp)) {
    scan.t_begin = first * seconds;
  }
  scan.t_end = scan.t_begin + (last - first) * seconds;
  sort_by_time(scan.points);
}

/// Mends counters that wrapped and leaves out the points whose ticks are outside of the densest
/// part. No ticks are left when those are half of the points.
void ScanConverter::mend_times(std::vector<double>& ticks, Scan& scan) {
  const auto is_upper = [&](double tick) { return tick > 0.5 * modulus_; };
  const double seconds = times_.seconds_per_tick;
  if (modulus_ > 0.0 && std::any_of(ticks.begin(), ticks.end(), is_upper)) {
    for (double& tick : ticks) {
      tick -= is_upper(tick) ? modulus_ : 0.0;
    }
  }
  std::vector<double> sorted = ticks;
  std::sort(sorted.begin(), sorted.end());
  if ((sorted.back() - sorted.front()) * seconds <= times_.max_duration) {
    return;
  }
  const TickWindow window = densest_window(sorted, times_.max_duration / seconds);
  if (2 * window.count < ticks.size()) {
    ticks.clear();
    return;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (ticks[i] >= window.first && ticks[i] <= window.last) {
      scan.points[kept] = scan.points[i];
      ticks[kept++] = ticks[i];
    }
  }
  wrong_times_ += ticks.size() - kept;
  scan.points.resize(kept);
  ticks.resize(kept);
}

bool ScanConverter::set_times_by_azimuth(double stamp, Scan& scan) const {
  const std::vector<float> fractions = sweep_fractions(scan.points);
  scan.t_begin = times_.sweep_begin(stamp);
  scan.t_end = scan.t_begin;
  if (fractions.empty()) {
    return scan.points.empty();
  }
  const auto period = static_cast<float>(times_.period);
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    scan.points[i].dt = period * fractions[i];
  }
  sort_by_time(scan.points);
  scan.t_end = scan.t_begin + static_cast<double>(scan.points.back().dt);
  return true;
}

}  // namespace nvm::io
