// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "common/median.hpp"

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

/// Beyond what any IMU measures, in any unit: counts of 16 bits on three axes.
bool is_implausible(const ImuSample& sample) {
  constexpr double kMax = 60'000.0;
  return sample.gyro.norm() > kMax || sample.accel.norm() > kMax;
}

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
    ++stats_.accepted;
  } else if (!doubtful_.empty() && sample.time <= doubtful_.back().time) {
    ++stats_.implausible;  // amid readings that are
  } else {
    append(sample);
  }
}

// Readings that leap away are a spike when they leap back, and a jolt when they last, unless no
// jolt reaches them.
void ImuBuffer::append(const ImuSample& sample) {
  constexpr double kLongestSpike = 0.1;  // [s]
  const bool is_off = outliers_.is_off(sample);
  outliers_.note(sample);
  if (!is_off) {
    drop_doubtful(sample.time);
    accept(sample);
    return;
  }
  doubtful_.push_back(sample);
  if (sample.time - samples_.back().time <= kLongestSpike) {
    return;
  }
  if (outliers_.is_nonsense(sample)) {
    drop_doubtful(sample.time);
    return;
  }
  for (const ImuSample& doubtful : doubtful_) {
    accept(doubtful);
  }
  doubtful_.clear();
}

void ImuBuffer::drop_doubtful(double now) {
  if (doubtful_.empty()) {
    return;
  }
  const double begin = samples_.back().time;
  const bool goes_on = !doubts_.empty() && doubts_.back().begin == begin;
  if (goes_on) {
    doubts_.back().end = now;
  } else if (doubtful_.size() > 1) {
    doubts_.push_back({begin, now});
  }
  if (now - begin > stats_.longest_outage) {
    stats_.longest_outage = now - begin;
    stats_.outage_begin = begin;
  }
  stats_.implausible += doubtful_.size();
  doubtful_.clear();
}

bool ImuBuffer::is_doubtful(double begin, double end) const {
  return std::any_of(doubts_.begin(), doubts_.end(), [&](const Span& doubt) {
    return doubt.begin < end && begin < doubt.end;
  });
}

void ImuBuffer::accept(const ImuSample& sample) {
  if (!samples_.empty()) {
    note_interval(sample.time - samples_.back().time);
  }
  outliers_.add_good(sample);
  samples_.push_back(sample);
  ++stats_.accepted;
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
  return median({intervals_.begin(), intervals_.end()});
}

void ImuBuffer::between(
    double begin, double end, double max_gap, std::vector<ImuSample>& out) const {
  out.clear();
  if (samples_.empty() || !(begin < end)) {
    return;
  }
  const Samples samples = {samples_.begin(), samples_.end()};
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

void ImuBuffer::move(double by) {
  for (ImuSample& sample : samples_) {
    sample.time += by;
  }
  for (ImuSample& sample : doubtful_) {
    sample.time += by;
  }
  for (Span& doubt : doubts_) {
    doubt.begin += by;
    doubt.end += by;
  }
  used_until_ += by;
}

void ImuBuffer::use_until(double time) {
  used_until_ = std::max(used_until_, time);
  while (samples_.size() > 1 && samples_[1].time <= time) {
    samples_.pop_front();
  }
  while (!doubts_.empty() && doubts_.front().end < time) {
    doubts_.pop_front();
  }
}

}  // namespace nvm::lio
