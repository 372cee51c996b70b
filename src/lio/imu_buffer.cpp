// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace nvm::lio {

namespace {

/// Consecutive readings, oldest first.
struct Samples {
  using Iterator = std::deque<ImuSample>::const_iterator;
  Iterator first, last;

  Iterator begin() const { return first; }
  Iterator end() const { return last; }
};

Samples::Iterator first_not_before(const Samples& samples, double time) {
  return std::lower_bound(samples.begin(), samples.end(), time, [](const ImuSample& s, double t) {
    return s.time < t;
  });
}

std::optional<ImuSample> held(const ImuSample& nearest, double time, double max_gap) {
  if (std::abs(nearest.time - time) > max_gap) {
    return std::nullopt;
  }
  return ImuSample{time, nearest.gyro, nearest.accel};
}

std::optional<ImuSample> sample_at(const Samples& samples, double time, double max_gap) {
  const auto next = first_not_before(samples, time);
  if (next == samples.end()) {
    return held(*std::prev(samples.end()), time, max_gap);
  }
  if (next->time == time) {
    return *next;
  }
  if (next == samples.begin()) {
    return held(*next, time, max_gap);
  }
  const ImuSample& previous = *(next - 1);
  if (next->time - previous.time <= max_gap) {
    return interpolate(previous, *next, time);
  }
  return held(time - previous.time < next->time - time ? previous : *next, time, max_gap);
}

/// Beyond what any IMU measures, in any unit: 5000 degrees per second, 500 g.
bool is_implausible(const ImuSample& sample) {
  constexpr double kMax = 5000.0;
  return sample.gyro.norm() > kMax || sample.accel.norm() > kMax;
}

/// Whether `reading` is off both `a` and `b`, two neighbours that agree, in one of its parts.
bool jumps(const ImuSample& reading, const ImuSample& a, const ImuSample& b) {
  constexpr double kMinGyroJump = 10.0;   // [rad/s]
  constexpr double kMinAccelJump = 30.0;  // [m/s^2]
  constexpr double kFactor = 8.0;
  const auto is_off = [](const auto& x, const auto& y, const auto& z, double min_jump) {
    const double jump = std::min((x - y).norm(), (x - z).norm());
    return jump > std::max(min_jump, kFactor * (y - z).norm());
  };
  return is_off(reading.gyro, a.gyro, b.gyro, kMinGyroJump) ||
         is_off(reading.accel, a.accel, b.accel, kMinAccelJump);
}

constexpr double kMaxDuration = 0.1;  // over which neighbours tell a spike [s]

}  // namespace

ImuSample interpolate(const ImuSample& a, const ImuSample& b, double time) {
  const double share = (time - a.time) / (b.time - a.time);
  return {time, (1.0 - share) * a.gyro + share * b.gyro, (1.0 - share) * a.accel + share * b.accel};
}

void ImuBuffer::add(const ImuSample& sample) {
  if (!std::isfinite(sample.time) || !sample.gyro.allFinite() || !sample.accel.allFinite()) {
    ++stats_.non_finite;
    return;
  }
  if (is_implausible(sample)) {
    ++stats_.implausible;
    return;
  }
  if (sample.time < used_until_) {
    ++stats_.late;
    return;
  }
  const auto place = first_not_before({samples_.begin(), samples_.end()}, sample.time);
  if (place != samples_.end() && place->time == sample.time) {
    ++stats_.repeated;
    return;
  }
  if (place != samples_.end()) {
    samples_.insert(place, sample);
  } else {
    append(sample);
  }
  ++stats_.accepted;
}

void ImuBuffer::append(const ImuSample& sample) {
  const std::size_t size = samples_.size();
  const bool has_neighbors = size >= 2 && sample.time - samples_[size - 2].time <= kMaxDuration;
  if (has_neighbors && jumps(samples_[size - 1], samples_[size - 2], sample)) {
    samples_.pop_back();  // one bad reading, no jolt
    ++stats_.implausible;
    --stats_.accepted;
  }
  if (!samples_.empty()) {
    note_interval(sample.time - samples_.back().time);
  }
  samples_.push_back(sample);
}

// A jolt begins like a spike: which it is, only the next reading tells. Until then the one before
// holds.
bool ImuBuffer::is_last_doubtful() const {
  const std::size_t size = samples_.size();
  if (size < 2) {
    return false;
  }
  const ImuSample& before = samples_[size - 2];
  const ImuSample& earlier = size >= 3 ? samples_[size - 3] : before;
  return samples_.back().time - earlier.time <= kMaxDuration &&
         jumps(samples_.back(), earlier, before);
}

void ImuBuffer::note_interval(double interval) {
  constexpr std::size_t kMaxCount = 100;
  intervals_.push_back(interval);
  if (intervals_.size() > kMaxCount) {
    intervals_.pop_front();
  }
}

double ImuBuffer::interval() const {
  if (intervals_.empty()) {
    return 0.0;
  }
  std::vector<double> sorted(intervals_.begin(), intervals_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

void ImuBuffer::between(
    double begin, double end, double max_gap, std::vector<ImuSample>& out) const {
  out.clear();
  if (samples_.empty() || !(begin < end)) {
    return;
  }
  const Samples samples = {samples_.begin(), samples_.end() - (is_last_doubtful() ? 1 : 0)};
  if (const auto border = sample_at(samples, begin, max_gap)) {
    out.push_back(*border);
  }
  for (auto it = first_not_before(samples, begin); it != samples.end() && it->time < end; ++it) {
    if (it->time > begin) {
      out.push_back(*it);
    }
  }
  if (const auto border = sample_at(samples, end, max_gap)) {
    out.push_back(*border);
  }
}

void ImuBuffer::use_until(double time) {
  constexpr std::size_t kKept = 3;  // at or before `time`: they tell whether the last is a spike
  used_until_ = std::max(used_until_, time);
  while (samples_.size() > kKept && samples_[kKept].time <= time) {
    samples_.pop_front();
  }
}

}  // namespace nvm::lio
