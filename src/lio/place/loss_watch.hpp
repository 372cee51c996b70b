// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nvm::lio {

/// When a run has had no pose for so long that the sensor may be anywhere, and what is told of such
/// times. All times in seconds, ascending.
class LossWatch {
 public:
  /// An IMU reading: while they come, whoever carries the sensor away does not go unnoticed.
  void note_reading(double time);
  /// A scan has ended.
  void note_scan(double time);
  /// A frame was believed; `by_imu`: its pose rests on the IMU too.
  void note_pose(double time, bool by_imu);
  /// The pose is lost, since the last frame that was believed.
  void lose();

  bool is_lost() const { return is_lost_; }
  /// Whether a pose at `time` must not be believed just because a scan fits there.
  bool is_overdue(double time) const;
  /// Since the last frame that was believed [s].
  double silence(double time) const { return time - believed_time_; }

  /// "the pose was lost from 3.1 to 6.0 s, found again": counted from the first scan; empty when it
  /// never was.
  std::string finding() const;

 private:
  struct Span {
    double begin, end;
  };

  std::optional<double> first_time_;  ///< of a scan
  double scan_time_ = 0.0;            ///< of the last
  std::optional<double> interval_;    ///< usual, between scans
  double believed_time_ = std::numeric_limits<double>::infinity();
  bool is_by_imu_ = false;
  std::optional<double> reading_time_;  ///< of the last
  double imu_gap_ = 0.0;                ///< longest since the last frame that was believed
  bool is_lost_ = false;
  std::vector<Span> losses_;  ///< that are told
  std::size_t untold_ = 0;
};

}  // namespace nvm::lio
