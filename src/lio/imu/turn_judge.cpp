// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// What an ImuJudge makes of turns: the gyroscope's units, axes and clock.
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "common/printed.hpp"
#include "lio/imu/imu_findings.hpp"
#include "lio/imu/imu_judge.hpp"
#include "lio/imu/is_about.hpp"

namespace nvm::lio {

namespace {

constexpr double kDegree = 0.017453292519943295;  // [rad]

double angle_of(const Eigen::Matrix3d& rotation) { return so3_log(rotation).norm(); }

/// Whether the gyroscope's scale alone is off, by more than the 1 or 2 % that gyroscopes are. What
/// other clocks or axes leave unexplained is not.
bool has_wrong_scale(const TurnComparison& turns) {
  constexpr double kMinError = 0.04, kMaxError = 0.5;  // beyond are units
  constexpr double kDeviations = 6.0;
  constexpr double kMinTurned = 1.5;  // [rad]
  constexpr double kMaxUnexplained = 0.01;
  const double error = std::abs(turns.scale_of_changes - 1.0);
  return turns.turned >= kMinTurned && turns.offset == 0.0 && error > kMinError &&
         error < kMaxError && error > kDeviations * turns.scale_deviation &&
         turns.unexplained_changes < kMaxUnexplained;
}

}  // namespace

void ImuJudge::look_at_clock(double time) {
  constexpr double kPeriod = 1.5;  // [s]
  if (time < tried_clock_ + kPeriod || history_.duration() < kPeriod) {
    return;
  }
  tried_clock_ = time;
  clocked_ = clocks_.look(history_, clocked_) ? time : clocked_;
  if (const auto offset = clocks_.offset(); offset && options_.learns_time_offset) {
    mend_clock(*offset);
  }
}

void ImuJudge::mend_clock(double offset) {
  clocks_.mend(offset);
  untaken_offset_ += offset;
  history_.move_readings(-offset);
}

double ImuJudge::take_clock_offset() { return std::exchange(untaken_offset_, 0.0); }

ImuVerdict ImuJudge::judge_turns(double max_mismatch, bool are_poses_apart) {
  constexpr double kAgrees = 0.1;
  constexpr double kSmallTurn = 0.25;  // [rad]
  constexpr double kMaxOffset = 0.6;   // in all: of other recordings something always fits [s]
  const std::optional<TurnComparison> turns = compare_turns(history_);
  if (!turns) {
    return ImuVerdict::kUnknown;
  }
  const bool is_explained = turns->best_mismatch < kAgrees;
  const bool is_turned = angle_of(turns->rotation) > kSmallTurn;
  has_offset_ = turns->offset != 0.0 && is_explained;
  if (has_offset_ && options_.learns_time_offset &&
      std::abs(clocks_.mended() + turns->offset) <= kMaxOffset) {
    mend_clock(turns->offset);
    return ImuVerdict::kMended;
  }
  if (has_offset_) {
    tell(offset_finding(turns->offset));
    tells_offset_ = true;
  }
  const bool may_mend = !is_turned && options_.gyro_scale == 0.0;
  if (may_mend && has_wrong_scale(*turns)) {
    const double scale = turns->scale_of_changes;
    return mend_gyro(
        scale,
        printed(
            "the gyroscope turns by %.1f %% too %s for the scans: multiplied by %.4g "
            "(imu.gyro_scale sets another factor, or 1 for none)",
            100.0 * std::abs(1.0 / scale - 1.0),
            scale < 1.0 ? "much" : "little",
            scale * gyro_scale_));
  }
  if (turns->mismatch <= max_mismatch) {
    return ImuVerdict::kGood;
  }
  if (may_mend && is_explained && is_about(turns->scale, kDegree, 0.2)) {
    return mend_gyro(
        kDegree,
        printed(
            "the gyroscope turns %.1f times as fast as the scans, so it measures in degrees per "
            "second: multiplied by 0.0174533 (imu.gyro_scale sets another factor)",
            1.0 / turns->scale));
  }
  constexpr double kConclusive = 1.5;  // an offset of the clocks may yet explain it [rad]
  if (turns->turned < kConclusive) {
    return ImuVerdict::kUnknown;
  }
  if (!are_poses_apart) {
    history_.clear();
    return ImuVerdict::kDoubtful;
  }
  tell_contradiction(*turns, is_explained && is_turned);
  return ImuVerdict::kUnusable;
}

void ImuJudge::tell_contradiction(const TurnComparison& turns, bool is_turned) {
  if (is_turned && is_about(turns.scale, 1.0, 0.2)) {
    tell(rotation_finding(turns, T_body_lidar_));
  } else if (!has_offset_) {
    tell(printed(
        "the gyroscope does not turn as the scans do (they differ by %.0f %% of %.1f rad): is "
        "it this LiDAR's IMU, on its clock? The scans alone are used",
        100.0 * std::sqrt(turns.mismatch),
        turns.turned));
  }
}

ImuVerdict ImuJudge::mend_gyro(double factor, std::string finding) {
  gyro_scale_ *= factor;
  history_.clear();
  tell(std::move(finding));
  return ImuVerdict::kMended;
}

}  // namespace nvm::lio
