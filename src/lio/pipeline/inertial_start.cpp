// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// How the IMU joins the scans, and leaves them: a part of InertialPipeline.
#include <algorithm>
#include <string>
#include <vector>

#include "lio/imu/imu_findings.hpp"
#include "lio/pipeline/inertial_pipeline.hpp"

namespace nvm::lio {

namespace {

constexpr double kRejoinAfter = 3.0;  // what has failed once must prove itself for longer [s]

}  // namespace

// All readings go to the judge, and until the first state to the initializer.
void InertialPipeline::read_imu(double until) {
  constexpr double kMaxAge = 2.0;  // older ones are of another time, or of a clock that is [s]
  first_time_ = first_time_.value_or(until);
  imu_.between(std::max(read_until_, until - kMaxAge), until, 0.0, samples_);
  for (const ImuSample& sample : samples_) {
    if (sample.time > read_until_) {
      judge_.add(sample);
      read_until_ = sample.time;
      if (!filter_ && !is_alone_) {
        unread_.push_back(sample);
      }
    }
  }
}

/// From the state's time on, mended.
void InertialPipeline::take_readings(double until, double max_gap) {
  imu_.between(filter_->state().time, until, max_gap, samples_);
  for (ImuSample& sample : samples_) {
    sample = judge_.mended(sample);
  }
}

bool InertialPipeline::initialize(FrameResult& result) {
  for (; judge_.knows_unit() && !unread_.empty(); unread_.pop_front()) {
    const ImuSample sample = judge_.mended(unread_.front());
    initializer_.add(sample);
    noise_learner_.add(sample);
    if (std::optional<InitialState> initial = initializer_.state()) {
      if (judge_.judge_rest(initial->rest_force) == ImuVerdict::kUnusable) {
        is_imu_usable_ = false;
        return false;
      }
      initial->covariance.diagonal() += extrinsic_deviations().cwiseAbs2();
      initial->state.T_body_lidar = options_.T_imu_lidar;
      if (start_) {
        move_to(*start_, *initial);
      }
      imu_noise_ = noise_learner_.complete(options_.imu_noise, true);
      filter_.emplace(initial->state, initial->covariance, imu_noise_);
      motion_ = ConstantVelocity({sample.time, initial->state.T_world_body});
      return true;
    }
  }
  result.message = initializer_.why_not();
  return false;
}

// The scans need not wait for the IMU when it moves, makes no sense or is not there.
bool InertialPipeline::is_to_go_alone(double time) {
  constexpr double kPatience = 0.5;  // [s]
  const double patience = options_.initializer.moving_start_after;
  const bool is_silent = time - std::max(*first_time_, read_until_) > kPatience;
  return !is_imu_usable_ || (patience >= 0.0 && (initializer_.is_hopeless() || is_silent));
}

// What the filter knows of a pose that was lost says nothing of another: the IMU joins again.
void InertialPipeline::start_at(const Pose& T_map_body) {
  start_ = T_map_body;
  if (filter_ || is_alone_) {
    motion_ = ConstantVelocity({LidarOdometry::kLongAgo, T_map_body});
    go_alone(motion_);
  }
}

void InertialPipeline::go_alone(const ConstantVelocity& motion) {
  alone_.continue_from(motion);
  motion_ = motion;
  judge_.forget();
  is_alone_ = true;
}

// Each time soon after the last it must prove itself for twice as long: after the third for longer
// than it is heard.
void InertialPipeline::leave_imu(const ConstantVelocity& motion) {
  constexpr double kSoon = 30.0;  // [s]
  const double now = filter_->state().time;
  first_contradiction_ = contradictions_ == 0 ? now - *first_time_ : first_contradiction_;
  ++contradictions_;
  join_after_ = now - left_time_ < kSoon ? std::max(kRejoinAfter, 2.0 * join_after_) : kRejoinAfter;
  left_time_ = now;
  go_alone(motion);
}

FrameResult InertialPipeline::process_alone(const Scan& scan) {
  constexpr double kToSettle = 0.5;  // [s]
  is_scan_alone_ = true;
  FrameResult result = alone_.process(scan);
  imu_.use_until(scan.t_end);
  if (is_believed(result.status) && is_imu_usable_) {
    judge_.add(StampedPose{result.time, result.T_map_body});
    if (result.time > motion_.last().time) {
      motion_.add({result.time, result.T_map_body});
    }
    const ImuVerdict inspection = judge_.inspect(result.time);
    const ImuVerdict verdict = judge_.judge(join_after_);
    follow_imu_clock();
    is_imu_usable_ = inspection != ImuVerdict::kUnusable && verdict != ImuVerdict::kUnusable;
    // Where the scans slide they tell no velocity to begin with.
    slid_time_ = result.unobserved.empty() ? slid_time_ : result.time;
    if (is_imu_usable_ && verdict == ImuVerdict::kGood && result.time - slid_time_ > kToSettle) {
      join_imu(*judge_.motion());
    }
  }
  result.imu_time_offset = imu_time_offset_;
  return result;
}

const DeskewedScan& InertialPipeline::scan() const {
  return is_scan_alone_ ? alone_.scan() : prepared_.scan;
}

const std::vector<Eigen::Vector3f>& InertialPipeline::normals() const {
  return is_scan_alone_ ? alone_.normals() : prepared_.normals;
}

void InertialPipeline::join_imu(const MotionFit& motion) {
  InitialState initial = moving_state(
      motion_.last(), motion.velocity, motion.gravity.normalized() * options_.initializer.gravity);
  initial.state.gyro_bias = motion.gyro_bias;
  initial.state.T_body_lidar = options_.T_imu_lidar;
  initial.covariance.diagonal() += extrinsic_deviations().cwiseAbs2();
  imu_noise_ = noise_learner_.complete(options_.imu_noise, false);
  if (!filter_) {
    joined_after_ = motion_.last().time - *first_time_;
  }
  filter_.emplace(initial.state, initial.covariance, imu_noise_);
  is_alone_ = false;
  believed_ = 0;
  believed_doubt_ = 0.0;
}

// A scale that is off looked like a bias at rest.
void InertialPipeline::forget_accel_bias() {
  constexpr double kBiasDeviation = 0.1;  // [m/s^2]
  NavState state = filter_->state();
  NavCovariance covariance = filter_->covariance();
  state.accel_bias.setZero();
  covariance.middleRows<3>(kAccelBias).setZero();
  covariance.middleCols<3>(kAccelBias).setZero();
  covariance.diagonal().segment<3>(kAccelBias).setConstant(kBiasDeviation * kBiasDeviation);
  filter_.emplace(state, covariance, imu_noise_);
}

// Watches what is believed, and goes on alone when it is lost or contradicts the IMU.
void InertialPipeline::judge_imu(const FrameResult& result) {
  constexpr std::size_t kFirst = 20;  // frames
  ImuVerdict verdict = ImuVerdict::kUnknown;
  if (is_believed(result.status)) {
    judge_.add(StampedPose{result.time, result.T_map_body});
    ++believed_;
    const bool is_due = believed_ >= kFirst && (believed_ & (believed_ - 1)) == 0;
    verdict = believed_ == kFirst || is_due ? judge_.watch() : verdict;
    const ImuVerdict inspection = judge_.inspect(result.time);
    follow_imu_clock();
    if (inspection == ImuVerdict::kMended) {
      forget_accel_bias();
    }
    verdict = inspection == ImuVerdict::kUnusable ? inspection : verdict;
  }
  is_imu_usable_ = verdict != ImuVerdict::kUnusable;
  if (result.status == FrameStatus::kInitializing && !is_sure()) {
    // Without a map the IMU has lost its velocity, and only the attitude holds.
    go_alone(ConstantVelocity({result.time, result.T_map_body}));
    return;
  }
  const bool is_changed = verdict == ImuVerdict::kMended || verdict == ImuVerdict::kDoubtful;
  if (result.status == FrameStatus::kLost || !is_imu_usable_ || is_changed) {
    join_after_ = std::max(kRejoinAfter, join_after_);
    go_alone(motion_);
  }
}

void InertialPipeline::follow_imu_clock() {
  const double offset = judge_.take_clock_offset();
  imu_.move(-offset);
  read_until_ -= offset;
  imu_time_offset_ -= offset;
}

std::optional<ImuSetup> InertialPipeline::better_imu_setup() const {
  return is_imu_usable_ ? judge_.better_setup() : std::nullopt;
}

std::vector<std::string> InertialPipeline::findings() const {
  const bool was_left = contradictions_ > 0 || (is_alone_ && map_->size() > 0);
  const std::string frozen = was_left ? judge_.frozen_axis() : "";
  std::vector<std::string> findings =
      frozen.empty() ? judge_.summary() : std::vector<std::string>{frozen};
  const bool is_explained =
      !frozen.empty() || !judge_.findings().empty() || (!findings.empty() && !is_alone_);
  const std::string doubt = is_explained ? "" : why_left();
  const std::string misled = findings.empty() && doubt.empty() ? predictions_.finding() : "";
  for (const std::string& line : {doubt, misled, left_out_finding(imu_.stats())}) {
    if (!line.empty()) {
      findings.push_back(line);
    }
  }
  if (findings.empty() && joined_after_ > 0.0) {
    findings.push_back(late_start_finding(joined_after_, initializer_.is_hopeless()));
  }
  if (const std::string times = alone_.deskew_watch().finding(); !times.empty()) {
    findings.insert(findings.begin(), times);
  }
  return findings;
}

// Where its judge has found no cause; empty when it was not left.
std::string InertialPipeline::why_left() const {
  constexpr double kEnded = 0.5;  // [s]
  const double silence = motion_.last().time - read_until_;
  if (first_time_ && read_until_ > *first_time_ && silence > kEnded) {
    return early_end_finding(silence);
  }
  if (contradictions_ > 0) {
    return contradiction_finding(contradictions_, first_contradiction_, is_alone_);
  }
  if (!is_alone_ || map_->size() == 0) {  // without a map the scans tell nothing either
    return "";
  }
  return read_until_ < *first_time_
             ? "no IMU reading is as old as a scan: there are none, or their clocks differ (set "
               "imu.time_offset); the scans alone are used"
             : "the IMU has not told the motion that the scans tell: the scans alone are used";
}

// The first scan makes the map where the assumed extrinsic puts it, so that in this map the body's
// pose and gravity are as unsure as the extrinsic.
NavVector InertialPipeline::extrinsic_deviations() const {
  NavVector deviations = NavVector::Zero();
  for (const NavIndex part : {kPosition, kLidarPosition}) {
    deviations.segment<3>(part).setConstant(options_.extrinsic_translation_deviation);
  }
  for (const NavIndex part : {kRotation, kLidarRotation}) {
    deviations.segment<3>(part).setConstant(options_.extrinsic_rotation_deviation);
  }
  deviations.segment<2>(kGravity).setConstant(options_.extrinsic_rotation_deviation);
  return deviations;
}

}  // namespace nvm::lio
