// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What filling a map costs: insertion, growth, memory, files; nvm's map and those that odometries
// use. One thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "nvm/map/serialization.hpp"
#include "support/contestants.hpp"
#include "support/cpu_seconds.hpp"
#include "support/walk.hpp"
#include "support/wall_field.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace nvm::benchmarks {
namespace {

/// Gives freed memory back to the system, so that each map has to fetch its own: otherwise a map of
/// many small vectors would find, from the second repetition on, all of it at hand.
void return_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

/// Of each scan of the walk, only the points that an NVM map stores.
const std::vector<CorridorScan>& new_points() {
  static const std::vector<CorridorScan> scans = [] {
    Nvm nvm;
    std::vector<CorridorScan> all;
    for (const CorridorScan& scan : walk()) {
      CorridorScan stored;
      stored.T_map_scan = scan.T_map_scan;
      for (std::size_t i = 0; i < scan.points.size(); ++i) {
        const std::array<Eigen::Vector3f, 1> point{scan.points[i]};
        const std::array<Eigen::Vector3f, 1> normal{scan.normals[i]};
        if (nvm.map.insert(point, normal, scan.T_map_scan).stored == 1) {
          stored.points.push_back(point[0]);
          stored.normals.push_back(normal[0]);
        }
      }
      all.push_back(std::move(stored));
    }
    return all;
  }();
  return scans;
}

template <class Map>
void insert_scans(benchmark::State& state, const std::vector<CorridorScan>& scans) {
  for (auto _ : state) {
    state.PauseTiming();
    auto map = std::make_unique<Map>();
    state.ResumeTiming();
    for (const CorridorScan& scan : scans) {
      benchmark::DoNotOptimize(map->insert(scan));
    }
    state.PauseTiming();
    map.reset();
    return_freed_memory();
    state.ResumeTiming();
  }
  std::size_t points = 0;
  for (const CorridorScan& scan : scans) {
    points += scan.points.size();
  }
  state.counters["ns_per_point"] = benchmark::Counter(
      static_cast<double>(points) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// insert_raw/<map>: the scans of a walk into an empty map: per point. Most points are rejected as
/// too close to others.
template <class Map>
void insert_raw(benchmark::State& state) {
  insert_scans<Map>(state, walk());
}

/// insert_new/<map>: only the points that are stored, in the order of the walk: per point.
template <class Map>
void insert_new(benchmark::State& state) {
  insert_scans<Map>(state, new_points());
}

/// The patches of a field as scans, for any map.
CorridorScan patch_scan(std::size_t index) {
  const WallField::Patch patch = WallField::patch(index);
  CorridorScan scan;
  scan.normals = patch.normals;
  for (const Eigen::Vector3d& point : patch.points) {
    scan.points.push_back(point.cast<float>());
  }
  return scan;
}

/// 100 scans' worth of queries, each scan's within a patch anywhere in the field, in random order.
std::vector<Query> field_queries(std::size_t patches) {
  constexpr std::size_t kScans = 100;
  constexpr std::size_t kPerScan = 1000;
  std::mt19937_64 rng(3);
  std::vector<Query> queries;
  for (std::size_t scan = 0; scan < kScans; ++scan) {
    const WallField::Patch patch = WallField::patch(rng() % patches);
    for (std::size_t i = 0; i < kPerScan; ++i) {
      const std::size_t at = rng() % patch.points.size();
      queries.push_back({patch.points[at] + Eigen::Vector3d(0.02, 0.01, 0.03), patch.normals[at]});
    }
  }
  return queries;
}

template <class Map>
double query5_ns(Map& map, const std::vector<Query>& queries) {
  const double begin = cpu_seconds();
  for (const Query& query : queries) {
    benchmark::DoNotOptimize(map.nearest(query, 5));
  }
  return 1e9 * (cpu_seconds() - begin) / static_cast<double>(queries.size());
}

/// grow<map>/<points>: a map grows in patches of 24 000 new points; the slowest patch, the mean per
/// point, and 5 neighbours once it is as large: scan by scan, and with all scans shuffled, so that
/// no query comes near to the one before.
template <class Map>
void grow(benchmark::State& state) {
  const auto patches = static_cast<std::size_t>(state.range(0)) / WallField::kPatch + 1;
  for (auto _ : state) {
    return_freed_memory();
    const auto map = std::make_unique<Map>();
    double worst = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < patches; ++i) {
      const CorridorScan scan = patch_scan(i);
      const double begin = cpu_seconds();
      map->insert(scan);
      const double elapsed = cpu_seconds() - begin;
      worst = std::max(worst, elapsed);
      sum += elapsed;
    }
    state.counters["worst_patch_ms"] = 1e3 * worst;
    state.counters["ns_per_point"] = 1e9 * sum / static_cast<double>(patches * WallField::kPatch);
    std::vector<Query> queries = field_queries(patches);
    state.counters["query5_ns"] = query5_ns(*map, queries);
    std::shuffle(queries.begin(), queries.end(), std::mt19937_64(4));
    state.counters["query5_shuffled_ns"] = query5_ns(*map, queries);
  }
}

void memory(benchmark::State& state) {
  const VoxelMap& map = walked<Nvm>().map;
  for (auto _ : state) {
    benchmark::DoNotOptimize(map.memory_bytes());
  }
  const auto points = static_cast<double>(map.size());
  state.counters["points"] = points;
  state.counters["points_per_voxel"] = points / static_cast<double>(map.voxel_count());
  state.counters["bytes_per_point"] = static_cast<double>(map.memory_bytes()) / points;
}

void save(benchmark::State& state) {
  const VoxelMap& map = walked<Nvm>().map;
  for (auto _ : state) {
    benchmark::DoNotOptimize(MapArchive::write(map));
  }
}

void load(benchmark::State& state) {
  const std::vector<std::uint8_t> bytes = MapArchive::write(walked<Nvm>().map);
  for (auto _ : state) {
    benchmark::DoNotOptimize(MapArchive::read(bytes).size());
  }
}

#define NVM_GROWTH_BENCHMARK(Map)                                     \
  BENCHMARK_TEMPLATE(insert_raw, Map)->Unit(benchmark::kMillisecond); \
  BENCHMARK_TEMPLATE(insert_new, Map)->Unit(benchmark::kMillisecond); \
  BENCHMARK_TEMPLATE(grow, Map)                                       \
      ->RangeMultiplier(10)                                           \
      ->Range(10'000, 10'000'000)                                     \
      ->Iterations(1)                                                 \
      ->Unit(benchmark::kMillisecond)

NVM_GROWTH_BENCHMARK(Nvm);
NVM_GROWTH_BENCHMARK(KissStyle);
#ifdef NVM_BENCHMARK_SMALL_GICP
NVM_GROWTH_BENCHMARK(SmallGicp);
#endif
#ifdef NVM_BENCHMARK_KISS_ICP
BENCHMARK_TEMPLATE(insert_raw, KissIcp)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(insert_new, KissIcp)->Unit(benchmark::kMillisecond);
#endif
BENCHMARK(memory);
BENCHMARK(save)->Unit(benchmark::kMillisecond);
BENCHMARK(load)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace nvm::benchmarks
