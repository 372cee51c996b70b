// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>

#include "lio/imu/motion_history.hpp"

namespace nvm::lio {

/// Learns how late the IMU's clock is: how much later the gyroscope turns than the scans do. Poses
/// that lean on the IMU hide a part of it, which shows once the rest is mended.
class ClockWatch {
 public:
  /// Takes what has turned since `begin` [s], in a `history` whose readings have been moved by all
  /// that was mended. False when that was too little to tell anything: look again later, from the
  /// same time; else stretches must not overlap.
  bool look(const MotionHistory& history, double begin);

  /// What is still left to mend [s], positive where readings are stamped too late; nothing unless
  /// it is sure and worth it.
  std::optional<double> offset() const;
  /// The readings have been moved by `-offset` [s].
  void mend(double offset);
  /// The sum of all that was mended [s].
  double mended() const { return mended_; }
  /// Whether what was mended showed from the beginning, as far as poses did not hide it: a clock
  /// that drifts or leaps was right at first.
  bool was_late_at_first() const;

  /// One line; empty while the clocks agree or nothing has turned enough to tell.
  std::string finding() const;

 private:
  struct Line {
    double begin, end;  ///< offset at the first and the last stretch [s]
  };

  void note(double time, double offset, double variance);
  Line fit() const;

  double left_ = 0.0;               ///< [s]
  double variance_ = 0.05 * 0.05;   ///< of left_ [s^2]
  double time_ = 0.0;               ///< of the last look [s]
  double mended_ = 0.0;             ///< [s]
  std::optional<double> earliest_;  ///< offset by the first that was sure, or mended before any [s]
  // Sums over the stretches, each with the weight that it is sure: of 1, time, offset, ...
  double first_ = 0.0;  ///< time of the first [s]
  double w_ = 0.0, wt_ = 0.0, wo_ = 0.0, wtt_ = 0.0, wto_ = 0.0;
};

}  // namespace nvm::lio
