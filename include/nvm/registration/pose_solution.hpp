// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <cstddef>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"
#include "nvm/registration/normal_equations.hpp"
#include "nvm/registration/point_to_plane.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// The step that solves NormalEquations, and what the scan tells about each direction.
struct PoseSolution {
  PoseStep step = detail::zeros<PoseStep>();
  /// Eigenvalues of the information per unit of weight, ascending, with rotations measured by the
  /// arc [m] that they make at the points' mean range: 0 (unobserved) to about 1 for each.
  std::array<double, 6> observability{};
  int degenerate_directions = 0;  ///< those below the limit, along which `step` is zero
};

/// Solves `equations`; directions whose observability is below `min_observability` stay as they
/// are (solution remapping: Zhang, Kaess and Singh, "On degeneracy of optimization-based state
/// estimation problems", ICRA 2016), so that a corridor or a lone wall leaves the guess untouched
/// where it says nothing. `equations`: NormalEquations, or what else has its sums.
template <class Equations>
PoseSolution solve(const Equations& equations, double min_observability) {
  PoseSolution solution;
  if (!(equations.sum_weights > 0.0) || !detail::all_finite(equations.information)) {
    solution.degenerate_directions = 6;
    return solution;
  }
  const double mean_range = std::sqrt(equations.sum_sq_ranges / equations.sum_weights);
  using Step = decltype(equations.gradient);
  using Matrix = Eigen::Matrix<typename Step::Scalar, 6, 6>;
  Step scale = Step::Ones();
  scale.template head<3>().setConstant(mean_range > 0.0 ? 1.0 / mean_range : 1.0);
  const Matrix scaled =
      scale.asDiagonal() * equations.information * scale.asDiagonal() / equations.sum_weights;
  // Of a positive semidefinite matrix also the eigenvectors, at a sixth of what Eigen's eigenvalue
  // solver adds to the compile time of every file that includes this one.
  const Eigen::JacobiSVD<Matrix> svd(scaled, Eigen::ComputeFullU);
  const Step target = -scale.cwiseProduct(equations.gradient) / equations.sum_weights;
  Step step = Step::Zero();
  for (int i = 0; i < 6; ++i) {
    const double observability = svd.singularValues()[i];
    solution.observability[static_cast<std::size_t>(5 - i)] = observability;
    if (observability < min_observability) {
      ++solution.degenerate_directions;
      continue;
    }
    const auto direction = svd.matrixU().col(i);
    step += (direction.dot(target) / observability) * direction;
  }
  solution.step = scale.cwiseProduct(step);
  return solution;
}

}  // namespace NVM_TARGET
}  // namespace nvm
