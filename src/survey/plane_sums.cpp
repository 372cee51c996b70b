// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/plane_sums.hpp"

#include <algorithm>
#include <cmath>

#include "nvm/geometry/symmetric_eigen.hpp"

namespace nvm::survey {

std::optional<eval::OrientedPlane> fit_plane(
    const PlaneSums& sums, const Eigen::Vector3d& outward) {
  constexpr double kMinSqRatio = 4.0;  // at least twice as wide as thick
  if (sums.count < 3.0) {
    return std::nullopt;
  }
  const Eigen::Vector3d mean = sums.mean();
  const Eigen::Matrix3d scatter = sums.products - sums.count * mean * mean.transpose();
  const EigenDecomposition eigen = eigen_decomposition(scatter);
  if (!(eigen.values(1) > kMinSqRatio * std::max(eigen.values(0), 1e-12))) {
    return std::nullopt;
  }
  Eigen::Vector3d normal = eigen.vectors.col(0).normalized();
  if (normal.dot(outward) < 0.0) {
    normal = -normal;
  }
  return eval::OrientedPlane{normal, normal.dot(mean)};
}

double rms_distance(const PlaneSums& sums, const eval::OrientedPlane& plane) {
  const Eigen::Vector3d& n = plane.normal;
  const double sq_sum = n.dot(sums.products * n) - 2.0 * plane.offset * n.dot(sums.sum) +
                        sums.count * plane.offset * plane.offset;
  return std::sqrt(std::max(sq_sum, 0.0) / sums.count);
}

}  // namespace nvm::survey
