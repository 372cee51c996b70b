// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <random>

namespace nvm::test {

/// Uniform in a cube around the origin whose edge is twice `half_size`.
inline Eigen::Vector3d random_vector(std::mt19937_64& rng, double half_size = 1.0) {
  std::uniform_real_distribution<double> uniform(-half_size, half_size);
  return {uniform(rng), uniform(rng), uniform(rng)};
}

}  // namespace nvm::test
