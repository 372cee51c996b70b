// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// overhead WORK [ungated]: one kind of work, for measure_overhead.py to count the instructions of.
// Each adapter's work has its counterpart with the map's own calls. `ungated`: without normals.
// overhead time [ungated]: the times of all queries in turn, in ns per query; the 10 % quantile of
// many rounds, which is what they take when nothing disturbs them.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "adapters/ct_lio/ct_lio_map.hpp"
#include "adapters/host_point.hpp"
#include "adapters/ikd_tree/ikd_tree.hpp"
#include "adapters/ivox/ivox.hpp"
#include "adapters/kiss_icp/kiss_map.hpp"
#include "adapters/small_gicp/map_traits.hpp"
#include "nvm/geometry/pose.hpp"
#include "support/random_cloud.hpp"

namespace nvm {
namespace {

using IVox = faster_lio::IVox<3, faster_lio::IVoxNodeType::DEFAULT, test::HostPoint>;
using MapTraits = small_gicp::traits::Traits<VoxelMap>;

constexpr double kVoxel = 0.3;

/// The same points in the same map behind every adapter.
struct World {
  bool gated;
  test::Cloud cloud;
  test::HostPoints points;
  VoxelMap map{options().map};
  adapters::IkdTree<test::HostPoint> tree;
  IVox ivox{ivox_options()};
  adapters::KissMap<Pose> kiss{kVoxel, 100.0, 20};
  adapters::CtLioMap ct_lio{options()};

