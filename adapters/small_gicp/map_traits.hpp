// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <small_gicp/ann/traits.hpp>
#include <small_gicp/points/traits.hpp>

#include "nvm/map/voxel_map.hpp"

/// small_gicp takes an nvm::VoxelMap as the target cloud and as its search tree, with its own
/// factors or with those of plane_factor.hpp. docs/adapters/small_gicp.md
namespace small_gicp::traits {

/// An index is the PointId of a stored point: valid until the map changes. Not every index below
/// size() is one.
template <>
struct Traits<nvm::VoxelMap> {
  using Map = nvm::VoxelMap;

  static std::size_t size(const Map& map) { return map.size(); }
  static bool has_points(const Map& map) { return !map.empty(); }
  static bool has_normals(const Map& map) { return !map.empty(); }
  static bool has_covs(const Map&) { return false; }
  static Eigen::Vector4d point(const Map& map, std::size_t i) {
    return map.position(static_cast<nvm::PointId>(i)).homogeneous();
  }
  static Eigen::Vector4d normal(const Map& map, std::size_t i) {
    Eigen::Vector4d normal = Eigen::Vector4d::Zero();
    normal.head<3>() = map.normal(static_cast<nvm::PointId>(i)).template cast<double>();
    return normal;
  }

  /// Both sides, at most 64 neighbours, from the 27 voxels around `point`.
  static std::size_t knn_search(
      const Map& map,
      const Eigen::Vector4d& point,
      std::size_t k,
      std::size_t* k_indices,
      double* k_sq_dists) {
    std::array<nvm::Neighbor, nvm::kMaxNeighbors> found;
    const nvm::NearestSearch search{k, kAnyDistance, nvm::Gate::kSurfaces};
    const std::size_t count =
        map.nearest(Eigen::Vector3d(point.head<3>()), search, found.data(), context());
    return copy(found.data(), count, k_indices, k_sq_dists);
  }
  static std::size_t nearest_neighbor_search(
      const Map& map, const Eigen::Vector4d& point, std::size_t* k_index, double* k_sq_dist) {
    return knn_search(map, point, 1, k_index, k_sq_dist);
  }

  /// Only points that agree with `normal`, in the frame of the map; both sides when it is zero.
  static std::size_t gated_nearest_neighbor_search(
      const Map& map,
      const Eigen::Vector4d& point,
      const Eigen::Vector3d& normal,
      std::size_t* k_index,
      double* k_sq_dist) {
    if (normal.isZero()) {
      return nearest_neighbor_search(map, point, k_index, k_sq_dist);
    }
    std::array<nvm::Neighbor, 1> found;
    const std::size_t count = map.nearest(
        Eigen::Vector3d(point.head<3>()),
        Eigen::Vector3f(normal.cast<float>()),
        {1, kAnyDistance, nvm::Gate::kSurfaces},
        found.data(),
        context());
    return copy(found.data(), count, k_index, k_sq_dist);
  }

 private:
  static constexpr double kAnyDistance = 1e6;

  static std::size_t copy(
      const nvm::Neighbor* found, std::size_t count, std::size_t* indices, double* sq_dists) {
    for (std::size_t i = 0; i < count; ++i) {
      indices[i] = found[i].id;
      sq_dists[i] = static_cast<double>(found[i].sq_distance);
    }
    return count;
  }
  static Map::QueryContext& context() noexcept {
    thread_local Map::QueryContext context;
    return context;
  }
};

}  // namespace small_gicp::traits
