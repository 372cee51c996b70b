// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_judge.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "common/printed.hpp"
#include "lio/imu/imu_findings.hpp"
#include "lio/imu/is_about.hpp"

namespace nvm::lio {

namespace {

constexpr double kStandardGravity = 9.80665;  // [m/s^2]

/// Scans and accelerometer tell the same motion: poses this near to the fit [m], and gravity.
constexpr double kMaxRms = 0.03;
constexpr double kGravityError = 0.08;  // share

/// Times gravity, that nobody feels for long.
constexpr double kMuch = 5.0;

/// What makes m/s^2 of readings that are `force` long where `gravity` is felt.
double accel_unit(double force, double gravity) {
  return force > kMuch * gravity ? gravity / force : kStandardGravity;
}

/// Length of the mean of `readings`, and how far they are from it.
std::pair<double, double> steadiness(
    const std::vector<ImuSample>& readings, Eigen::Vector3d ImuSample::*part) {
  const auto count = static_cast<double>(readings.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImuSample& reading : readings) {
    mean += reading.*part / count;
  }
  double variance = 0.0;
  for (const ImuSample& reading : readings) {
    variance += (reading.*part - mean).squaredNorm() / count;
  }
  return {mean.norm(), std::sqrt(variance)};
}

bool is_final(ImuVerdict verdict) {
  return verdict == ImuVerdict::kMended || verdict == ImuVerdict::kDoubtful ||
         verdict == ImuVerdict::kUnusable;
}

}  // namespace

ImuJudge::ImuJudge(const ImuInputOptions& options, const Pose& T_body_lidar, double gravity)
    : options_((options.validate(), options)),
      T_body_lidar_(T_body_lidar),
      gravity_(gravity),
      gyro_scale_(options.gyro_scale == 0.0 ? 1.0 : options.gyro_scale),
      accel_scale_(options.accel_scale == 0.0 ? 1.0 : options.accel_scale) {}

ImuSample ImuJudge::mended(const ImuSample& reading) const {
  const auto& [gyro, accel] =
      are_swapped_ ? std::tie(reading.accel, reading.gyro) : std::tie(reading.gyro, reading.accel);
  return {reading.time, gyro_scale_ * gyro, accel_scale_ * accel};
}

void ImuJudge::add(const ImuSample& reading) {
  if (!knows_unit()) {
    first_.push_back(reading);
    if (knows_unit()) {
      find_units();
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
  look_at_clock(time);
  if (time < inspected_ + kPeriod || history_.duration() < kPeriod) {
    return ImuVerdict::kUnknown;
  }
  axes_.look(history_, inspected_, clocks_.mended());
  weigh_rotation(kPeriod);
  inspected_ = time;
  ranges_.weigh(history_, kPeriod, gravity_);
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
  has_mended_accel_ = true;
  history_.clear();
  return ImuVerdict::kMended;
}

std::vector<std::string> ImuJudge::summary() const {
  std::vector<std::string> lines = findings_;
  const auto axes = learned_axes();
  const std::string turned = axes ? small_rotation_finding(axes->rotation, T_body_lidar_) : "";
  const bool are_clocks_known = !tells_offset_ && !contradicts_ && turned.empty();
  const std::string clocks = are_clocks_known ? clocks_.finding() : "";
  for (const std::string& line : {rest_.finding(accel_scale_), ranges_.finding(), turned, clocks}) {
    if (!line.empty()) {
      lines.push_back(line);
    }
  }
  return lines;
}

std::optional<ImuSetup> ImuJudge::better_setup() const {
  constexpr double kSmallOffset = 0.005;  // that costs next to nothing until it is mended [s]
  const auto axes = options_.learns_rotation ? learned_axes() : std::nullopt;
  const double lateness = axes ? axes->lateness : clocks_.mended();
  const bool was_elsewhen = std::abs(lateness) > kSmallOffset && clocks_.was_late_at_first();
  if (!has_mended_gyro_ && !has_mended_accel_ && !was_elsewhen && !axes) {
    return std::nullopt;
  }
  ImuSetup better{options_, T_body_lidar_};
  better.input.gyro_scale = has_mended_gyro_ ? gyro_scale_ : options_.gyro_scale;
  better.input.accel_scale = has_mended_accel_ ? accel_scale_ : options_.accel_scale;
  better.input.time_offset -= was_elsewhen ? lateness : 0.0;
  if (axes) {
    better.T_imu_lidar.linear() = axes->rotation.transpose() * T_body_lidar_.linear();
  }
  return better;
}

std::string ImuJudge::frozen_axis() const {
  if (const auto axis = gyro_clipping_.frozen()) {
    return frozen_finding("gyroscope", "rad/s", *axis, gyro_scale_);
  }
  const auto axis = accel_clipping_.frozen();
  return axis ? frozen_finding("accelerometer", "m/s^2", *axis, accel_scale_) : "";
}

// A sensor at rest, or nearly so, feels gravity and turns little, in whatever unit.
void ImuJudge::find_units() {
  constexpr double kSteady = 0.05;
  const auto [gyro, gyro_deviation] = steadiness(first_, &ImuSample::gyro);
  const auto [accel, accel_deviation] = steadiness(first_, &ImuSample::accel);
  const bool is_still = accel_deviation <= kSteady * accel;
  if (is_about(gyro, gravity_, 0.1) && gyro_deviation <= kSteady * gyro && accel < 0.1 * gravity_) {
    are_swapped_ = true;
    tell(printed(
        "the gyroscope reads %.2f and the accelerometer %.2f at rest: the driver has swapped them; "
        "swapped back",
        gyro,
        accel));
  } else if (
      options_.accel_scale == 0.0 && is_still &&
      (is_about(accel, 1.0, kSteady) || accel > kMuch * gravity_)) {
    mend_accel_unit(accel);
  }
}

void ImuJudge::mend_accel_unit(double force) {
  accel_scale_ = accel_unit(force, gravity_);
  tell(accel_unit_finding(force, accel_scale_));
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
  const ImuVerdict turns = judge_turns(kMaxMismatch, true);
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
  const ImuVerdict turns = judge_turns(kMaxMismatch, false);
  return is_final(turns) ? turns : judge_sign(turns);
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
  const double felt = fit->gravity.norm();
  const std::optional<MotionFit> mended =
      fit_motion(history_, kDuration, accel_unit(felt, gravity_));
  if (mended && accel_scale_ == 1.0 && options_.accel_scale == 0.0 &&
      mended->position_rms <= kMaxRms &&
      is_about(mended->gravity.norm(), gravity_, kGravityError)) {
    mend_accel_unit(felt);
    has_mended_accel_ = true;
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
  has_mended_accel_ = true;
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

}  // namespace nvm::lio
