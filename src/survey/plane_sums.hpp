// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "eval/walls/oriented_plane.hpp"

namespace nvm::survey {

/// Number, sum and sum of outer products of points [m], relative to the middle of the cloud: all
/// that a plane through them needs.
struct PlaneSums {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) {
    count += 1.0;
    sum += p;
    products.noalias() += p * p.transpose();
  }

  PlaneSums& operator+=(const PlaneSums& other) {
    count += other.count;
    sum += other.sum;
    products += other.products;
    return *this;
  }

  Eigen::Vector3d mean() const { return sum / count; }
};

/// The total-least-squares plane of points that look along `outward`; nothing when they are less
/// than three, or lie along a line or in a ball.
std::optional<eval::OrientedPlane> fit_plane(const PlaneSums& sums, const Eigen::Vector3d& outward);

/// Root mean square distance of the points to `plane` [m]. Needs count > 0.
double rms_distance(const PlaneSums& sums, const eval::OrientedPlane& plane);

}  // namespace nvm::survey
