// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_noise_learner.hpp"

#include <algorithm>
#include <cmath>

namespace nvm::lio {

namespace {

constexpr double kMaxStillInterval = 0.05;  // [s]: beyond it motion shows in the differences
constexpr double kBlockDuration = 0.1;      // [s]
constexpr std::size_t kMinThirds = 50;
constexpr std::size_t kMinSteps = 6;
constexpr double kMaxCoarse = 2.0;
constexpr double kLeast = 0.5;
constexpr double kMost = 16.0;

double learned(double given, double usual, double density) {
  if (given > 0.0) {
    return given;
  }
  return density > 0.0 ? std::clamp(density, kLeast * usual, kMost * usual) : usual;
}

}  // namespace

void ImuNoiseLearner::add(const ImuSample& sample) {
  const double interval = sample.time - last_time_;
  if (!has_time_ || !(interval > 0.0 && interval <= kMaxStillInterval)) {
    gyro_.interrupt();
    accel_.interrupt();
  } else {
    gyro_.add(sample.gyro, interval);
    accel_.add(sample.accel, interval);
  }
  last_time_ = sample.time;
  has_time_ = true;
}

ImuNoise ImuNoiseLearner::complete(const ImuNoise& given, bool at_rest) const {
  const ImuNoise usual;
  ImuNoise noise = given;
  noise.gyro = learned(given.gyro, usual.gyro, gyro_.density(at_rest));
  noise.accel = learned(given.accel, usual.accel, accel_.density(at_rest));
  return noise;
}

void ImuNoiseLearner::Triad::add(const Eigen::Vector3d& reading, double interval) {
  if (run_ >= 3) {
    // White noise of variance s^2 gives third differences of 20 s^2.
    const Eigen::Vector3d third = reading - 3.0 * last_[0] + 3.0 * last_[1] - last_[2];
    sum_sq_third_ += third.squaredNorm() / (3.0 * 20.0);
    sum_intervals_ += interval;
    ++thirds_;
  }
  last_ = {reading, last_[0], last_[1]};
  ++run_;
  block_ += interval * reading;
  block_duration_ += interval;
  if (block_duration_ < kBlockDuration) {
    return;
  }
  const Eigen::Vector3d mean = block_ / block_duration_;
  if (has_mean_) {
    sum_sq_steps_ += block_duration_ * (mean - last_mean_).squaredNorm() / (3.0 * 2.0);
    ++steps_;
  }
  last_mean_ = mean;
  has_mean_ = true;
  block_.setZero();
  block_duration_ = 0.0;
}

void ImuNoiseLearner::Triad::interrupt() {
  run_ = 0;
  has_mean_ = false;
  block_.setZero();
  block_duration_ = 0.0;
}

double ImuNoiseLearner::Triad::density(bool at_rest) const {
  const double from_readings = fine();
  return at_rest && from_readings > 0.0 && steps_ >= kMinSteps
             ? std::clamp(coarse(), from_readings, kMaxCoarse * from_readings)
             : from_readings;
}

double ImuNoiseLearner::Triad::fine() const {
  if (thirds_ < kMinThirds) {
    return 0.0;
  }
  const auto count = static_cast<double>(thirds_);
  return std::sqrt(sum_sq_third_ / count * sum_intervals_ / count);
}

double ImuNoiseLearner::Triad::coarse() const {
  return std::sqrt(sum_sq_steps_ / static_cast<double>(steps_));
}

}  // namespace nvm::lio
