// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <random>
#include <vector>

#include "support/corridor.hpp"

namespace nvm::benchmarks {

inline constexpr int kWalk = 300;  // scans: 30 m

inline const std::vector<CorridorScan>& walk() {
  static const std::vector<CorridorScan> scans = [] {
    std::vector<CorridorScan> all;
    for (int i = 0; i < kWalk; ++i) {
      all.push_back(Corridor::scan(i));
    }
    return all;
  }();
  return scans;
}

struct Query {
  Eigen::Vector3d point;
  Eigen::Vector3f normal;
};

/// The points of every tenth scan in the map frame, in scan order: what registration asks.
inline const std::vector<Query>& scan_queries() {
  static const std::vector<Query> queries = [] {
    std::vector<Query> all;
    for (int s = 5; s < kWalk; s += 10) {
      const CorridorScan scan = Corridor::scan(s, 400);
      for (std::size_t i = 0; i < scan.points.size(); ++i) {
        all.push_back(
            {scan.T_map_scan * scan.points[i].cast<double>(),
             (scan.T_map_scan.linear() * scan.normals[i].cast<double>()).cast<float>()});
      }
    }
    return all;
  }();
  return queries;
}

inline const std::vector<Query>& random_queries() {
  static const std::vector<Query> queries = [] {
    std::vector<Query> all = scan_queries();
    std::shuffle(all.begin(), all.end(), std::mt19937_64(7));
    return all;
  }();
  return queries;
}

}  // namespace nvm::benchmarks
