// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Estimates the normals of a scan, and says what became of the points that got none.
#include <cstdio>
#include <limits>
#include <nvm/nvm.hpp>

#include "thin_wall.hpp"

int main() {
  std::vector<thin_wall::Return> scan = thin_wall::scan_from({0, -2, 1});
  scan.push_back({0.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()});
  scan.push_back({0.0F, -20.0F, 5.0F});  // a bird

  nvm::NormalOptions options;
  options.min_radius = 0.15;
  const Eigen::Vector3d viewpoint(0, 0, 0);  // a raw scan is seen from its origin
  const nvm::NormalResult result = nvm::estimate_normals(scan, viewpoint, options);

  const nvm::NormalStats& stats = result.stats;
  std::printf("%zu points: %zu with a normal\n", scan.size(), stats.valid);
  std::printf("  not planar (the edge between wall and floor): %zu\n", stats.not_planar);
  std::printf("  too few neighbours: %zu\n", stats.few_neighbors);
  std::printf("  not finite: %zu\n", stats.non_finite);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (result.status[i] == nvm::NormalStatus::kValid) {
      const Eigen::Vector3f& n = result.normals[i];
      std::printf("the first of them: (%.2f %.2f %.2f)\n", n.x(), n.y(), n.z());
      break;
    }
  }
}
