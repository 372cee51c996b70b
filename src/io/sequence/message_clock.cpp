// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/message_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "common/median.hpp"

namespace nvm::io {
namespace {

/// The ascending ones of `times`, without repetitions.
std::vector<double> ascending(const std::vector<double>& times) {
  std::vector<double> kept;
  for (const double time : times) {
    if (kept.empty() || time > kept.back()) {
      kept.push_back(time);
    }
  }
  return kept;
}

double median_interval(const std::vector<double>& times) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) {
    intervals.push_back(times[i] - times[i - 1]);
  }
  return intervals.empty() ? 0.0 : median(std::move(intervals));
}

/// A stamp [s] and the number of its sweep.
struct Stamp {
  double k;
  double t;
};

struct Line {
  double begin = 0.0;
  double slope = 0.0;

  double residual(const Stamp& stamp) const { return stamp.t - begin - slope * stamp.k; }
};

Line fit(const std::vector<Stamp>& stamps) {
  const auto n = static_cast<double>(stamps.size());
  double k = 0.0;
  double t = 0.0;
  double kk = 0.0;
  double kt = 0.0;
  for (const Stamp& stamp : stamps) {
    k += stamp.k;
    t += stamp.t;
    kk += stamp.k * stamp.k;
    kt += stamp.k * stamp.t;
  }
  const double slope = (n * kt - k * t) / (n * kk - k * k);
  return {(t - slope * k) / n, slope};
}

double median_distance(const std::vector<Stamp>& stamps, const Line& line) {
  std::vector<double> distances;
  for (const Stamp& stamp : stamps) {
    distances.push_back(std::abs(line.residual(stamp)));
  }
  return median(std::move(distances));
}

}  // namespace

StampSmoother::StampSmoother(const std::vector<double>& times) {
  const double usual = median_interval(times);
  std::vector<Stamp> stamps;
  double k = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    k += i == 0 ? 0.0 : std::max(1.0, std::round((times[i] - times[i - 1]) / usual));
    stamps.push_back({k, times[i] - times.front()});
  }
  // A line, and again without the stamps far from it: a recording may begin within a sweep.
  Line line = fit(stamps);
  const double limit = 3.0 * median_distance(stamps, line);
  std::vector<Stamp> near;
  std::copy_if(stamps.begin(), stamps.end(), std::back_inserter(near), [&](const Stamp& stamp) {
    return std::abs(line.residual(stamp)) <= limit;
  });
  line = fit(near);
  level_ = times.front() + line.begin;
  period_ = line.slope;
  jitter_ = median_distance(near, line);
  count_ = static_cast<double>(near.size());
}

double StampSmoother::smooth(double time) {
  constexpr double kMemory = 100.0;
  const double steps = std::max(0.0, std::round((time - level_) / period_));
  const double residual = time - level_ - steps * period_;
  if (std::abs(residual) > 0.5 * period_) {
    level_ = time;
    return time;
  }
  count_ = std::min(count_ + 1.0, kMemory);
  // The gains of a line through the last `count` points, for its last point and its slope.
  const double scale = count_ * (count_ + 1.0);
  level_ += steps * period_ + 2.0 * (2.0 * count_ - 1.0) / scale * residual;
  period_ += 6.0 / scale * residual / std::max(steps, 1.0);
  return level_;
}

MessageClock::MessageClock(
    const std::vector<MessageTime>& first, ClockChoice choice, bool smooths) {
  std::vector<double> offsets;
  std::size_t ticking = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ticking += i == 0 || first[i].stamp == first[i - 1].stamp ? 0U : 1U;
    offsets.push_back(first[i].record - first[i].stamp);
  }
  const bool stands_still =
      first.size() > 1 ? 2 * ticking < first.size() - 1 : !first.empty() && first[0].stamp == 0.0;
  uses_record_ =
      choice == ClockChoice::kRecord || (choice == ClockChoice::kAutomatic && stands_still);
  learn_offset(std::move(offsets));
  std::vector<double> usable;
  for (const MessageTime& message : first) {
    if (may_begin(message)) {
      usable.push_back(uses_record_ ? message.record : message.stamp);
    }
  }
  const std::vector<double> times = ascending(usable);
  period_ = median_interval(times);
  constexpr std::size_t kFew = 10;
  constexpr double kJitter = 1.5e-3;  // [s]; no spinning sensor's own clock does as much
  if (smooths && times.size() >= kFew) {
    StampSmoother smoother(times);
    jitter_ = smoother.jitter();
    if (jitter_ > kJitter && jitter_ < 0.25 * smoother.period()) {
      smoother_ = smoother;
    }
  }
}

