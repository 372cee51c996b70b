// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/degeneracy.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/printed.hpp"

namespace nvm::lio {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

static_assert(
    kPosition == 0 && kRotation == 3 && kVelocity == 6 && kGyroBias == 9,
    "the pose is the first part of the error state, its rates are the second");

/// With rotations as the arcs [m] that they make at a range.
Eigen::Matrix<double, 6, 1> arc_scale(double range, int rotation) {
  Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Ones();
  scale.segment<3>(rotation).setConstant(1.0 / range);
  return scale;
}

}  // namespace

UnobservedDirections remove_unobserved(
    Information& information, double mean_range, double min_observability) {
  const double total = information.matrix.topLeftCorner<3, 3>().trace();
  if (!(total > 0.0) || !(mean_range > 0.0)) {
    return UnobservedDirections::all();
  }
  const Eigen::Matrix<double, 6, 1> scale = arc_scale(mean_range, kRotation);
  const Matrix6 shares = scale.asDiagonal() * Matrix6(information.matrix.topLeftCorner<6, 6>()) *
                         scale.asDiagonal() / total;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(shares);
  Matrix6 keep = Matrix6::Identity();
  UnobservedDirections removed;
  for (int i = 0; i < 6 && eigen.eigenvalues()[i] < min_observability; ++i) {
    const Eigen::Matrix<double, 6, 1> direction = eigen.eigenvectors().col(i);
    keep -= direction * direction.transpose();
    removed.add(direction.head<3>(), direction.tail<3>());
  }
  if (removed.count() > 0) {
    const Matrix6 unscaled = scale.asDiagonal() * keep * scale.cwiseInverse().asDiagonal();
    MeasuredMatrix projection = MeasuredMatrix::Identity();
    projection.topLeftCorner<6, 6>() = unscaled;
    projection.block<6, 6>(kVelocity, kVelocity) = unscaled;
    information.matrix = (projection.transpose() * information.matrix * projection).eval();
    information.vector = (projection.transpose() * information.vector).eval();
  }
  return removed;
}

std::string axis_text(const Eigen::Vector3d& axis) {
  constexpr double kDigits = 100.0;
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  const double sign = axis[largest] < 0.0 ? -1.0 : 1.0;
  const auto rounded = [&](double part) {
    return std::round(sign * part * kDigits) / kDigits + 0.0;  // no -0
  };
  return printed("(%.2f, %.2f, %.2f)", rounded(axis.x()), rounded(axis.y()), rounded(axis.z()));
}

std::string UnobservedDirections::text() const {
  std::string text;
  const auto add = [&](const char* kind, const Eigen::Vector3d& v) {
    text += (text.empty() ? "" : ", ") + (kind + (' ' + axis_text(v)));
  };
  for (const Eigen::Vector3d& translation : translations) {
    add("along", translation);
  }
  for (const Eigen::Vector3d& rotation : rotations) {
    add("about", rotation);
  }
  return text;
}

UnobservedDirections faintest_directions(
    const AlignResult& aligned, int count, double mean_range, const Eigen::Matrix3d& R_body_scan) {
  if (count == 6 || !(mean_range > 0.0)) {
    return UnobservedDirections::all();
  }
  UnobservedDirections faintest;
  if (count > 0) {
    const Eigen::Matrix<double, 6, 1> scale = arc_scale(mean_range, 0);  // of a PoseStep
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(
        Matrix6(scale.asDiagonal() * aligned.information * scale.asDiagonal()));
    for (int i = 0; i < count; ++i) {
      const Eigen::Matrix<double, 6, 1> direction = eigen.eigenvectors().col(i);
      faintest.add(direction.tail<3>(), R_body_scan * direction.head<3>());
    }
  }
  return faintest;
}

UnobservedDirections unobserved_by(
    const AlignResult& aligned, double mean_range, const Eigen::Matrix3d& R_body_scan) {
  return faintest_directions(aligned, aligned.degenerate_directions, mean_range, R_body_scan);
}

}  // namespace nvm::lio
