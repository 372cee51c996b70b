// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "adapters/common/host_map.hpp"

namespace nvm::adapters {

/// An nvm map with the members of the VoxelHashMap of KISS-ICP; `Pose` is its Sophus::SE3d, or
/// anything with `pose * point` and `translation()`. docs/adapters/kiss_icp.md says what to change
/// in a host.
///
/// Defaults: points are stored with the direction to the origin that the host passes to Update(),
/// and queries look along the direction to the last such origin, so that the sides of walls are
/// told apart without a changed line. Points added before any Update() have no side.
///
/// Const members may run from many threads at once, every other member needs the map for itself.
template <class Pose>
class KissMap {
 public:
  using Points = std::vector<Eigen::Vector3d>;

  /// `voxel_size` and `max_distance` in m, as the host does. Throws std::invalid_argument when they
  /// or max_points_per_voxel (1 to 120) are out of range.
  explicit KissMap(double voxel_size, double max_distance, unsigned int max_points_per_voxel)
      : max_distance_(max_distance) {
    HostOptions options;
    options.map.voxel_size = voxel_size;
    options.map.points_per_surface = static_cast<int>(max_points_per_voxel);
    options.map.min_point_distance = voxel_size / std::sqrt(max_points_per_voxel);
    options.normals = {
        NormalSource::kViewDirection, NormalSource::kViewDirection, MissingNormal::kUngated};
    configure(options);
  }

  // --- what the host does not know

  const HostOptions& options() const noexcept { return map_.options(); }
  /// Empties the map and changes its options; throws as the constructor.
  void configure(const HostOptions& options) { map_.configure(options); }
  /// Empties the map and makes it behave as the host's own, for comparisons.
  void make_transparent() {
    HostOptions options = transparent_options(map_.options().map.voxel_size);
    options.map.points_per_surface = map_.options().map.points_per_surface;
    options.map.min_point_distance = map_.options().map.min_point_distance;
    configure(options);
  }

  /// The nearest stored point that agrees with the unit `normal` of the query, map frame.
  std::tuple<Eigen::Vector3d, double> GetClosestNeighbor(
      const Eigen::Vector3d& query, const Eigen::Vector3d& normal) const {
    return closest(query, normal.cast<float>());
  }
  /// The nearest stored point on the sides that a sensor at `origin` [m, map frame] sees.
  std::tuple<Eigen::Vector3d, double> GetClosestNeighborFrom(
      const Eigen::Vector3d& query, const Eigen::Vector3d& origin) const {
    return closest(query, view_direction(query, origin));
  }
  /// Adds points with unit normals, both in the map frame; a range of 3-vectors each. Not another
  /// AddPoints: the host's Python bindings take the address of that.
  template <class Normals>
  void AddPointsWithNormals(const Points& points, const Normals& normals) {
    map_.insert(points, normals);
  }
  const HostMap& map() const noexcept { return map_; }

  // --- what the host calls

  void Clear() noexcept { map_.clear(); }
  bool Empty() const noexcept { return map_.size() == 0; }

  /// Adds points of the map frame, seen from `origin`, and drops the voxels beyond max_distance.
  void Update(const Points& points, const Eigen::Vector3d& origin) {
    map_.set_view_point(origin);
    AddPoints(points);
    RemovePointsFarFromLocation(origin);
  }
  /// The same with points of the sensor frame.
  void Update(const Points& points, const Pose& pose) {
    Points transformed;
    transformed.reserve(points.size());
    for (const Eigen::Vector3d& point : points) {
      transformed.push_back(pose * point);
    }
    Update(transformed, Eigen::Vector3d(pose.translation()));
  }
  void AddPoints(const Points& points) { map_.insert(points); }

  void RemovePointsFarFromLocation(const Eigen::Vector3d& origin) {
    if (map_.map() != nullptr) {
      map_.map()->erase_voxels_beyond(origin, max_distance_);
    }
  }

  /// All points of both sides, map frame.
  Points Pointcloud() const {
    Points points;
    points.reserve(map_.size());
    map_.for_each_point([&](const Eigen::Vector3d& position, const Eigen::Vector3f&) {
      points.push_back(position);
    });
    return points;
  }

  /// The nearest stored point in the 27 voxels around `query`, and its distance [m]; zero and the
  /// largest double when there is none, as the host has it.
  std::tuple<Eigen::Vector3d, double> GetClosestNeighbor(const Eigen::Vector3d& query) const {
    return closest(query, map_.normals().query_normal(query));
  }

 private:
  std::tuple<Eigen::Vector3d, double> closest(
      const Eigen::Vector3d& query, const Eigen::Vector3f& normal) const noexcept {
    std::array<Neighbor, 1> found;
    constexpr NearestSearch kAny{1, std::numeric_limits<double>::infinity(), Gate::kSurfaces};
    if (map_.nearest(query, normal, kAny, found.data()) == 0) {
      return {Eigen::Vector3d::Zero(), std::numeric_limits<double>::max()};
    }
    return {found[0].position, std::sqrt(static_cast<double>(found[0].sq_distance))};
  }

  double max_distance_;
  HostMap map_;
};

}  // namespace nvm::adapters
