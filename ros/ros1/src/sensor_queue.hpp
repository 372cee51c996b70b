// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "io/message/message_source.hpp"

namespace nvm_ros {

/// A message with a scan, as it came.
struct RawCloud {
  nvm::io::RecordedMessage message;
  std::string frame;   ///< of its header
  double stamp = 0.0;  ///< of its header [s]
  /// When it was published, in the stamp's clock [s]; NaN: unknown.
  double record_time = std::numeric_limits<double>::quiet_NaN();
  std::chrono::steady_clock::time_point arrival;
  std::size_t epoch = 0;  ///< how often time had gone back before
};

/// What became of the messages given to a SensorQueue.
struct QueueStats {
  std::size_t clouds = 0;      ///< that came
  std::size_t dropped = 0;     ///< clouds, because the queue was full
  std::size_t imu = 0;         ///< readings that came
  std::size_t bad_imu = 0;     ///< readings that repeat, go back in time or are not finite
  bool imu_is_silent = false;  ///< scans are no longer kept waiting for it
  double newest_imu = -std::numeric_limits<double>::infinity();  ///< [s]
};

/// Between the thread that receives messages and the one that works on them: a queue of bounded
/// size that gives a scan out together with the IMU readings up to its end.
///
/// Time that goes back by more than a second (a looped bag, another clock) begins a new epoch:
/// everything that waits is forgotten.
class SensorQueue {
 public:
  enum class WhenFull {
    kDropOldest,  ///< keeps up with sensors
    kWait,        ///< the producer waits: nothing is dropped
  };

  /// Without an IMU (`has_imu`) no reading is waited for; one that lets a scan wait for longer than
  /// `imu_timeout` [s] has fallen silent.
  SensorQueue(std::size_t max_clouds, WhenFull when_full, bool has_imu, double imu_timeout = 0.25);

  void add(RawCloud cloud);
  void add(const nvm::ImuSample& sample);

  /// No more will come: what waits can still be taken.
  void close();

  /// The oldest cloud. Waits until there is one; nothing when the queue is closed and empty.
  std::optional<RawCloud> next_cloud();

  /// The readings up to `time` [s], the end of `cloud`, that were not yet given out. Waits until
  /// the IMU is that far; but not for an IMU that has fallen silent. Nothing when meanwhile a new
  /// epoch has begun.
  std::optional<std::vector<nvm::ImuSample>> imu_until(const RawCloud& cloud, double time);

  QueueStats stats() const;

 private:
  using Lock = std::unique_lock<std::mutex>;
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  bool is_stale(double time, double newest_of_other) const;
  void begin_epoch_if_back(double time, double previous, Lock& lock);
  bool covers(double time) const;

  const std::size_t max_clouds_;
  const WhenFull when_full_;
  const bool has_imu_;
  const std::chrono::duration<double> imu_timeout_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<RawCloud> clouds_;
  std::deque<nvm::ImuSample> imu_;
  double newest_cloud_ = kNever;  // [s]
  double epoch_begin_ = kNever;   // [s]
  std::size_t epoch_ = 0;
  bool is_taken_ = false;  // a cloud has been given out, its readings have not
  bool producer_waits_ = false;
  bool is_closed_ = false;
  QueueStats stats_;
};

}  // namespace nvm_ros
