// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// The map against the maps and trees that odometries use, one thread. All store the same scans of
// the same walk (see corridor.hpp) with the same voxels (0.3 m), spacing (0.1 m) and capacity (20
// points), and answer the same queries. Each query benchmark reports the mean distance of its
// answers as a checksum: equal where maps hold the same points.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <ctime>
#include <memory>
#include <nanoflann.hpp>
#include <random>
#include <utility>
#include <vector>

#include "nvm/map/serialization.hpp"
#include "nvm/map/voxel_map.hpp"
#include "support/corridor.hpp"
#include "support/hash_of_vectors_map.hpp"
#include "support/wall_field.hpp"

#ifdef NVM_BENCHMARK_SMALL_GICP
#include <small_gicp/ann/incremental_voxelmap.hpp>
#include <small_gicp/points/point_cloud.hpp>
#endif

namespace nvm::benchmarks {
namespace {

constexpr double kVoxelSize = 0.3;
constexpr double kSpacing = 0.1;
constexpr int kCapacity = 20;
constexpr int kWalk = 300;  // scans: 30 m

const std::vector<CorridorScan>& walk() {
  static const std::vector<CorridorScan> scans = [] {
    std::vector<CorridorScan> all;
    for (int i = 0; i < kWalk; ++i) {
      all.push_back(Corridor::scan(i));
    }
    return all;
  }();
  return scans;
}

MapOptions nvm_options() {
  MapOptions options;
  options.voxel_size = kVoxelSize;
  options.min_point_distance = kSpacing;
  options.points_per_surface = kCapacity;
  return options;
}

struct Query {
  Eigen::Vector3d point;
  Eigen::Vector3f normal;
};

/// The points of every tenth scan in the map frame, in scan order: what registration asks.
const std::vector<Query>& scan_queries() {
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

const std::vector<Query>& random_queries() {
  static const std::vector<Query> queries = [] {
    std::vector<Query> all = scan_queries();
    std::shuffle(all.begin(), all.end(), std::mt19937_64(7));
    return all;
  }();
  return queries;
}

const std::vector<Query>& queries(benchmark::State& state) {
  return state.range(1) == 0 ? scan_queries() : random_queries();
}

// --- the maps, behind one set of functions: insert(scan) and nearest(query, wanted) -> squared
// distance of the last

struct Nvm {
  Nvm() : map(nvm_options()) {}
  std::size_t insert(const CorridorScan& scan) {
    return map.insert(scan.points, scan.normals, scan.T_map_scan).stored;
  }
  std::size_t nearest(const Query& query, std::size_t wanted) {
    return map.nearest(
        query.point, query.normal, {wanted, 1.0, Gate::kSurfaces}, found.data(), context);
  }
  double sq_distance(std::size_t i) const { return found[i].sq_distance; }

  VoxelMap map;
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
};

struct NvmUngated : Nvm {
  std::size_t nearest(const Query& query, std::size_t wanted) {
    return map.nearest(query.point, {wanted, 1.0, Gate::kSurfaces}, found.data(), context);
  }
};

struct KissStyle {
  KissStyle() : map(kVoxelSize, kSpacing, kCapacity) {}
  std::size_t insert(const CorridorScan& scan) { return map.insert(scan.points, scan.T_map_scan); }
  std::size_t nearest(const Query& query, std::size_t wanted) {
    return map.nearest(query.point, wanted, 1.0, found.data());
  }
  double sq_distance(std::size_t i) const { return found[i].sq_distance; }

  HashOfVectorsMap map;
  std::array<HashOfVectorsMap::Found, kMaxNeighbors> found;
};

/// A static k-d tree over the points of an NVM map: no insertion, exact neighbours within 1 m.
struct Nanoflann {
  std::size_t insert(const CorridorScan& scan) {
    tree.reset();
    return source.insert(scan);
  }
  std::size_t nearest(const Query& query, std::size_t wanted) {
    build();
    nanoflann::KNNResultSet<double, std::uint32_t> result(wanted);
    result.init(ids.data(), sq_distances.data());
    tree->findNeighbors(result, query.point.data(), nanoflann::SearchParams());
    return result.size();
  }
  double sq_distance(std::size_t i) const { return sq_distances[i]; }
  void build() {
    if (tree == nullptr) {
      points = source.map.points();
      tree = std::make_unique<Tree>(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    }
  }

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i].position[static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<
      nanoflann::L2_Simple_Adaptor<double, Nanoflann, double, std::uint32_t>,
      Nanoflann,
      3,
      std::uint32_t>;

  Nvm source;
  std::vector<MapPoint> points;
  std::unique_ptr<Tree> tree;
  std::array<std::uint32_t, kMaxNeighbors> ids;
  std::array<double, kMaxNeighbors> sq_distances;
};

#ifdef NVM_BENCHMARK_SMALL_GICP
struct SmallGicp {
  SmallGicp() : map(kVoxelSize) {
    map.voxel_setting.max_num_points_in_cell = kCapacity;
    map.voxel_setting.min_sq_dist_in_cell = kSpacing * kSpacing;
    // Its constructor lists one voxel already and case 27 appends to it, which answers each point
    // there twice.
    map.search_offsets.clear();
    map.set_search_offsets(27);
    map.lru_horizon = 1U << 30;
  }
  std::size_t insert(const CorridorScan& scan) {
    small_gicp::PointCloud cloud;
    cloud.resize(scan.points.size());
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      cloud.point(i) << scan.points[i].cast<double>(), 1.0;
      cloud.normal(i) << scan.normals[i].cast<double>(), 0.0;
    }
    map.insert(cloud, Eigen::Isometry3d(scan.T_map_scan.matrix()));
    return 0;
  }
  std::size_t nearest(const Query& query, std::size_t wanted) {
    const Eigen::Vector4d point(query.point.x(), query.point.y(), query.point.z(), 1.0);
    return map.knn_search(point, wanted, ids.data(), sq_distances.data());
  }
  double sq_distance(std::size_t i) const { return sq_distances[i]; }

  small_gicp::IncrementalVoxelMap<small_gicp::FlatContainerNormal> map;
  std::array<std::size_t, kMaxNeighbors> ids;
  std::array<double, kMaxNeighbors> sq_distances;
};
#endif

template <class Map>
Map& walked() {
  static const std::unique_ptr<Map> map = [] {
    auto result = std::make_unique<Map>();
    for (const CorridorScan& scan : walk()) {
      result->insert(scan);
    }
    return result;
  }();
  return *map;
}

// --- what is measured

/// nearest/<map>/<wanted>/<0: in scan order, 1: in random order>
template <class Map>
void nearest(benchmark::State& state) {
  Map& map = walked<Map>();
  const auto wanted = static_cast<std::size_t>(state.range(0));
  const std::vector<Query>& all = queries(state);
  double sum = 0.0;
  std::size_t found = 0;
  std::size_t asked = 0;
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(all.size()))) {
    for (const Query& query : all) {
      const std::size_t count = map.nearest(query, wanted);
      found += count;
      sum += count > 0 ? map.sq_distance(count - 1) : 0.0;
    }
    asked += all.size();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(asked);
  state.counters["checksum"] = sum / static_cast<double>(asked);
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

/// insert_evicting: a full map walks on, so that each new voxel pushes one out.
void insert_evicting(benchmark::State& state) {
  MapOptions options = nvm_options();
  options.capacity = static_cast<std::size_t>(state.range(0));
  VoxelMap map(options);
  std::size_t points = 0;
  std::size_t evicted = 0;
  for (auto _ : state) {
    for (const CorridorScan& scan : walk()) {
      evicted += map.insert(scan.points, scan.normals, scan.T_map_scan).evicted_voxels;
      points += scan.points.size();
    }
  }
  state.counters["evicted_per_1000_points"] =
      1e3 * static_cast<double>(evicted) / static_cast<double>(points);
  state.counters["ns_per_point"] = benchmark::Counter(
      static_cast<double>(points) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

double random_query_ns(const VoxelMap& map, std::size_t patches) {
  constexpr std::size_t kQueries = 100'000;
  std::mt19937_64 rng(3);
  std::vector<Query> asked;
  while (asked.size() < kQueries) {
    const WallField::Patch patch = WallField::patch(rng() % patches);
    for (std::size_t i = 0; i < kQueries / 100; ++i) {
      const std::size_t at = rng() % patch.points.size();
      asked.push_back({patch.points[at] + Eigen::Vector3d(0.02, 0.01, 0.03), patch.normals[at]});
    }
  }
  std::shuffle(asked.begin(), asked.end(), rng);
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
  const std::clock_t begin = std::clock();
  for (const Query& query : asked) {
    benchmark::DoNotOptimize(
        map.nearest(query.point, query.normal, {5, 1.0, Gate::kSurfaces}, found.data(), context));
  }
  return 1e9 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kQueries;
}

/// grow/<points>: a map grows in patches of 24 000 new points; the slowest patch, and 5 gated
/// neighbours in random order once it is as large.
void grow(benchmark::State& state) {
  const auto patches = static_cast<std::size_t>(state.range(0)) / WallField::kPatch + 1;
  MapOptions options = nvm_options();
  options.capacity = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    VoxelMap map(options);
    double worst_ms = 0.0;
    for (std::size_t i = 0; i < patches; ++i) {
      const WallField::Patch patch = WallField::patch(i);
      const std::clock_t begin = std::clock();
      map.insert(patch.points, patch.normals);
      const double elapsed_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      worst_ms = std::max(worst_ms, elapsed_ms);
    }
    state.counters["worst_patch_ms"] = worst_ms;
    state.counters["points"] = static_cast<double>(map.size());
    state.counters["query5_ns"] = random_query_ns(map, patches);
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

#define NVM_QUERY_BENCHMARK(Map) \
  BENCHMARK_TEMPLATE(nearest, Map)->Unit(benchmark::kNanosecond)->ArgsProduct({{1, 5, 20}, {0, 1}})

NVM_QUERY_BENCHMARK(Nvm);
NVM_QUERY_BENCHMARK(NvmUngated);
NVM_QUERY_BENCHMARK(KissStyle);
NVM_QUERY_BENCHMARK(Nanoflann);
BENCHMARK_TEMPLATE(insert_raw, Nvm)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(insert_raw, KissStyle)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(insert_new, Nvm)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(insert_new, KissStyle)->Unit(benchmark::kMillisecond);
#ifdef NVM_BENCHMARK_SMALL_GICP
NVM_QUERY_BENCHMARK(SmallGicp);
BENCHMARK_TEMPLATE(insert_raw, SmallGicp)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(insert_new, SmallGicp)->Unit(benchmark::kMillisecond);
#endif
BENCHMARK(insert_evicting)->Arg(5000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(grow)
    ->Arg(10'000)
    ->Arg(1'000'000)
    ->Arg(10'000'000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(memory);
BENCHMARK(save)->Unit(benchmark::kMillisecond);
BENCHMARK(load)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace nvm::benchmarks
