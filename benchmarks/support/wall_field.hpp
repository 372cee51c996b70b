// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace nvm::benchmarks {

/// New points without end, for growing a map to any size: parallel walls 5 m apart and 20 x 20 m
/// large, covered in patches of 24 000 points that lie far enough apart to be all stored.
class WallField {
 public:
  static constexpr std::size_t kPatch = 24'000;

  struct Patch {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3f> normals;
  };

  /// Patch `index` of the field; the same for every call.
  static Patch patch(std::size_t index) {
    std::mt19937_64 rng(index + 1);
    std::uniform_real_distribution<double> jitter(-0.003, 0.003);
    std::normal_distribution<float> tilt(0.0F, 0.03F);
    Patch patch;
    for (std::size_t i = index * kPatch; i < (index + 1) * kPatch; ++i) {
      const std::size_t wall = i / kPerWall;
      const std::size_t row = i % kPerWall / kRow;
      const std::size_t column = i % kRow;
      patch.points.emplace_back(
          static_cast<double>(column) * kSpacing + jitter(rng),
          5.03 * static_cast<double>(wall) + jitter(rng),
          static_cast<double>(row) * kSpacing + jitter(rng));
      patch.normals.push_back(Eigen::Vector3f(tilt(rng), 1.0F, tilt(rng)).normalized());
    }
    return patch;
  }

 private:
  static constexpr double kSpacing = 0.108;  // more than the map's 0.1 m, jitter included
  static constexpr std::size_t kRow = 185;
  static constexpr std::size_t kPerWall = kRow * kRow;
};

}  // namespace nvm::benchmarks
