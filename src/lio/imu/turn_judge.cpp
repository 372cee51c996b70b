// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// What an ImuJudge makes of turns: the gyroscope's units, axes and clock.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/printed.hpp"
#include "lio/imu/imu_findings.hpp"
#include "lio/imu/imu_judge.hpp"
#include "lio/imu/is_about.hpp"

namespace nvm::lio {

namespace {

constexpr double kDegree = 0.017453292519943295;  // [rad]
constexpr double kAgrees = 0.1;                   // a mismatch that is left by what explains it

double angle_of(const Eigen::Matrix3d& rotation) { return so3_log(rotation).norm(); }

/// Whether the gyroscope's scale alone is off, by more than the 1 or 2 % that gyroscopes are. What
/// other clocks or axes leave unexplained is not.
bool has_wrong_scale(const TurnComparison& turns) {
  constexpr double kMinScaleError = 0.04, kMaxScaleError = 0.5;  // beyond are units
  constexpr double kDeviations = 6.0;
  constexpr double kMinTurned = 1.5;  // [rad]
  constexpr double kMaxUnexplained = 0.01;
  const double error = std::abs(turns.scale_of_changes - 1.0);
  return turns.turned >= kMinTurned && turns.offset == 0.0 && error > kMinScaleError &&
         error < kMaxScaleError && error > kDeviations * turns.scale_deviation &&
         turns.unexplained_changes < kMaxUnexplained;
}

/// Whether one set of axes is: then nearly all is explained that way, and less by a rotation.
bool is_left_handed(const TurnComparison& turns) {
  return turns.reflected_mismatch < std::min(kAgrees, 0.5 * turns.best_mismatch);
}

/// A factor that no scale error reaches.
bool has_other_unit(const TurnComparison& turns) {
  constexpr double kMinTurned = 0.8;  // [rad]
  constexpr double kFactor = 2.0;
  return turns.turned >= kMinTurned && (turns.scale > kFactor || turns.scale < 1.0 / kFactor) &&
         turns.scale > 0.0;
}

/// Exactly that of degrees and thousandths when it is one of these.
double gyro_unit(double scale) {
  constexpr double kTolerance = 0.2;
  for (const double unit : {kDegree, 1e-3}) {
    if (is_about(scale, unit, kTolerance)) {
      return unit;
    }
  }
  return scale;
}

/// The scans are a mirror image when the gyroscope fits them after half a turn, but accelerations
/// are then felt the wrong way round: what a mirror does to turns, which are axial, and to forces.
/// Nothing while the motion is too short to tell.
std::optional<bool> are_scans_mirrored(const TurnComparison& turns, MotionHistory history) {
  constexpr double kHalfTurn = 2.8;  // [rad]
  constexpr double kDuration = 8.0;  // [s]
  constexpr double kMaxDeviation = 0.25;
  if (turns.is_about_one_axis || angle_of(turns.rotation) < kHalfTurn) {
    return false;
  }
  history.turn_readings(turns.rotation);
  const std::optional<MotionFit> fit = fit_motion(history, kDuration, 0.0);
  if (fit && fit->accel_scale_deviation < kMaxDeviation) {
    return fit->accel_scale < 0.0;
  }
  return history.duration() < kDuration ? std::nullopt : std::optional(false);
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

// A gyroscope that is turned in its housing is not the LiDAR's mount: that turns both sensors.
void ImuJudge::weigh_rotation(double duration) {
  const auto found = axes_.finding();
  if (!found) {
    return;
  }
  MotionHistory turned = history_;
  turned.turn_readings(found->rotation);
  const std::optional<MotionFit> fit = fit_motion(history_, duration, 1.0);
  const std::optional<MotionFit> fit_turned = fit_motion(turned, duration, 1.0);
  if (fit && fit_turned) {
    sq_misfit_ += fit->position_rms * fit->position_rms;
    sq_misfit_turned_ += fit_turned->position_rms * fit_turned->position_rms;
  }
}

// A dead axis turns all that the others tell.
std::optional<AxesWatch::Finding> ImuJudge::learned_axes() const {
  constexpr double kClearly = 0.8;
  const bool is_witnessed = sq_misfit_turned_ < kClearly * sq_misfit_;
  return contradicts_ || gyro_clipping_.frozen() || !is_witnessed ? std::nullopt : axes_.finding();
}

ImuVerdict ImuJudge::judge_turns(double max_mismatch, bool are_poses_apart) {
  constexpr double kSmallTurn = 0.25;  // [rad]
  constexpr double kConclusive = 1.5;  // an offset of the clocks may yet explain less [rad]
  const std::optional<TurnComparison> turns = compare_turns(history_);
  if (!turns) {
    return ImuVerdict::kUnknown;
  }
  const bool is_explained = turns->best_mismatch < kAgrees;
  const bool is_turned = angle_of(turns->rotation) > kSmallTurn && !is_left_handed(*turns);
  if (mend_offset(*turns, is_explained) || (!is_turned && mend_gyro(*turns, is_explained))) {
    return ImuVerdict::kMended;
  }
  if (turns->mismatch <= max_mismatch) {
    return ImuVerdict::kGood;
  }
  if (turns->turned < kConclusive) {
    return ImuVerdict::kUnknown;
  }
  if (!are_poses_apart) {
    history_.clear();
    return ImuVerdict::kDoubtful;
  }
  const std::optional<bool> are_mirrored = are_scans_mirrored(*turns, history_);
  if (is_explained && is_turned && !are_mirrored) {
    return ImuVerdict::kUnknown;
  }
  tell_contradiction(*turns, is_explained && is_turned, are_mirrored.value_or(false));
  return ImuVerdict::kUnusable;
}

// An offset that may not be mended is told.
bool ImuJudge::mend_offset(const TurnComparison& turns, bool is_explained) {
  constexpr double kMaxOffset = 0.6;  // in all: of other recordings something always fits [s]
  has_offset_ = turns.offset != 0.0 && is_explained;
  if (!has_offset_) {
    return false;
  }
  if (options_.learns_time_offset && std::abs(clocks_.mended() + turns.offset) <= kMaxOffset) {
    mend_clock(turns.offset);
    return true;
  }
  tell(offset_finding(turns.offset));
  tells_offset_ = true;
  return false;
}

bool ImuJudge::mend_gyro(const TurnComparison& turns, bool is_explained) {
  if (options_.gyro_scale != 0.0) {
    return false;
  }
  if (has_wrong_scale(turns)) {
    gyro_scale_ *= turns.scale_of_changes;
    tell(gyro_scale_finding(turns.scale_of_changes, gyro_scale_));
  } else if (is_explained && has_other_unit(turns)) {
    gyro_scale_ *= gyro_unit(turns.scale);
    tell(gyro_unit_finding(1.0 / turns.scale, gyro_scale_));
  } else {
    return false;
  }
  has_mended_gyro_ = true;
  history_.clear();
  return true;
}

void ImuJudge::tell_contradiction(const TurnComparison& turns, bool is_turned, bool are_mirrored) {
  contradicts_ = true;
  if (is_turned && is_about(turns.scale, 1.0, 0.2)) {
    tell(
        are_mirrored ? mirrored_scans_finding(Eigen::AngleAxisd(turns.rotation).axis())
                     : rotation_finding(turns, T_body_lidar_));
  } else if (is_left_handed(turns)) {
    tell(left_handed_finding(turns.reflection));
  } else if (!has_offset_) {
    tell(printed(
        "the gyroscope does not turn as the scans do (they differ by %.0f %% of %.1f rad): is "
        "it this LiDAR's IMU, on its clock? The scans alone are used",
        100.0 * std::sqrt(turns.mismatch),
        turns.turned));
  }
}

}  // namespace nvm::lio
