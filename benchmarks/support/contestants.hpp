// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nanoflann.hpp>
#include <tuple>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "support/hash_of_vectors_map.hpp"
#include "support/walk.hpp"

#ifdef NVM_BENCHMARK_SMALL_GICP
#include <small_gicp/ann/incremental_voxelmap.hpp>
#include <small_gicp/points/point_cloud.hpp>
#endif
#ifdef NVM_BENCHMARK_KISS_ICP
#include <kiss_icp/core/VoxelHashMap.hpp>
#endif
#ifdef NVM_BENCHMARK_PCL
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#endif

// The maps and trees that odometries use, behind one set of functions: insert(scan) -> points
// stored, nearest(query, wanted) -> how many were found, and sq_distance(i) of the i-th. All have
// the same voxels, spacing and capacity.
namespace nvm::benchmarks {

inline constexpr double kVoxelSize = 0.3;
inline constexpr double kSpacing = 0.1;
inline constexpr int kCapacity = 20;

inline MapOptions nvm_options() {
  MapOptions options;
  options.voxel_size = kVoxelSize;
  options.min_point_distance = kSpacing;
  options.points_per_surface = kCapacity;
  options.capacity = 4'000'000;
  return options;
}

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
    tree->findNeighbors(result, query.point.data(), {});
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

#ifdef NVM_BENCHMARK_KISS_ICP
/// The map of KISS-ICP, which answers with the nearest point only. Its spacing follows from the
/// number of points in a voxel.
struct KissIcp {
  static constexpr double kFarAway = 1e9;

  KissIcp()
      : map(kVoxelSize,
            kFarAway,
            static_cast<unsigned>(std::lround(kVoxelSize * kVoxelSize / (kSpacing * kSpacing)))) {}
  std::size_t insert(const CorridorScan& scan) {
    points.clear();
    for (const Eigen::Vector3f& point : scan.points) {
      points.push_back(scan.T_map_scan * point.cast<double>());
    }
    map.AddPoints(points);
    return 0;
  }
  std::size_t nearest(const Query& query, std::size_t) {
    distance = std::get<double>(map.GetClosestNeighbor(query.point));
    return 1;
  }
  double sq_distance(std::size_t) const { return distance * distance; }

  kiss_icp::VoxelHashMap map;
  std::vector<Eigen::Vector3d> points;
  double distance = 0.0;
};
#endif

#ifdef NVM_BENCHMARK_PCL
/// PCL's static tree over the points of an NVM map.
struct PclKdTree {
  std::size_t insert(const CorridorScan& scan) { return source.insert(scan); }
  std::size_t nearest(const Query& query, std::size_t wanted) {
    if (tree.getInputCloud() == nullptr) {
      build();
    }
    const pcl::PointXYZ point(
        static_cast<float>(query.point.x()),
        static_cast<float>(query.point.y()),
        static_cast<float>(query.point.z()));
    return static_cast<std::size_t>(
        tree.nearestKSearch(point, static_cast<int>(wanted), ids, sq_distances));
  }
  double sq_distance(std::size_t i) const { return sq_distances[i]; }
  void build() {
    const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    source.map.for_each_point([&](const MapPoint& point) {
      const Eigen::Vector3f p = point.position.cast<float>();
      cloud->push_back({p.x(), p.y(), p.z()});
    });
    tree.setInputCloud(cloud);
  }

  Nvm source;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  std::vector<int> ids;
  std::vector<float> sq_distances;
};
#endif

/// The map of the whole walk.
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

}  // namespace nvm::benchmarks
