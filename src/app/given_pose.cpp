// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/given_pose.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nvm::app {

namespace {

constexpr std::size_t kUpright = 4;
constexpr std::size_t kAll = 7;

void check(const std::string& option, const std::vector<double>& numbers) {
  if (numbers.size() != kUpright && numbers.size() != kAll) {
    throw std::invalid_argument(fmt::format(
        "{} must be 4 numbers x,y,z,yaw or 7 numbers x,y,z,qx,qy,qz,qw, not {}",
        option,
        numbers.size()));
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
    throw std::invalid_argument(option + ": its numbers must be finite");
  }
}

Eigen::Matrix3d rotation(const std::string& option, const std::vector<double>& numbers) {
  constexpr double kMaxLengthError = 0.01;
  constexpr double kMostYaw = 6.2831853071795865;
  if (numbers.size() == kUpright) {
    if (std::abs(numbers[3]) > kMostYaw) {
      throw std::invalid_argument(fmt::format(
          "{}: the yaw {} is not within -2 pi to 2 pi: it is in radians", option, numbers[3]));
    }
    return so3_exp({0.0, 0.0, numbers[3]});
  }
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(q.norm() - 1.0) > kMaxLengthError) {
    throw std::invalid_argument(option + ": qx qy qz qw must be a unit quaternion");
  }
  return q.normalized().toRotationMatrix();
}

}  // namespace

Pose given_pose(const std::string& option, const std::vector<double>& numbers) {
  check(option, numbers);
  Pose pose = Pose::Identity();
  pose.linear() = rotation(option, numbers);
  pose.translation() << numbers[0], numbers[1], numbers[2];
  return pose;
}

}  // namespace nvm::app
