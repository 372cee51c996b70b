// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/loss_watch.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace nvm::lio {

void LossWatch::note_reading(double time) {
  imu_gap_ = std::max(imu_gap_, time - reading_time_.value_or(time));
  reading_time_ = time;
}

// A pause is no usual interval.
void LossWatch::note_scan(double time) {
  constexpr double kWeight = 0.2;  // of the last one in what is usual
  if (first_time_ && time > scan_time_ && !is_overdue(time)) {
    const double interval = time - scan_time_;
    interval_ = interval_ ? (1.0 - kWeight) * *interval_ + kWeight * interval : interval;
  }
  first_time_ = first_time_.value_or(time);
  scan_time_ = time;
}

void LossWatch::note_pose(double time, bool by_imu) {
  constexpr std::size_t kMost = 8;  // times that are told
  if (is_lost_ && losses_.size() < kMost) {
    losses_.push_back({believed_time_, time});
  } else if (is_lost_) {
    ++untold_;
  }
  is_lost_ = false;
  believed_time_ = time;
  is_by_imu_ = by_imu;
  imu_gap_ = 0.0;
}

void LossWatch::lose() { is_lost_ = true; }

// Without an IMU a motion holds for about a second, with one for as long as its errors, which grow
// with the square of time, stay within the decimetres that an alignment bridges.
bool LossWatch::is_overdue(double time) const {
  constexpr double kAlone = 1.0;      // [s]
  constexpr double kByImu = 3.0;      // [s]
  constexpr double kMaxImuGap = 0.2;  // [s]
  constexpr double kIntervals = 5.0;  // of a slow scanner
  const double imu_gap = std::max(imu_gap_, time - reading_time_.value_or(-1e300));
  const double patience = is_by_imu_ && imu_gap < kMaxImuGap ? kByImu : kAlone;
  return interval_ && silence(time) > std::max(patience, kIntervals * *interval_);
}

std::string LossWatch::finding() const {
  if (losses_.empty() && !is_lost_) {
    return "";
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "the pose was lost";
  const char* separator = " ";
  for (const Span& span : losses_) {
    text << separator << "from " << span.begin - *first_time_ << " to " << span.end - *first_time_
         << " s, found again";
    separator = "; ";
  }
  if (untold_ > 0) {
    text << separator << untold_ << " times more, found again";
  }
  if (is_lost_) {
    text << separator << "from " << believed_time_ - *first_time_
         << " s to the end, not found again in the prior map";
  }
  return text.str();
}

}  // namespace nvm::lio
