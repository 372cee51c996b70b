// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What it costs to keep a map bounded, by recency and by distance.
#include <benchmark/benchmark.h>

#include <cstddef>

#include "support/contestants.hpp"
#include "support/cpu_seconds.hpp"
#include "support/wall_field.hpp"

namespace nvm::benchmarks {
namespace {

/// walk_on/<capacity>: the second half of a walk of 40 m, by when a map of the smaller capacities
/// is full, so that each new voxel pushes one out: per point of raw scans. What eviction costs is
/// the difference to the largest capacity, which nothing fills.
void walk_on(benchmark::State& state) {
  constexpr int kHalf = 200;
  MapOptions options = nvm_options();
  options.capacity = static_cast<std::size_t>(state.range(0));
  double seconds = 0.0;
  std::size_t points = 0;
  std::size_t evicted = 0;
  for (auto _ : state) {
    VoxelMap map(options);
    for (int i = 0; i < 2 * kHalf; ++i) {
      const CorridorScan scan = Corridor::scan(i);
      const double begin = cpu_seconds();
      const InsertStats stats = map.insert(scan.points, scan.normals, scan.T_map_scan);
      if (i >= kHalf) {
        seconds += cpu_seconds() - begin;
        points += scan.points.size();
        evicted += stats.evicted_voxels;
      }
    }
  }
  state.counters["evicted_per_1000_points"] =
      1e3 * static_cast<double>(evicted) / static_cast<double>(points);
  state.counters["ns_per_point"] = 1e9 * seconds / static_cast<double>(points);
}

/// update<rule>/<voxels>: a raw scan of 24 000 points into a map of at least so many voxels, none
/// of which has to go: LRU touches what the scan touches, the radius rule looks at every voxel.
template <Eviction kRule>
void update(benchmark::State& state) {
  VoxelMap map(nvm_options());
  for (std::size_t i = 0; map.voxel_count() < static_cast<std::size_t>(state.range(0)); ++i) {
    const WallField::Patch patch = WallField::patch(i);
    map.insert(patch.points, patch.normals);
  }
  const CorridorScan scan = Corridor::scan(0);
  for (auto _ : state) {
    InsertStats stats = map.insert(scan.points, scan.normals, scan.T_map_scan);
    if (kRule == Eviction::kRadius) {
      map.keep_within(scan.T_map_scan.translation(), 1e5, stats);
    }
  }
  state.counters["voxels"] = static_cast<double>(map.voxel_count());
}

BENCHMARK(walk_on)->Arg(10'000)->Arg(20'000)->Arg(4'000'000)->Iterations(1)->Unit(
    benchmark::kMillisecond);
void map_sizes(benchmark::internal::Benchmark* update) {
  update->ArgsProduct({{125'000, 250'000, 500'000, 1'000'000}})->Unit(benchmark::kMillisecond);
}
BENCHMARK_TEMPLATE(update, Eviction::kLeastRecentlyUsed)->Apply(map_sizes);
BENCHMARK_TEMPLATE(update, Eviction::kRadius)->Apply(map_sizes);

}  // namespace
}  // namespace nvm::benchmarks
