// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nvm::lio {

namespace {

using Samples = std::deque<ImuSample>;

Samples::const_iterator first_not_before(const Samples& samples, double time) {
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
    return held(samples.back(), time, max_gap);
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
  if (sample.time < used_until_) {
    ++stats_.late;
    return;
  }
  const auto place = first_not_before(samples_, sample.time);
  if (place != samples_.end() && place->time == sample.time) {
    ++stats_.repeated;
    return;
  }
  samples_.insert(place, sample);
  ++stats_.accepted;
}

void ImuBuffer::between(
    double begin, double end, double max_gap, std::vector<ImuSample>& out) const {
  out.clear();
  if (samples_.empty() || !(begin < end)) {
    return;
  }
  if (const auto border = sample_at(samples_, begin, max_gap)) {
    out.push_back(*border);
  }
  for (auto it = first_not_before(samples_, begin); it != samples_.end() && it->time < end; ++it) {
    if (it->time > begin) {
      out.push_back(*it);
    }
  }
  if (const auto border = sample_at(samples_, end, max_gap)) {
    out.push_back(*border);
  }
}

void ImuBuffer::use_until(double time) {
  used_until_ = std::max(used_until_, time);
  while (samples_.size() > 1 && samples_[1].time <= time) {
    samples_.pop_front();
  }
}

}  // namespace nvm::lio
