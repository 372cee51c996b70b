// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// A fixed number of gated 5-nearest queries, for counting instructions:
//   valgrind --tool=callgrind --toggle-collect='nvm_probe_queries*'
//   build/bench/benchmarks/nvm_query_probe
// Instruction counts are repeatable on a busy machine. Build with -march=x86-64-v3: valgrind knows
// no AVX-512.
#include <array>
#include <cstdio>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "support/corridor.hpp"

namespace {

using Points = std::vector<Eigen::Vector3d>;
using Normals = std::vector<Eigen::Vector3f>;

}  // namespace

// Of C linkage, so that a profiler can name it.
extern "C" __attribute__((noinline)) double nvm_probe_queries(
    const nvm::VoxelMap* map, const Points* points, const Normals* normals) {
  nvm::VoxelMap::QueryContext context;
  std::array<nvm::Neighbor, nvm::kMaxNeighbors> found;
  double sum = 0.0;
  for (std::size_t i = 0; i < points->size(); ++i) {
    const std::size_t count = map->nearest(
        (*points)[i], (*normals)[i], {5, 1.0, nvm::Gate::kSurfaces}, found.data(), context);
    sum += count == 0 ? 0.0 : found[count - 1].sq_distance;
  }
  return sum;
}

int main() {
  nvm::VoxelMap map;
  Points points;
  Normals normals;
  for (int i = 0; i < 20; ++i) {
    const nvm::benchmarks::CorridorScan scan = nvm::benchmarks::Corridor::scan(i);
    map.insert(scan.points, scan.normals, scan.T_map_scan);
    for (std::size_t j = 0; i % 10 == 5 && j < scan.points.size(); j += 8) {
      points.push_back(scan.T_map_scan * scan.points[j].cast<double>());
      normals.push_back((scan.T_map_scan.linear() * scan.normals[j].cast<double>()).cast<float>());
    }
  }
  std::printf(
      "queries %zu checksum %.6f\n", points.size(), nvm_probe_queries(&map, &points, &normals));
}
