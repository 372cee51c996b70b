// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Three coordinates of number type `Real`: float, double or FloatLanes (one vector per lane).
template <class Real>
struct Vector3Of {
  Real x{}, y{}, z{};
};

/// Eigenvalues of a symmetric 3x3 matrix, ascending, and their unit eigenvectors, orthogonal to
/// each other. The sign of an eigenvector is arbitrary.
template <class Real>
struct Eigen3 {
  Real smallest{}, middle{}, largest{};
  Vector3Of<Real> smallest_vector, middle_vector, largest_vector;
};

}  // namespace NVM_TARGET
}  // namespace nvm
