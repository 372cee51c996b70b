// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/degeneracy.hpp"

#include <Eigen/Eigenvalues>

namespace nvm::lio {

int remove_unobserved(Information& information, double mean_range, double min_observability) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  static_assert(kPosition == 0 && kRotation == 3, "the pose is the first part of the error state");
  const double total = information.matrix.topLeftCorner<3, 3>().trace();
  if (!(total > 0.0) || !(mean_range > 0.0)) {
    return 6;
  }
  Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Ones();
  scale.tail<3>().setConstant(1.0 / mean_range);
  const Matrix6 shares = scale.asDiagonal() * Matrix6(information.matrix.topLeftCorner<6, 6>()) *
                         scale.asDiagonal() / total;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(shares);
  Matrix6 keep = Matrix6::Identity();
  int removed = 0;
  for (; removed < 6 && eigen.eigenvalues()[removed] < min_observability; ++removed) {
    const Eigen::Matrix<double, 6, 1> direction = eigen.eigenvectors().col(removed);
    keep -= direction * direction.transpose();
  }
  if (removed > 0) {
    const Matrix6 unscaled = scale.asDiagonal() * keep * scale.cwiseInverse().asDiagonal();
    MeasuredMatrix projection = MeasuredMatrix::Identity();
    projection.topLeftCorner<6, 6>() = unscaled;
    information.matrix = (projection.transpose() * information.matrix * projection).eval();
    information.vector = (projection.transpose() * information.vector).eval();
  }
  return removed;
}

}  // namespace nvm::lio
