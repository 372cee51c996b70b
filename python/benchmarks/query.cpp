// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// The queries of query.py in C++: query MAP QUERIES, a file of points and normals as float64. For
// each line of standard input it answers all of them and prints the CPU time that took [s] and the
// sum of all distances.
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <vector>

#include "nvm/map/serialization.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  const nvm::VoxelMap map = nvm::load_map(argv[1]);
  std::ifstream file(argv[2], std::ios::binary | std::ios::ate);
  std::vector<std::array<Eigen::Vector3d, 2>> queries(
      static_cast<std::size_t>(file.tellg()) / sizeof(queries[0]));
  file.seekg(0).read(
      reinterpret_cast<char*>(queries.data()),
      static_cast<std::streamsize>(queries.size() * sizeof(queries[0])));
  while (std::getchar() == '\n') {
    const std::clock_t begin = std::clock();
    nvm::VoxelMap::QueryContext context;
    std::array<nvm::Neighbor, nvm::kMaxNeighbors> found;
    double sum = 0.0;
    for (const auto& [point, normal] : queries) {
      const std::size_t count =
          map.nearest(point, normal.cast<float>(), {5, 1.0}, found.data(), context);
      for (std::size_t i = 0; i < count; ++i) {
        sum += std::sqrt(static_cast<double>(found[i].sq_distance));
      }
    }
    std::printf("%.9f %.9f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, sum);
    std::fflush(stdout);
  }
}
