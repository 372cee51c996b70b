// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/rest_force.hpp"

#include <algorithm>
#include <cmath>

#include "common/printed.hpp"
#include "lio/imu/motion_fit.hpp"

namespace nvm::lio {

namespace {

constexpr double kMinError = 0.03;  // share of gravity
constexpr double kConclusive = 5.0;

}  // namespace

void RestForce::set(const Eigen::Vector3d& force, double gravity) {
  force_ = force.norm();
  bias_ = force * (1.0 - gravity / force_);
  gravity_ = gravity;
  evidence_ = 0.0;
}

bool RestForce::is_off() const { return std::abs(force_ - gravity_) > kMinError * gravity_; }

bool RestForce::is_open() const { return is_off() && std::abs(evidence_) < kConclusive; }

// Errors of neighbouring poses go together, so that few of them count.
void RestForce::weigh(const MotionHistory& history, double duration) {
  constexpr double kPoseDeviation = 0.003;  // [m]
  constexpr double kCounting = 10.0;        // poses
  constexpr double kMostOfOne = 3.0;        // evidence of a single motion
  const auto by_scale = fit_motion(history, duration, gravity_ / force_);
  const auto by_bias = fit_motion(history, duration, 1.0, bias_);
  if (!by_scale || !by_bias) {
    return;
  }
  const double sq_scale = by_scale->position_rms * by_scale->position_rms;
  const double sq_bias = by_bias->position_rms * by_bias->position_rms;
  const double variance = std::min(sq_scale, sq_bias) + kPoseDeviation * kPoseDeviation;
  const double evidence = 0.5 * kCounting * (sq_bias - sq_scale) / variance;
  evidence_ += std::clamp(evidence, -kMostOfOne, kMostOfOne);
}

std::optional<double> RestForce::scale() const {
  return is_off() && evidence_ >= kConclusive ? std::optional(gravity_ / force_) : std::nullopt;
}

std::string RestForce::finding(double used_scale) const {
  if (!is_off()) {
    return "";
  }
  const std::string seen = printed(
      "the accelerometer feels %.2f m/s^2 at rest, where gravity is %.2f: ", force_, gravity_);
  if (scale()) {
    return seen + printed(
                      "its scale is off, as motion shows: multiplied by %.4g (imu.accel_scale "
                      "sets another factor, or 1 for none)",
                      used_scale);
  }
  if (!is_open()) {
    return seen + "it has a bias, as motion shows, which is estimated";
  }
  return seen + printed(
                    "taken for a bias; if its scale is off, set imu.accel_scale=%.4g",
                    used_scale * gravity_ / force_);
}

}  // namespace nvm::lio
