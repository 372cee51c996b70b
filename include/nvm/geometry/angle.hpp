// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Compares angles between unit vectors by their cosine. Never through acos: on float-stored unit
/// vectors the dot product of two equal vectors exceeds 1 half of the time, and its acos is NaN.
class AngleLimit {
 public:
  /// `limit` [rad], 0 to pi.
  explicit AngleLimit(double limit) : cosine_(std::cos(limit) - kResolution) {}

  /// True when the angle between the unit vectors `a` and `b` is at most the limit, to the
  /// resolution of float vectors: equal vectors are within 0, opposite ones within pi. False when
  /// either has a NaN.
  bool admits(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    return a.cast<double>().dot(b.cast<double>()) >= cosine_;
  }

 private:
  static constexpr double kResolution = 4e-7;  // of the dot product of two rounded unit vectors
  double cosine_;
};

}  // namespace NVM_TARGET
}  // namespace nvm
