// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What the map and the normals cost a program with its own compiler flags: prints CPU nanoseconds
// per query or point, the least of some repetitions. run.py compares builds of it with -O2 alone
// and with -march=native.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "support/corridor.hpp"
#include "support/cpu_seconds.hpp"

namespace {

using nvm::benchmarks::Corridor;
using nvm::benchmarks::CorridorScan;

/// The least time of one item in `run`, which handles `items` [ns].
template <class Run>
double nanoseconds(std::size_t items, const Run& run) {
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 5; ++repetition) {
    const double begin = nvm::benchmarks::cpu_seconds();
    run();
    least = std::min(least, nvm::benchmarks::cpu_seconds() - begin);
  }
  return 1e9 * least / static_cast<double>(items);
}

void insert_all(const std::vector<CorridorScan>& scans, nvm::VoxelMap& map) {
  for (const CorridorScan& scan : scans) {
    map.insert(scan.points, scan.normals, scan.T_map_scan);
  }
}

double query_all(const std::vector<CorridorScan>& scans, std::size_t count, nvm::VoxelMap& map) {
  const CorridorScan& scan = scans.back();
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> normals;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    points.push_back(scan.T_map_scan * scan.points[i].cast<double>());
    normals.push_back((scan.T_map_scan.linear() * scan.normals[i].cast<double>()).cast<float>());
  }
  nvm::VoxelMap::QueryContext context;
  std::array<nvm::Neighbor, nvm::kMaxNeighbors> found;
  std::size_t sum = 0;
  const double time = nanoseconds(points.size(), [&] {
    for (std::size_t i = 0; i < points.size(); ++i) {
      sum += map.nearest(points[i], normals[i], {count, 1.0}, found.data(), context);
    }
  });
  return sum > 0 ? time : 0.0;
}

}  // namespace

int main() {
  std::vector<CorridorScan> scans;
  std::size_t size = 0;
  for (int i = 0; i < 20; ++i) {
    scans.push_back(Corridor::scan(i));
    size += scans.back().points.size();
  }
  nvm::VoxelMap map;
  nvm::NormalEstimator estimator;
  const double fresh = nanoseconds(size, [&] {
    map.clear();
    insert_all(scans, map);
  });
  const double again = nanoseconds(size, [&] { insert_all(scans, map); });
  const double query5 = query_all(scans, 5, map);
  const double query20 = query_all(scans, 20, map);
  const auto& points = scans.back().points;
  const double normals = nanoseconds(
      points.size(), [&] { estimator.estimate(points, Eigen::Vector3f(Eigen::Vector3f::Zero())); });
  std::printf(
      "{\"query5\": %.1f, \"query20\": %.1f, \"insert_new\": %.2f, \"insert_again\": %.2f, "
      "\"normals\": %.1f}\n",
      query5,
      query20,
      fresh,
      again,
      normals);
}
