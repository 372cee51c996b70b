// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/directions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nvm::survey {

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Weighted {
  Eigen::Vector3d normal;
  double weight;
};

/// The normals of patches that are planar enough to have one, at most 20 000 at even steps.
std::vector<Weighted> sample(const PatchGrid& grid) {
  constexpr double kMinCount = 4.0;
  const std::size_t step = 1 + grid.patches().size() / 20000;
  std::vector<Weighted> sampled;
  for (std::size_t i = 0; i < grid.patches().size(); i += step) {
    const Patch& patch = grid.patches()[i];
    if (patch.sums.count >= kMinCount) {
      sampled.push_back({patch.normal, patch.sums.count});
    }
  }
  return sampled;
}

/// How much of the surface lies across or along `up`.
double score(const std::vector<Weighted>& normals, const Eigen::Vector3d& up) {
  constexpr double kSine = 0.035;  // 2 degrees
  double sum = 0.0;
  for (const Weighted& w : normals) {
    const double cosine = std::abs(w.normal.dot(up));
    const double off = std::min(cosine, std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
    sum += off < 2.0 * kSine ? w.weight * (1.0 - 0.25 * off * off / (kSine * kSine)) : 0.0;
  }
  return sum;
}

/// The best of a grid of directions around `center`, `radius` [rad] wide.
Eigen::Vector3d best_near(
    const std::vector<Weighted>& normals, const Eigen::Vector3d& center, double radius) {
  constexpr int kSteps = 10;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), center);
  Eigen::Vector3d best = center;
  double best_score = score(normals, center) * 1.0001;  // what is there wins a draw
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Eigen::Vector3d offset(radius * i / kSteps, radius * j / kSteps, 1.0);
      const Eigen::Vector3d up = turn * offset.normalized();
      const double value = score(normals, up);
      if (value > best_score) {
        best_score = value;
        best = up;
      }
    }
  }
  return best;
}

/// The horizontal direction that most surface looks along, modulo 90 degrees.
Eigen::Vector3d find_along(const std::vector<Weighted>& normals, const Eigen::Vector3d& up) {
  constexpr int kBins = 90;
  const Eigen::Vector3d x = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
  const Eigen::Vector3d y = up.cross(x);
  std::array<double, kBins> histogram{};
  for (const Weighted& w : normals) {
    if (std::abs(w.normal.dot(up)) < 0.1) {
      const double turn = std::atan2(w.normal.dot(y), w.normal.dot(x)) / (0.5 * kPi);
      const double fraction = turn - std::floor(turn);
      histogram[static_cast<std::size_t>(fraction * kBins + 0.5) % kBins] += w.weight;
    }
  }
  const auto peak = std::max_element(histogram.begin(), histogram.end()) - histogram.begin();
  const double angle = 0.5 * kPi * static_cast<double>(peak) / kBins;
  return std::cos(angle) * x + std::sin(angle) * y;
}

}  // namespace

Directions find_directions(const PatchGrid& grid) {
  const std::vector<Weighted> normals = sample(grid);
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  constexpr double kLevel = 0.9999;  // 0.8 degrees: as level as an IMU says
  constexpr double kClearly = 1.1;   // a single wall is as upright whichever way it is turned
  Eigen::Vector3d up = z;
  for (const double radius : {0.58, 0.058, 0.0058}) {
    up = best_near(normals, up, radius);
  }
  if (up.dot(z) > kLevel || score(normals, up) < kClearly * score(normals, z)) {
    up = z;
  }
  return {find_along(normals, up), up};
}

}  // namespace nvm::survey
