// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/point_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/median.hpp"
#include "io/scan/tick_window.hpp"

namespace nvm::io {
namespace {

constexpr double kTypicalPeriod = 0.1;  // [s]
constexpr double kEpochTime = 1e8;      // [s]: three years; no clock since boot is there

struct Unit {
  TimeUnit unit;
  double seconds;
  const char* name;
};

constexpr std::array<Unit, 4> kUnits = {{
    {TimeUnit::kSecond, 1.0, "s"},
    {TimeUnit::kMillisecond, 1e-3, "ms"},
    {TimeUnit::kMicrosecond, 1e-6, "us"},
    {TimeUnit::kNanosecond, 1e-9, "ns"},
}};

class Learner {
 public:
  Learner(
      const std::vector<SweepSample>& samples,
      const TickType& type,
      const PointTimeOptions& options)
      : samples_(samples), type_(type), options_(options) {
    find_period();
    for (const SweepSample& sample : samples) {
      std::vector<double> ticks = sample.ticks;
      unwrap(ticks, type.modulus);
      if (!ticks.empty()) {
        sweeps_.push_back({sample.stamp, main_part(ticks)});
      }
    }
  }

  PointTimes learn() {
    if (!sweeps_.empty() && find_unit()) {
      find_base();
    }
    find_meaning_of_stamp();
    describe();
    return std::move(times_);
  }

 private:
  struct Sweep {
    double stamp;
    TickWindow ticks;
  };

  void find_period() {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const double interval = samples_[i].stamp - samples_[i - 1].stamp;
      if (interval > 0.0) {
        intervals.push_back(interval);
      }
    }
    is_period_known_ = !intervals.empty();
    times_.period = is_period_known_ ? median(std::move(intervals)) : kTypicalPeriod;
  }

  /// False when the ticks tell no times.
  bool find_unit() {
    std::vector<double> durations;
    std::vector<double> sizes;
    for (const Sweep& sweep : sweeps_) {
      durations.push_back(sweep.ticks.last - sweep.ticks.first);
      sizes.push_back(std::abs(sweep.ticks.first));
    }
    const double duration = median(std::move(durations));
    const double resolution = type_.resolution * median(std::move(sizes));
    if (duration <= 0.0) {
      times_.problem = resolution > 0.0 ? "are float32, too coarse for their size"
                                        : "are the same for all points of a scan";
      return false;
    }
    const bool is_automatic = options_.unit == TimeUnit::kAutomatic;
    const Unit unit = is_automatic ? likely_unit(duration) : named_unit(options_.unit);
    times_.seconds_per_tick = unit.seconds;
    unit_name_ = unit.name;
    constexpr double kOverlap = 1.5;
    const double whole = whole_sweep(duration);
    if (options_.unit == TimeUnit::kSweep ||
        (is_automatic && whole > 0.0 && duration * unit.seconds > kOverlap * times_.period)) {
      times_.seconds_per_tick = times_.period / std::max(whole, 1.0);
      unit_name_ =
          whole > 1.0 ? fmt::format("1/{:.4g} of the sweep", whole) : "shares of the sweep";
    }
    duration_ = duration * times_.seconds_per_tick;
    constexpr double kCoarse = 0.02;
    if (resolution * times_.seconds_per_tick > kCoarse * times_.period) {
      times_.problem = fmt::format(
          "are float32 of {:.4g}, where its steps are of {:.3g} s",
          resolution / type_.resolution,
          resolution * times_.seconds_per_tick);
      return false;
    }
    times_.max_duration = kOverlap * std::max(duration_, is_period_known_ ? times_.period : 0.0);
    return true;
  }

  static Unit named_unit(TimeUnit wanted) {
    for (const Unit& unit : kUnits) {
      if (unit.unit == wanted) {
        return unit;
      }
    }
    return kUnits[0];
  }

  Unit likely_unit(double duration) const {
    const double target = std::min(times_.period, kTypicalPeriod);
    Unit best = type_.is_whole ? kUnits[1] : kUnits[0];
    const auto distance = [&](const Unit& unit) {
      return std::abs(std::log10(duration * unit.seconds / target));
    };
    for (const Unit& unit : kUnits) {
      if ((unit.unit != TimeUnit::kSecond || !type_.is_whole) && distance(unit) < distance(best)) {
        best = unit;
      }
    }
    return best;
  }

  /// What a whole sweep counts when the times begin at zero and are a share of it, a percentage or
  /// degrees; 0 for other times.
  double whole_sweep(double duration) const {
    constexpr double kDegrees = 360.0;
    constexpr double kPercent = 100.0;
    for (const double whole : {1.0, kPercent, kDegrees}) {
      const bool is_near = duration <= 1.001 * whole && duration >= 0.8 * whole;
      const double first = std::abs(sweeps_[sweeps_.size() / 2].ticks.first);
      if (is_near && first <= 1.001 * whole) {
        return whole;
      }
    }
    return 0.0;
  }

