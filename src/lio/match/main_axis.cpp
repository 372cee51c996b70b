// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/main_axis.hpp"

#include <Eigen/Eigenvalues>

namespace nvm::lio {

void MainAxis::add(const std::vector<Eigen::Vector3d>& directions) {
  for (const Eigen::Vector3d& direction : directions) {
    scatter_ += direction * direction.transpose();
  }
}

std::optional<Eigen::Vector3d> MainAxis::axis() const {
  if (scatter_.isZero()) {
    return std::nullopt;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter_);
  return eigen.eigenvectors().col(2);
}

}  // namespace nvm::lio