  explicit World(bool with_normals) : gated(with_normals) {
    std::mt19937_64 rng(1);
    cloud = test::thin_wall(20000, 0.05, rng);
    if (!gated) {
      std::fill(cloud.normals.begin(), cloud.normals.end(), Eigen::Vector3f::Zero());
    }
    points = test::host_points_with_normals(cloud);
    tree.options() = plane_options();
    kiss.configure(options());
  }
  static adapters::HostOptions options() {
    adapters::HostOptions options;
    options.map.voxel_size = kVoxel;
    options.map.min_point_distance = 0.1;
    options.normals.missing = adapters::MissingNormal::kUngated;
    return options;
  }
  /// For hosts that fit planes to 5 neighbours.
  static adapters::HostOptions plane_options() {
    adapters::HostOptions of_planes = options();
    of_planes.surface_neighbors = adapters::kSurfaceNeighbors;
    return of_planes;
  }
  static IVox::Options ivox_options() {
    IVox::Options ivox;
    ivox.resolution_ = static_cast<float>(kVoxel);
    ivox.nvm = plane_options();
    return ivox;
  }
  void fill() {
    gated ? map.insert(cloud.points, cloud.normals) : map.insert_unsided(cloud.points);
    tree.Build(points);
    ivox.AddPoints(points);
    kiss.AddPointsWithNormals(cloud.points, cloud.normals);
    ct_lio.add(cloud.points, cloud.normals);
  }
};

std::size_t query_core(const World& world, std::size_t k) {
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
  std::size_t count = 0;
  const NearestSearch search{k, 1e6, Gate::kSurfaces};
  for (const test::HostPoint& p : world.points) {
    count += world.gated
                 ? world.map.nearest(
                       position(p), adapters::normal_field(p), search, found.data(), context)
                 : world.map.nearest(position(p), search, found.data(), context);
  }
  return count;
}

std::size_t query_ikd(const World& world) {
  test::HostPoints found;
  std::vector<float> sq_distances;
  std::size_t count = 0;
  for (const test::HostPoint& p : world.points) {
    world.tree.Nearest_Search(p, 5, found, sq_distances);
    count += found.size();
  }
  return count;
}

std::size_t query_ivox(const World& world) {
  test::HostPoints found;
  std::size_t count = 0;
  for (const test::HostPoint& p : world.points) {
    world.ivox.GetClosestPoint(p, found, 5, 5.0);
    count += found.size();
  }
  return count;
}

std::size_t query_kiss(const World& world) {
  std::size_t count = 0;
  for (const test::HostPoint& p : world.points) {
    const Eigen::Vector3d normal = adapters::normal_field(p).cast<double>();
    count += std::get<1>(world.kiss.GetClosestNeighbor(position(p), normal)) < 1.0 ? 1U : 0U;
  }
  return count;
}

std::size_t query_ct_lio(const World& world, int ring) {
  std::size_t count = 0;
  for (const test::HostPoint& p : world.points) {
    const Eigen::Vector3d normal = adapters::normal_field(p).cast<double>();
    count += world.ct_lio.search(position(p), normal, 20, ring).size();
  }
  return count;
}

std::size_t query_small_gicp(const World& world) {
  std::size_t count = 0;
  for (const test::HostPoint& p : world.points) {
    std::size_t index = 0;
    double sq_distance = 0.0;
    count += MapTraits::gated_nearest_neighbor_search(
        world.map,
        position(p).homogeneous(),
        adapters::normal_field(p).cast<double>(),
        &index,
        &sq_distance);
  }
  return count;
}

struct HostNormals {
  const test::HostPoints& points;
  std::size_t size() const { return points.size(); }
  Eigen::Vector3f operator[](std::size_t i) const { return adapters::normal_field(points[i]); }
};

using Work = std::function<std::size_t(World&)>;

const std::map<std::string, Work>& works() {
  static const std::map<std::string, Work> works = {
      {"empty", [](World& w) { return w.points.size(); }},
      {"insert_core",
       [](World& w) { return w.map.insert(w.points, HostNormals{w.points}).stored; }},
      {"insert_ikd_tree",
       [](World& w) {
         w.tree.Build(w.points);
         return w.tree.map().size();
       }},
      {"insert_ivox",
       [](World& w) {
         w.ivox.AddPoints(w.points);
         return w.ivox.NumPoints();
       }},
      {"insert_core_eigen",
       [](World& w) { return w.map.insert(w.cloud.points, w.cloud.normals).stored; }},
      {"insert_kiss_icp",
       [](World& w) {
         w.kiss.AddPointsWithNormals(w.cloud.points, w.cloud.normals);
         return w.kiss.map().size();
       }},
      {"insert_ct_lio",
       [](World& w) { return w.ct_lio.add(w.cloud.points, w.cloud.normals).stored; }},
      {"filled", [](World& w) { return w.points.size(); }},
      {"query_core_1", [](World& w) { return query_core(w, 1); }},
      {"query_core_5", [](World& w) { return query_core(w, 5); }},
      {"query_core_20", [](World& w) { return query_core(w, 20); }},
      {"query_ikd_tree", [](World& w) { return query_ikd(w); }},
      {"query_ivox", [](World& w) { return query_ivox(w); }},
      {"query_kiss_icp", [](World& w) { return query_kiss(w); }},
      {"query_ct_lio", [](World& w) { return query_ct_lio(w, 1); }},
      {"query_ct_lio_ring_2", [](World& w) { return query_ct_lio(w, 2); }},
      {"query_small_gicp", [](World& w) { return query_small_gicp(w); }}};
  return works;
}

bool is_query(const std::string& name) { return name.rfind("query", 0) == 0; }

/// Interleaved, so that a change in the machine's speed meets all alike.
void print_times(World& world) {
  using Clock = std::chrono::steady_clock;
  constexpr int kRounds = 50;
  std::map<std::string, std::vector<double>> times;
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& [name, work] : works()) {
      if (is_query(name)) {
        const Clock::time_point start = Clock::now();
        work(world);
        const std::chrono::duration<double, std::nano> taken = Clock::now() - start;
        times[name].push_back(taken.count() / static_cast<double>(world.points.size()));
      }
    }
  }
  for (auto& [name, taken] : times) {
    std::nth_element(taken.begin(), taken.begin() + kRounds / 10, taken.end());
    std::printf("%s %.1f\n", name.c_str(), taken[kRounds / 10]);
  }
}

}  // namespace
}  // namespace nvm

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "";
  const bool gated = argc < 3 || std::string(argv[2]) != "ungated";
  const auto work = nvm::works().find(name);
  if (work == nvm::works().end() && name != "time") {
    std::fprintf(stderr, "overhead: no such work: '%s'\n", name.c_str());
    return 2;
  }
  nvm::World world(gated);
  if (nvm::is_query(name) || name == "filled" || name == "time") {
    world.fill();
  }
  if (name == "time") {
    nvm::print_times(world);
    return 0;
  }
  std::printf("%zu\n", work->second(world));
  return 0;
}
