// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Normals of one scan of a simulated room, one thread, CPU time: nvm against nanoflann with the
// same closed-form eigen solution and, where they are installed, PCL and small_gicp. Every baseline
// searches in the order of the scan, as a user of that library would.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>
#include <random>
#include <utility>
#include <vector>

#include "nvm/geometry/moments.hpp"
#include "nvm/geometry/symmetric_eigen.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "support/furnished_room.hpp"

#ifdef NVM_BENCHMARK_SMALL_GICP
#include <small_gicp/points/point_cloud.hpp>
#include <small_gicp/util/normal_estimation.hpp>
#endif
#ifdef NVM_BENCHMARK_PCL
#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#endif

namespace nvm {
namespace {

using Points = std::vector<Eigen::Vector3f>;

enum Scan : std::int64_t { kVlp16, kMid360, kMid360Dense };

const Points& scan_points(std::int64_t scan) {
  static const std::vector<Points> scans = [] {
    std::mt19937_64 rng(1);
    const test::FurnishedRoom room(8.0, rng);
    const auto points = [&](const test::Directions& directions) {
      return room.scan(directions, 0.01, rng).points;
    };
    return std::vector<Points>{
        points(test::spinning_directions(16, 1500)),
        points(test::non_repetitive_directions(20'000, 0.0)),
        points(test::non_repetitive_directions(100'000, 0.0))};
  }();
  return scans[static_cast<std::size_t>(scan)];
}

NormalOptions fixed_radius() {
  NormalOptions options;
  options.min_radius = options.max_radius = 0.3;
  return options;
}

// 0.1 m at the sensor to 1 m at 30 m.
NormalOptions adaptive_radius() {
  NormalOptions options;
  options.min_radius = 0.1;
  options.max_radius = 1.0;
  options.max_range = 30.0;
  return options;
}

void finish(benchmark::State& state, std::size_t valid) {
  const std::size_t points = scan_points(state.range(0)).size();
  state.counters["valid"] = static_cast<double>(valid) / static_cast<double>(points);
  if (valid < points / 2) {
    state.SkipWithError("fewer than half of the normals are valid");
  }
}

void estimate(benchmark::State& state, NormalOptions options, NormalMethod method) {
  const Points& points = scan_points(state.range(0));
  options.method = method;
  NormalEstimator estimator(options);
  std::size_t valid = 0;
  for (auto _ : state) {
    valid = estimator.estimate(points, Eigen::Vector3d(0.0, 0.0, 0.0)).stats.valid;
  }
  finish(state, valid);
}

struct Cloud {
  const Points& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::
    KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::uint32_t>;
using Found = std::vector<std::pair<std::uint32_t, float>>;

// What every nanoflann since 1.4 asks of a result set.
struct Ball {
  using DistanceType = float;
  using IndexType = std::uint32_t;

  bool addPoint(float sq_distance, std::uint32_t index) {
    found.emplace_back(index, sq_distance);
    return true;
  }
  float worstDist() const { return sq_radius; }
  bool full() const { return true; }
  bool empty() const { return found.empty(); }
  std::size_t size() const { return found.size(); }
  void sort() {}

  float sq_radius;
  Found& found;
};

// The normal of point `i` from its neighbours, turned to the origin; zero when they are too few.
Eigen::Vector3f fitted_normal(const Points& points, std::size_t i, const Found& neighbors) {
  if (neighbors.size() < 6) {
    return Eigen::Vector3f::Zero();
  }
  Moments<float> moments;
  for (const auto& neighbor : neighbors) {
    const Eigen::Vector3f d = points[neighbor.first] - points[i];
    moments.add(1.0F, d.x(), d.y(), d.z());
  }
  const auto n = eigen_decomposition(scatter(moments)).smallest_vector;
  const Eigen::Vector3f normal(n.x, n.y, n.z);
  return normal.dot(points[i]) > 0.0F ? Eigen::Vector3f(-normal) : normal;
}

void nanoflann_baseline(benchmark::State& state, const NormalOptions& options) {
  const Points& points = scan_points(state.range(0));
  const RadiusLaw radius(options);
  std::vector<Eigen::Vector3f> normals(points.size());
  Found found;
  for (auto _ : state) {
    const Cloud cloud{points};
    const Tree tree(3, cloud);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto r = static_cast<float>(radius(points[i].cast<double>().squaredNorm()));
      found.clear();
      Ball ball{r * r, found};
      tree.findNeighbors(ball, points[i].data(), {});
      normals[i] = fitted_normal(points, i, found);
    }
    benchmark::DoNotOptimize(normals.data());
  }
  finish(state, points.size());
}

#ifdef NVM_BENCHMARK_PCL
void pcl_baseline(benchmark::State& state) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3f& p : scan_points(state.range(0))) {
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  pcl::PointCloud<pcl::Normal> normals;
  for (auto _ : state) {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(1);
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    estimation.setRadiusSearch(0.3);
    estimation.compute(normals);
  }
  finish(state, normals.size());
}
#endif

#ifdef NVM_BENCHMARK_SMALL_GICP
/// Normals from 20 neighbours, its default.
void small_gicp_baseline(benchmark::State& state) {
  small_gicp::PointCloud cloud(scan_points(state.range(0)));
  for (auto _ : state) {
    small_gicp::estimate_normals(cloud, 20);
    benchmark::DoNotOptimize(cloud.normals.data());
  }
  finish(state, cloud.size());
}
#endif

// ns per matrix, in batches of 4096 as an estimator would have them.
void eigen_batched(benchmark::State& state) {
  constexpr std::size_t kBatches = 4096 / kLaneCount;
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<float> entries(6 * kBatches * kLaneCount);
  for (float& entry : entries) {
    entry = unit(rng);
  }
  std::vector<float> normals(entries.size() / 2);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kBatches; ++i) {
      const float* m = &entries[6 * kLaneCount * i];
      const auto entry = [m](std::size_t j) { return load_lanes(m + j * kLaneCount); };
      const auto n =
          eigen_decomposition(
              Symmetric3<FloatLanes>{entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)})
              .smallest_vector;
      store_lanes(n.x, &normals[3 * kLaneCount * i]);
      store_lanes(n.y, &normals[3 * kLaneCount * i + kLaneCount]);
      store_lanes(n.z, &normals[3 * kLaneCount * i + 2 * kLaneCount]);
    }
    benchmark::DoNotOptimize(normals.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatches * kLaneCount));
}

void eigen_library(benchmark::State& state) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<Eigen::Matrix3f> matrices(4096);
  for (Eigen::Matrix3f& m : matrices) {
    m = Eigen::Matrix3f::NullaryExpr([&](Eigen::Index, Eigen::Index) { return unit(rng); });
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  for (auto _ : state) {
    for (const Eigen::Matrix3f& m : matrices) {
      solver.computeDirect(m);
      benchmark::DoNotOptimize(solver.eigenvectors().col(0).data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(matrices.size()));
}

void scans(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("scan")
      ->Arg(kVlp16)
      ->Arg(kMid360)
      ->Arg(kMid360Dense)
      ->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(estimate, fixed_block_tree, fixed_radius(), NormalMethod::kBlockTree)
    ->Apply(scans);
BENCHMARK_CAPTURE(nanoflann_baseline, fixed, fixed_radius())->Apply(scans);
#ifdef NVM_BENCHMARK_PCL
BENCHMARK(pcl_baseline)->Apply(scans);
#endif
#ifdef NVM_BENCHMARK_SMALL_GICP
BENCHMARK(small_gicp_baseline)->Apply(scans);
#endif
BENCHMARK_CAPTURE(estimate, adaptive_block_tree, adaptive_radius(), NormalMethod::kBlockTree)
    ->Apply(scans);
BENCHMARK_CAPTURE(nanoflann_baseline, adaptive, adaptive_radius())->Apply(scans);
BENCHMARK_CAPTURE(estimate, per_cell, NormalOptions(), NormalMethod::kPerCell)->Apply(scans);
BENCHMARK(eigen_batched);
BENCHMARK(eigen_library);

}  // namespace
}  // namespace nvm
