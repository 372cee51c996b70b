// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "adapters/common/host_map.hpp"
#include "adapters/ikd_tree/cube_rule.hpp"

namespace nvm::adapters {

/// What becomes of points that the host adds with `downsample`.
enum class CubeRule {
  kMap,              ///< the map's own: min_point_distance and points_per_surface
  kNearestToCenter,  ///< a cube of the host's filter size keeps, per side, only the point nearest
                     ///< to its centre, as ikd-Tree does; slower
};

/// An axis-aligned box, in the form in which the hosts of ikd-Tree write it [m].
struct IkdBox {
  float vertex_min[3];
  float vertex_max[3];
};

/// An nvm map with the members of ikd-Tree that FAST_LIO and its relatives use. Member names and
/// signatures are theirs. docs/adapters/ikd_tree.md says what to change in a host.
///
/// Defaults: normals from the points; where a point has none, the direction to the view point;
/// without a view point, both sides. Voxels of the host's filter size, at least 0.3 m, which keeps
/// the density rule. Points of one side stay 0.1 m apart: ikd-Tree deletes the points that it
/// replaces; a map that keeps them all has so many that the nearest five lie on one scan line,
/// where they do not determine a plane.
///
/// Nearest_Search may be called from many threads at once, every other member needs the tree for
/// itself. Constructing one costs nothing.
template <class Point>
class IkdTree {
 public:
  using PointVector = std::vector<Point, Eigen::aligned_allocator<Point>>;
  struct KD_TREE_NODE {};

  /// Null until the first Build() with points, then never again: the host's sign of a made map.
  KD_TREE_NODE* Root_Node = nullptr;
  /// For the host's use; nothing here reads it.
  PointVector PCL_Storage;

  IkdTree() {
    options_.map.voxel_size = kFromFilter;
    options_.surface_neighbors = kSurfaceNeighbors;
  }
  IkdTree(const IkdTree&) = delete;  // Root_Node points into the object
  IkdTree& operator=(const IkdTree&) = delete;

  // --- what the host does not know

  /// Takes effect at the next Build(). A voxel size of kFromFilter follows the host's filter size.
  static constexpr double kFromFilter = 0.0;
  HostOptions& options() noexcept { return options_; }
  CubeRule cube_rule = CubeRule::kMap;

  /// Behaves like ikd-Tree, as far as 5 neighbours within `reach` [m] need it: for comparisons.
  void make_transparent(double reach = 2.2360679774997896) {
    options_ = transparent_options(kFromFilter);
    options_.reach = reach;
    cube_rule = CubeRule::kNearestToCenter;
  }
  /// Where the sensor is, map frame [m]: once per scan, before Build() and Add_Points().
  void set_view_point(double x, double y, double z) noexcept { map_.set_view_point({x, y, z}); }
  /// One line when the voxels are too small for the host's filter size; else empty.
  std::string density_warning() const { return adapters::density_warning(voxel_size(), cube_, 5); }
  const HostMap& map() const noexcept { return map_; }

  // --- what the host calls

  /// The edge [m] of the cubes that the host keeps one point of.
  void set_downsample_param(float cube) { cube_ = cube; }

  /// Replaces the contents. Writes density_warning() to the standard error output when there is
  /// one. Throws std::invalid_argument when the options are out of range.
  void Build(const PointVector& points) {
    if (const std::string warning = density_warning(); !warning.empty()) {
      std::cerr << warning << '\n';
    }
    HostOptions options = options_;
    options.map.voxel_size = voxel_size();
    map_.configure(options);
    map_.insert(points);
    if (!points.empty()) {
      Root_Node = &node_;
    }
  }

  /// The up to `k` (at most 64) nearest points, nearest first, and the squares of their distances
  /// as stored [m^2]; `max_distance` [m] is inclusive. See HostOptions::surface_neighbors.
  void Nearest_Search(
      const Point& point,
      int k,
      PointVector& points,
      std::vector<float>& sq_distances,
      double max_distance = INFINITY) const {
    std::array<Neighbor, kMaxNeighbors> found;
    const auto wanted = static_cast<std::size_t>(std::clamp<int>(k, 0, kMaxNeighbors));
    const std::size_t count =
        map_.nearest(point, {wanted, max_distance, Gate::kSurfaces}, found.data());
    write_positions(found.data(), count, points);
    sq_distances.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      sq_distances[i] = found[i].sq_distance;
    }
  }

  /// Returns how many points were stored of those to downsample, and 0 without.
  int Add_Points(const PointVector& points, bool downsample) {
    if (downsample && cube_rule == CubeRule::kNearestToCenter && map_.map() != nullptr) {
      return static_cast<int>(std::count_if(points.begin(), points.end(), [this](const Point& p) {
        return insert_nearest_to_center(map_, p, cube_);
      }));
    }
    const InsertStats stats = map_.insert(points);
    return downsample ? static_cast<int>(stats.stored) : 0;
  }

  /// Erases the points in the boxes; returns how many.
  template <class Boxes>
  int Delete_Point_Boxes(const Boxes& boxes) {
    std::size_t erased = 0;
    for (const auto& box : boxes) {
      if (map_.map() != nullptr) {
        erased += map_.map()->erase_box(corner(box.vertex_min), corner(box.vertex_max));
      }
    }
    return static_cast<int>(erased);
  }

  /// The map keeps no list of removed points: leaves `points` empty.
  void acquire_removed_points(PointVector& points) const { points.clear(); }

  int size() const noexcept { return static_cast<int>(map_.size()); }
  int validnum() const noexcept { return size(); }

  /// Appends all points of both sides, with their normals, to `points`. The node and the third
  /// argument are the host's and have no meaning here.
  template <class Storage>
  void flatten(const KD_TREE_NODE*, PointVector& points, Storage) const {
    points.reserve(points.size() + map_.size());
    map_.for_each_point([&](const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
      points.push_back(make_point<Point>(position, normal));
    });
  }

 private:
  double voxel_size() const noexcept {
    constexpr double kLeast = 0.3;
    return options_.map.voxel_size == kFromFilter ? std::max(kLeast, cube_)
                                                  : options_.map.voxel_size;
  }

  static Eigen::Vector3d corner(const float* vertex) {
    return Eigen::Vector3f(vertex[0], vertex[1], vertex[2]).cast<double>();
  }

  HostOptions options_;
  double cube_ = 0.2;
  HostMap map_;
  KD_TREE_NODE node_;
};

}  // namespace nvm::adapters
