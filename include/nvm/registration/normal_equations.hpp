// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "nvm/core/target.hpp"
#include "nvm/registration/association.hpp"
#include "nvm/registration/point_to_plane.hpp"
#include "nvm/registration/robust_kernel.hpp"

namespace nvm {

/// How many points met which AssociationStatus.
struct AssociationCounts {
  std::size_t valid = 0;
  std::size_t too_few_neighbors = 0;
  std::size_t no_plane = 0;
  std::size_t too_far = 0;

  NVM_SHARED std::size_t total() const { return valid + too_few_neighbors + no_plane + too_far; }

  NVM_SHARED void add(AssociationStatus status) {
    valid += status == AssociationStatus::kValid;
    too_few_neighbors += status == AssociationStatus::kTooFewNeighbors;
    no_plane += status == AssociationStatus::kNoPlane;
    too_far += status == AssociationStatus::kTooFar;
  }

  NVM_SHARED AssociationCounts& operator+=(const AssociationCounts& other) {
    valid += other.valid;
    too_few_neighbors += other.too_few_neighbors;
    no_plane += other.no_plane;
    too_far += other.too_far;
    return *this;
  }
};

/// A 6 x 6 matrix over a PoseStep.
using PoseMatrix = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;

inline namespace NVM_TARGET {

/// The linearised problem: minimise 1/2 s^T information s + gradient . s over the PoseStep s.
/// Sums of it over parts of a scan, added in a fixed order, give the same bits whoever made them.
struct NormalEquations {
  PoseMatrix information = detail::zeros<PoseMatrix>();  ///< sum w J J^T
  PoseStep gradient = detail::zeros<PoseStep>();         ///< sum w J e
  double sum_weights = 0.0;                              ///< sum w
  double sum_sq_ranges = 0.0;                            ///< sum w |p_scan|^2 [m^2]
  double sum_sq_distances = 0.0;                         ///< of valid points to their planes [m^2]
  AssociationCounts counts;

  /// Adds what `p_scan` and its plane say about the pose with rotation `R_map_scan`.
  template <class Rotation>
  void add(
      const Eigen::Vector3d& p_scan,
      const Eigen::MatrixBase<Rotation>& R_map_scan,
      const Association& association,
      const RobustKernel& kernel) {
    counts.add(association.status);
    if (association.status != AssociationStatus::kValid) {
      return;
    }
    const double residual = association.weight * association.distance;
    const double weight = kernel.weight(residual) * association.weight * association.weight;
    const auto jacobian = point_to_plane_jacobian(
        p_scan, R_map_scan.transpose() * association.normal, association.normal);
    information.noalias() += (weight * jacobian) * jacobian.transpose();
    gradient += (weight * association.distance) * jacobian;
    sum_weights += weight;
    sum_sq_ranges += weight * p_scan.squaredNorm();
    sum_sq_distances += association.distance * association.distance;
  }

  /// Of the associated points to their planes [m].
  double rms_distance() const {
    return counts.valid == 0 ? 0.0
                             : std::sqrt(sum_sq_distances / static_cast<double>(counts.valid));
  }

  /// Mean over all points of (distance / max_distance)^2, 1 for those without a plane.
  double truncated_cost(double max_distance) const {
    const auto total = static_cast<double>(counts.total());
    const double fitting = sum_sq_distances / (max_distance * max_distance);
    return total == 0.0 ? 1.0 : (fitting + total - static_cast<double>(counts.valid)) / total;
  }

  NormalEquations& operator+=(const NormalEquations& other) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        information(j, i) += other.information(j, i);
      }
      gradient[i] += other.gradient[i];
    }
    sum_weights += other.sum_weights;
    sum_sq_ranges += other.sum_sq_ranges;
    sum_sq_distances += other.sum_sq_distances;
    counts += other.counts;
    return *this;
  }
};

}  // namespace NVM_TARGET
}  // namespace nvm
