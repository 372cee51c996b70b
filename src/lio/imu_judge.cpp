// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu_judge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/imu_findings.hpp"
#include "lio/printed.hpp"
#include "nvm/core/require.hpp"

namespace nvm::lio {

namespace {

constexpr double kDegree = 0.017453292519943295;  // [rad]
constexpr double kStandardGravity = 9.80665;      // [m/s^2]

/// Scans and accelerometer tell the same motion: poses this near to the fit [m], and gravity.
constexpr double kMaxRms = 0.03;
constexpr double kGravityError = 0.08;  // share

bool is_about(double value, double expected, double share) {
  return std::abs(value - expected) <= share * std::abs(expected);
}

bool is_final(ImuVerdict verdict) {
  return verdict == ImuVerdict::kMended || verdict == ImuVerdict::kUnusable;
}

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

ImuJudge::ImuJudge(const ImuInputOptions& options, const Pose& T_body_lidar, double gravity)
    : options_((options.validate(), options)),
      T_body_lidar_(T_body_lidar),
      gravity_(gravity),
      gyro_scale_(options.gyro_scale == 0.0 ? 1.0 : options.gyro_scale),
      accel_scale_(options.accel_scale == 0.0 ? 1.0 : options.accel_scale) {}

ImuSample ImuJudge::mended(const ImuSample& reading) const {
  return {reading.time, gyro_scale_ * reading.gyro, accel_scale_ * reading.accel};
}

void ImuJudge::add(const ImuSample& reading) {
  constexpr double kMaxDifference = 0.05;  // from 1 g at rest
  if (!knows_unit()) {
    ++unit_count_;
    unit_sum_ += reading.accel;
    sq_unit_sum_ += reading.accel.squaredNorm();
    const Eigen::Vector3d mean = unit_sum_ / unit_count_;
    const double variance = sq_unit_sum_ / unit_count_ - mean.squaredNorm();
    const bool is_g =
        is_about(mean.norm(), 1.0, kMaxDifference) && variance <= kMaxDifference * kMaxDifference;
    if (knows_unit() && is_g && options_.accel_scale == 0.0) {
      measure_in_g();
    }
  }
  gyro_clipping_.add(reading.gyro);
  accel_clipping_.add(reading.accel);
  history_.add(mended(reading));
}

ImuVerdict ImuJudge::judge_rest(const Eigen::Vector3d& force) {
  constexpr double kTooLittle = 0.97;  // of gravity
  const auto stuck = accel_clipping_.stuck();
  if (stuck && force.norm() < kTooLittle * gravity_) {
    tell(clipping_finding("accelerometer", "m/s^2", *stuck, accel_scale_));
    return ImuVerdict::kUnusable;
  }
  if (options_.accel_scale == 0.0) {
    rest_.set(force, gravity_);
  }
  return ImuVerdict::kUnknown;
}

ImuVerdict ImuJudge::inspect(double time) {
  constexpr double kPeriod = 3.0;  // [s]
  if (const auto axis = gyro_clipping_.clipped()) {
    tell(clipping_finding("gyroscope", "rad/s", *axis, gyro_scale_));
    return ImuVerdict::kUnusable;
  }
  if (const auto axis = accel_clipping_.clipped()) {
    tell(clipping_finding("accelerometer", "m/s^2", *axis, accel_scale_));
    return ImuVerdict::kUnusable;
  }
  if (time < inspected_ + kPeriod || history_.duration() < kPeriod) {
    return ImuVerdict::kUnknown;
  }
  clocks_.look(history_, std::max(inspected_, time - kPeriod));
  inspected_ = time;
  return weigh_rest(kPeriod);
}

ImuVerdict ImuJudge::weigh_rest(double duration) {
  if (!rest_.is_open()) {
    return ImuVerdict::kUnknown;
  }
  rest_.weigh(history_, duration);
  if (!rest_.scale()) {
    return ImuVerdict::kUnknown;
  }
  accel_scale_ *= *rest_.scale();
  history_.clear();
  return ImuVerdict::kMended;
}

std::vector<std::string> ImuJudge::summary() const {
  std::vector<std::string> lines = findings_;
  const std::string clocks = tells_offset_ ? "" : clocks_.finding();
  for (const std::string& line : {rest_.finding(accel_scale_), clocks}) {
    if (!line.empty()) {
      lines.push_back(line);
    }
  }
  return lines;
}

void ImuJudge::measure_in_g() {
  accel_scale_ = kStandardGravity;
  tell(
      "the accelerometer measures in g, for it reads 1 where gravity is felt: multiplied by "
      "9.80665 (imu.accel_scale sets another factor)");
}

void ImuJudge::tell(std::string finding) {
  const bool is_new = std::find(findings_.begin(), findings_.end(), finding) == findings_.end();
  if (is_new) {
    findings_.push_back(std::move(finding));
  }
}

ImuVerdict ImuJudge::judge(double duration) {
  constexpr double kMaxMismatch = 0.06;  // a misalignment of 14 degrees
  constexpr double kUnturned = 6.0;      // [s]
  constexpr double kRounding = 0.01;     // [s]
  const ImuVerdict turns = judge_turns(kMaxMismatch);
  const ImuVerdict gravity = is_final(turns) ? turns : judge_gravity();
  const ImuVerdict sign = is_final(gravity) ? gravity : judge_sign(turns);
  if (is_final(sign)) {
    return sign;
  }
  // Who does not turn for long may begin without the gyroscope's proof.
  const bool has_proof = turns == ImuVerdict::kGood || history_.duration() >= kUnturned;
  const bool agrees = has_proof && history_.duration() >= duration - kRounding && motion();
  return agrees ? ImuVerdict::kGood : ImuVerdict::kUnknown;
}

ImuVerdict ImuJudge::watch() {
  constexpr double kMaxMismatch = 0.2;
  const ImuVerdict turns = judge_turns(kMaxMismatch);
  return is_final(turns) ? turns : judge_sign(turns);
}

ImuVerdict ImuJudge::judge_turns(double max_mismatch) {
  constexpr double kAgrees = 0.1;
  constexpr double kSmallTurn = 0.25;  // [rad]
  const std::optional<TurnComparison> turns = compare_turns(history_);
  if (!turns) {
    return ImuVerdict::kUnknown;
  }
  const bool is_explained = turns->best_mismatch < kAgrees;
  const bool is_turned = angle_of(turns->rotation) > kSmallTurn;
  has_offset_ = turns->offset != 0.0 && is_explained;
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

ImuVerdict ImuJudge::judge_gravity() {
  constexpr double kDuration = 1.0;  // [s]
  constexpr double kTolerance = 0.3;
  const std::optional<MotionFit> fit = fit_motion(history_, kDuration, 1.0);
  if (!fit || history_.duration() < 0.9 * kDuration) {
    return ImuVerdict::kUnknown;
  }
  if (is_about(fit->gravity.norm(), gravity_, kTolerance)) {
    return ImuVerdict::kGood;
  }
  const std::optional<MotionFit> in_g = fit_motion(history_, kDuration, kStandardGravity);
  if (in_g && accel_scale_ == 1.0 && options_.accel_scale == 0.0 && in_g->position_rms <= kMaxRms &&
      is_about(in_g->gravity.norm(), gravity_, kGravityError)) {
    measure_in_g();
    history_.clear();
    return ImuVerdict::kMended;
  }
  tell(gravity_finding(fit->gravity.norm(), gravity_));
  return ImuVerdict::kUnusable;
}

// Accelerations at wrong times may go against the scans' as well.
ImuVerdict ImuJudge::judge_sign(ImuVerdict turns) {
  constexpr double kDuration = 3.0;  // [s]
  constexpr double kMaxDeviation = 0.2;
  const std::optional<MotionFit> fit = fit_motion(history_, kDuration, 0.0);
  if (turns != ImuVerdict::kGood || has_offset_ || !fit ||
      fit->accel_scale_deviation > kMaxDeviation) {
    return ImuVerdict::kUnknown;
  }
  if (!is_about(fit->accel_scale, -1.0, 0.4) || options_.accel_scale != 0.0) {
    return ImuVerdict::kGood;
  }
  if (!is_about(fit->accel_scale, -1.0, kMaxDeviation)) {
    tell(mirror_finding());
    return ImuVerdict::kUnusable;
  }
  accel_scale_ = -accel_scale_;
  history_.clear();
  tell(
      "the accelerometer's sign is wrong: it reads the negative of what the scans' motion and "
      "gravity make it feel; turned round (imu.accel_scale=-1 says so from the beginning)");
  return ImuVerdict::kMended;
}

std::optional<MotionFit> ImuJudge::motion() const {
  constexpr double kDuration = 1.0;  // [s]
  const std::optional<MotionFit> fit = fit_motion(history_, kDuration, 1.0);
  const bool agrees = fit && history_.duration() >= 0.9 * kDuration &&
                      fit->position_rms <= kMaxRms &&
                      is_about(fit->gravity.norm(), gravity_, kGravityError);
  return agrees ? fit : std::nullopt;
}

void ImuInputOptions::validate() const {
  const auto finite = [](double value, const char* name) {
    require(std::isfinite(value), name, value, "a finite number");
  };
  finite(gyro_scale, "gyro_scale");
  finite(accel_scale, "accel_scale");
  finite(time_offset, "time_offset");
}

}  // namespace nvm::lio
