// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sensor_queue.hpp"

#include <algorithm>
#include <utility>

namespace nvm_ros {

namespace {

/// Smaller steps back are messages that overtook each other [s].
constexpr double kMaxStepBack = 1.0;
/// How long after a step back messages from before it may still come [s of the sensors' clock].
constexpr double kStaleFor = 2.0;
/// Readings kept while no scan comes: a minute and more.
constexpr std::size_t kMaxReadings = 60'000;

}  // namespace

SensorQueue::SensorQueue(
    std::size_t max_clouds, WhenFull when_full, bool has_imu, double imu_timeout)
    : max_clouds_(max_clouds),
      when_full_(when_full),
      has_imu_(has_imu),
      imu_timeout_(imu_timeout) {}

void SensorQueue::add(RawCloud cloud) {
  Lock lock(mutex_);
  if (is_stale(cloud.stamp, stats_.newest_imu)) {
    return;
  }
  begin_epoch_if_back(cloud.stamp, newest_cloud_, lock);
  newest_cloud_ = cloud.stamp;
  ++stats_.clouds;
  if (clouds_.size() >= max_clouds_ && when_full_ == WhenFull::kWait) {
    producer_waits_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return clouds_.size() < max_clouds_ || is_closed_; });
    producer_waits_ = false;
  } else if (clouds_.size() >= max_clouds_) {
    clouds_.pop_front();
    ++stats_.dropped;
  }
  cloud.epoch = epoch_;
  clouds_.push_back(std::move(cloud));
  changed_.notify_all();
}

void SensorQueue::add(const nvm::ImuSample& sample) {
  Lock lock(mutex_);
  if (is_stale(sample.time, newest_cloud_)) {
    return;
  }
  begin_epoch_if_back(sample.time, stats_.newest_imu, lock);
  ++stats_.imu;
  if (!(sample.time > stats_.newest_imu) || !sample.gyro.allFinite() || !sample.accel.allFinite()) {
    ++stats_.bad_imu;
    return;
  }
  stats_.newest_imu = sample.time;
  stats_.imu_is_silent = false;
  imu_.push_back(sample);
  if (imu_.size() > kMaxReadings) {
    imu_.pop_front();
  }
  changed_.notify_all();
}

void SensorQueue::close() {
  const Lock lock(mutex_);
  is_closed_ = true;
  changed_.notify_all();
}

std::optional<RawCloud> SensorQueue::next_cloud() {
  Lock lock(mutex_);
  is_taken_ = false;
  changed_.notify_all();
  changed_.wait(lock, [this] { return !clouds_.empty() || is_closed_; });
  if (clouds_.empty()) {
    return std::nullopt;
  }
  RawCloud cloud = std::move(clouds_.front());
  clouds_.pop_front();
  is_taken_ = true;
  changed_.notify_all();
  return cloud;
}

std::optional<std::vector<nvm::ImuSample>> SensorQueue::imu_until(
    const RawCloud& cloud, double time) {
  Lock lock(mutex_);
  const auto is_ready = [&] { return covers(time) || epoch_ != cloud.epoch; };
  if (when_full_ == WhenFull::kWait) {
    changed_.wait(lock, is_ready);
  } else if (!stats_.imu_is_silent) {
    stats_.imu_is_silent = !changed_.wait_for(lock, imu_timeout_, is_ready);
  }
  if (epoch_ != cloud.epoch) {
    return std::nullopt;
  }
  const auto end = std::find_if(
      imu_.begin(), imu_.end(), [time](const auto& sample) { return sample.time > time; });
  std::vector<nvm::ImuSample> samples(imu_.begin(), end);
  imu_.erase(imu_.begin(), end);
  is_taken_ = false;
  changed_.notify_all();
  return samples;
}

QueueStats SensorQueue::stats() const {
  const Lock lock(mutex_);
  return stats_;
}

bool SensorQueue::covers(double time) const {
  return !has_imu_ || stats_.newest_imu >= time || producer_waits_ || is_closed_;
}

// After one sensor's time went back, messages of the other from before that may still come: they
// must not look like time that goes back again.
bool SensorQueue::is_stale(double time, double newest_of_other) const {
  return epoch_ > 0 && newest_of_other > kNever && newest_of_other < epoch_begin_ + kStaleFor &&
         time > newest_of_other + kMaxStepBack;
}

void SensorQueue::begin_epoch_if_back(double time, double previous, Lock& lock) {
  if (!(time < previous - kMaxStepBack)) {
    return;
  }
  if (when_full_ == WhenFull::kWait) {  // nothing that waits is lost
    producer_waits_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return (clouds_.empty() && !is_taken_) || is_closed_; });
    producer_waits_ = false;
  }
  ++epoch_;
  epoch_begin_ = time;
  newest_cloud_ = stats_.newest_imu = kNever;
  imu_.clear();
  clouds_.clear();
}

}  // namespace nvm_ros
