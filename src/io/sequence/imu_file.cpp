// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/imu_file.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "common/median.hpp"
#include "io/sequence/time_unit.hpp"

namespace nvm::io {

namespace {

/// By the steps between the first rows.
double imu_time_unit(const std::string& path) {
  constexpr std::size_t kRows = 200;
  constexpr double kLongestStep = 0.3;  // [s]
  CsvReader rows(path, {"t"});
  std::vector<double> steps;
  std::optional<double> previous;
  for (std::size_t i = 0; i < kRows; ++i) {
    try {
      const auto cells = rows.next();
      if (!cells) {
        break;
      }
      const double time = rows.line().number(cells->front());
      if (previous && time > *previous) {
        steps.push_back(time - *previous);
      }
      previous = time;
    } catch (const std::runtime_error&) {
      continue;  // ImuFile counts it
    }
  }
  return steps.empty() ? 1.0 : time_unit(median(std::move(steps)), kLongestStep);
}

}  // namespace

ImuFile::ImuFile(const std::string& path)
    : unit_(imu_time_unit(path)), rows_(path, {"t", "gx", "gy", "gz", "ax", "ay", "az"}) {
  read_ahead();
}

std::vector<ImuSample> ImuFile::until(double time) {
  std::vector<ImuSample> samples;
  while (!ahead_.empty() && ahead_.begin()->first <= time) {
    samples.push_back(ahead_.begin()->second);
    ahead_.erase(ahead_.begin());
    handed_out_ = samples.back().time;
    gaps_.add(handed_out_);
    read_ahead();
  }
  return samples;
}

// Of rows that are late, so many at most lie ahead of those that they belong before.
void ImuFile::read_ahead() {
  constexpr double kLatest = 0.5;  // [s]
  while (!has_ended_ &&
         (ahead_.empty() || ahead_.rbegin()->first - ahead_.begin()->first < kLatest)) {
    try {
      if (const auto sample = read_row()) {
        take(*sample);
      } else {
        has_ended_ = true;
      }
    } catch (const std::runtime_error& error) {
      bad_rows_.add(error.what());
    }
  }
}

void ImuFile::take(const ImuSample& sample) {
  const bool is_late = !ahead_.empty() && sample.time < ahead_.rbegin()->first;
  if (sample.time <= handed_out_ || !ahead_.emplace(sample.time, sample).second) {
    rows_.line().fail("the time is that of another sample, or not above those long before");
  }
  disordered_ += is_late ? 1 : 0;
}

std::optional<std::string> ImuFile::order_note() const {
  return disordered_ == 0
             ? std::nullopt
             : std::optional(
                   std::to_string(disordered_) +
                   " rows of imu.csv are not in order of time: the samples are taken in it");
}

std::optional<ImuSample> ImuFile::read_row() {
  const auto cells = rows_.next();
  if (!cells) {
    return std::nullopt;
  }
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = rows_.line().number((*cells)[i]);
  }
  const ImuSample sample = {
      values[0] * unit_, {values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
  if (const auto problem = problem_of(sample)) {
    rows_.line().fail(*problem);
  }
  return sample;
}

std::optional<std::string> problem_of(const ImuSample& sample) {
  constexpr double kAbsurd = 1e5;  // beyond any sensor in deg/s, and in milli-g
  const double largest =
      std::max(sample.gyro.cwiseAbs().maxCoeff(), sample.accel.cwiseAbs().maxCoeff());
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) {
    return "a reading is not finite";
  }
  return largest > kAbsurd ? std::optional<std::string>("a reading is absurd, above 1e5")
                           : std::nullopt;
}

}  // namespace nvm::io