void MessageClock::learn_offset(std::vector<double> offsets) {
  if (offsets.empty()) {
    return;
  }
  offset_ = median(offsets);
  for (double& offset : offsets) {
    offset = std::abs(offset - offset_);
  }
  offset_spread_ = median(std::move(offsets));
}

bool MessageClock::may_begin(const MessageTime& message) const {
  constexpr double kTolerance = 1.0;  // [s]
  constexpr double kFactor = 3.0;
  return uses_record_ || std::abs(message.record - message.stamp - offset_) <=
                             kTolerance + kFactor * offset_spread_;
}

bool MessageClock::follows(double time, double record) const {
  constexpr double kShort = 0.5;  // [s]
  const double step = time - previous_;
  const double recorded = record - previous_record_;
  return step > 0.0 && (step <= std::max(kShort, 5.0 * period_) || !std::isfinite(previous_) ||
                        !(std::abs(step - recorded) > 0.5 * step));
}

std::optional<double> MessageClock::date(const MessageTime& message) {
  constexpr int kEnough = 3;
  constexpr double kMinJump = 0.25;   // [s]
  constexpr double kTolerance = 0.1;  // [s]
  const double time = uses_record_ ? message.record : message.stamp;
  if (!std::isfinite(time) || (!std::isfinite(previous_) && !may_begin(message))) {
    return std::nullopt;
  }
  if (!follows(time, message.record) && !follows(time + jump_, message.record)) {
    const double jump = previous_ + (message.record - previous_record_) - time;
    const bool is_alike = suspect_count_ > 0 && std::abs(jump - suspect_) < kTolerance;
    suspect_count_ = is_alike ? suspect_count_ + 1 : 1;
    suspect_ = jump;
    if (suspect_count_ < kEnough || std::abs(jump) < kMinJump) {
      return std::nullopt;
    }
    jump_ = jump;
    if (jump_count_++ == 0) {
      first_jump_ = {previous_, jump};
    }
  } else if (follows(time, message.record)) {
    jump_ = 0.0;
  }
  suspect_count_ = 0;
  previous_ = time + jump_;
  previous_record_ = message.record;
  if (!smoother_) {
    return previous_;
  }
  const double smooth = smoother_->smooth(previous_);
  if (smooth <= previous_smooth_) {
    return std::nullopt;
  }
  previous_smooth_ = smooth;
  return smooth;
}

std::optional<std::string> MessageClock::jump_note(const std::string& messages) const {
  if (jump_count_ == 0) {
    return std::nullopt;
  }
  return fmt::format(
      "the stamps of the {} jump {} times against the record times, first by {:.3f} s at {:.3f} s: "
      "the jumps are taken off",
      messages,
      jump_count_,
      -first_jump_.record,
      first_jump_.stamp);
}

Clocks choose_clocks(
    const std::vector<MessageTime>& clouds,
    const std::vector<MessageTime>& imu,
    ClockChoice choice) {
  constexpr double kSameClock = 1.0;  // [s]
  Clocks clocks{{clouds, choice, true}, {imu, choice, false}, {}};
  const double difference = clocks.imu.offset() - clocks.cloud.offset();
  const bool is_one_clock = imu.empty() || std::abs(difference) < kSameClock;
  const auto settle = [&](MessageClock& clock, const auto& times, bool smooths, const char* topic) {
    const bool is_other = !is_one_clock && std::abs(clock.offset()) > kSameClock;
    if (choice == ClockChoice::kAutomatic && is_other && !clock.uses_record()) {
      clock = MessageClock(times, ClockChoice::kRecord, smooths);
      clocks.notes.push_back(fmt::format(
          "the stamps of the {0} are {1:.3f} s from the record times, and of another clock than "
          "the {2}': the record times are taken (input.clock)",
          topic,
          -clock.offset(),
          smooths ? "IMU messages" : "clouds"));
    } else if (choice == ClockChoice::kAutomatic && clock.uses_record()) {
      clocks.notes.push_back(fmt::format(
          "the stamps of the {} stand still: the record times are taken (input.clock)", topic));
    }
    if (clock.smooths()) {
      clocks.notes.push_back(fmt::format(
          "the times of the {} jitter by {:.1f} ms: they are smoothed",
          topic,
          1e3 * clock.jitter()));
    }
  };
  settle(clocks.cloud, clouds, true, "clouds");
  settle(clocks.imu, imu, false, "IMU messages");
  return clocks;
}

}  // namespace nvm::io