  void find_base() {
    std::vector<double> begins;
    std::vector<double> ends;
    std::vector<double> delays;  // of the stamp behind the first point
    for (const Sweep& sweep : sweeps_) {
      begins.push_back(sweep.ticks.first * times_.seconds_per_tick);
      ends.push_back(sweep.ticks.last * times_.seconds_per_tick);
      delays.push_back(sweep.stamp - begins.back());
    }
    times_.begin = median(begins);
    times_.end = median(ends);
    const double delay = median(delays);
    constexpr std::size_t kFew = 3;
    const bool repeats = sweeps_.size() < kFew
                             ? std::abs(times_.begin) <= std::abs(delay)
                             : spread(begins) <= spread(delays) && spread(begins) < times_.period;
    if (repeats && std::abs(times_.begin) <= kMaxStampOffset) {
      times_.base = PointTimes::Base::kStamp;
      return;
    }
    const bool is_epoch = times_.begin > kEpochTime;
    const bool has_stamps = !options_.has_assumed_stamps && sweeps_.front().stamp != 0.0;
    const bool is_near = std::abs(delay) < std::min(std::abs(times_.begin), kMaxStampOffset);
    times_.base = is_near || (is_epoch && !has_stamps) ? PointTimes::Base::kAbsolute
                                                       : PointTimes::Base::kOtherClock;
    clock_offset_ = -delay;
    times_.end = duration_;
    times_.begin = 0.0;
  }

  /// A message cannot have been recorded before its last point was measured.
  void find_meaning_of_stamp() {
    if (times_.base == PointTimes::Base::kNone) {
      times_.end = times_.period;
    } else {
      constexpr double kGapBetweenSweeps = 0.03;  // of sensors that turn without a break
      const double rest = times_.period - times_.end;
      times_.end += rest > 0.0 && rest < kGapBetweenSweeps * times_.period ? rest : 0.0;
    }
    std::vector<double> delays;
    for (const SweepSample& sample : samples_) {
      if (std::isfinite(sample.record_time)) {
        delays.push_back(sample.record_time - sample.stamp);
      }
    }
    if (options_.stamp == StampMeaning::kAutomatic && !delays.empty()) {
      constexpr double kClockError = 0.2;  // of a sweep
      constexpr double kNone = 1e-6;       // [s]: a writer that has no record time gives the stamp
      delay_ = median(std::move(delays));
      const double duration = std::min(times_.end, times_.period);
      times_.is_stamp_at_end = times_.base != PointTimes::Base::kAbsolute && times_.end > 0.0 &&
                               delay_ > -kClockError * duration && delay_ < 0.5 * duration &&
                               std::abs(delay_) > kNone;
    } else {
      times_.is_stamp_at_end = options_.stamp == StampMeaning::kEnd;
    }
    if (times_.base == PointTimes::Base::kAbsolute ||
        (times_.base == PointTimes::Base::kStamp && times_.end <= 0.5 * duration_)) {
      times_.is_stamp_at_end = false;  // times that go back from it say the same
    }
  }

  void describe() {
    switch (times_.base) {
      case PointTimes::Base::kNone:
        times_.description = "none";
        break;
      case PointTimes::Base::kStamp:
        times_.description = fmt::format("in {}, from the stamp", unit_name_);
        break;
      case PointTimes::Base::kAbsolute:
        times_.description = fmt::format("in {}, absolute", unit_name_);
        break;
      case PointTimes::Base::kOtherClock:
        times_.description = fmt::format(
            "in {}, in a clock {:.3f} s ahead of the stamps': only differences are used",
            unit_name_,
            clock_offset_);
        break;
    }
    if (times_.is_stamp_at_end) {
      times_.description += "; the stamp dates the sweep's end";
      if (options_.stamp == StampMeaning::kAutomatic) {
        times_.description += fmt::format(
            ", as messages were recorded {:.1f} ms after it, before a sweep of {:.0f} ms that "
            "began there could end",
            1e3 * delay_,
            1e3 * times_.end);
      }
    }
  }

  const std::vector<SweepSample>& samples_;
  const TickType& type_;
  const PointTimeOptions& options_;
  std::vector<Sweep> sweeps_;
  PointTimes times_;
  bool is_period_known_ = false;
  double duration_ = 0.0;      ///< [s]
  double delay_ = 0.0;         ///< of recording behind the stamp [s]
  double clock_offset_ = 0.0;  ///< [s]
  std::string unit_name_;
};

}  // namespace

PointTimes learn_point_times(
    const std::vector<SweepSample>& samples,
    const TickType& type,
    const PointTimeOptions& options) {
  return Learner(samples, type, options).learn();
}

}  // namespace nvm::io
