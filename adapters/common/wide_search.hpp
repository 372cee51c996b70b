// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "nvm/map/neighbor.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::adapters {

/// How far [m] the 27 voxels around `point` reach in every direction.
inline double covered_distance(const Eigen::Vector3d& point, double voxel_size) noexcept {
  const Eigen::Array3d scaled = point.array() / voxel_size;
  const Eigen::Array3d inside = scaled - scaled.floor();
  return voxel_size * (1.0 + inside.min(1.0 - inside).minCoeff());
}

/// Keeps the nearest `room` of the neighbours that it is shown, ascending, in a caller's array.
class NearestList {
 public:
  NearestList(Neighbor* out, std::size_t room) : out_(out), room_(room) {}

  void show(const Neighbor& neighbor) noexcept {
    if (count_ == room_ && !(before(neighbor, out_[count_ - 1]))) {
      return;
    }
    std::size_t place = count_ < room_ ? count_++ : count_ - 1;
    for (; place > 0 && before(neighbor, out_[place - 1]); --place) {
      out_[place] = out_[place - 1];
    }
    out_[place] = neighbor;
  }

  std::size_t count() const noexcept { return count_; }

 private:
  static bool before(const Neighbor& a, const Neighbor& b) noexcept {
    return a.sq_distance != b.sq_distance ? a.sq_distance < b.sq_distance : a.id < b.id;
  }

  Neighbor* out_;
  std::size_t room_;
  std::size_t count_ = 0;
};

/// The exact nearest neighbours within search.max_distance of any length, of those that `accept`s
/// (const Neighbor&) takes: a ball that grows until it holds search.count. Otherwise as
/// VoxelMap::nearest. Much slower than the 27 voxels; no allocation.
template <class Accept>
std::size_t nearest_wide(
    const VoxelMap& map,
    const Eigen::Vector3d& point,
    const NearestSearch& search,
    const Accept& accept,
    Neighbor* out) {
  const std::size_t wanted = std::min(search.count, kMaxNeighbors);
  if (wanted == 0) {
    return 0;
  }
  const double last_small_radius = 16.0 * map.options().voxel_size;
  for (double radius = 2.0 * map.options().voxel_size;; radius *= 2.0) {
    radius =
        radius < search.max_distance && radius <= last_small_radius ? radius : search.max_distance;
    NearestList nearest(out, wanted);
    map.for_each_within(point, radius, [&](const Neighbor& neighbor) {
      if (accept(neighbor)) {
        nearest.show(neighbor);
      }
    });
    if (nearest.count() == wanted || radius >= search.max_distance) {
      return nearest.count();
    }
  }
}

/// Whether a query with `normal`, a unit vector or a sighting, finds points with `stored`, as
/// VoxelMap::nearest has it: only sightings find sightings.
inline bool faces(
    const Eigen::Vector3f& stored, const Eigen::Vector3f& normal, float min_dot) noexcept {
  return (is_sighting(normal) || !is_sighting(stored)) &&
         stored.normalized().dot(normal.normalized()) > min_dot;
}

/// A search that may go on beyond the 27 voxels around the query.
struct ReachingSearch {
  NearestSearch nearest;
  double reach = 0.0;  ///< at most so far [m]; 0: never beyond
};

/// VoxelMap::nearest, and when the 27 voxels do not settle the answer within
/// reaching.nearest.max_distance, nearest_wide to at most reaching.reach. `normal` is a unit
/// vector or a sighting, or null to see both sides. Beyond the 27 voxels only the normals of points
/// are compared, not those of surfaces.
inline std::size_t nearest_within_reach(
    const VoxelMap& map,
    const Eigen::Vector3d& point,
    const Eigen::Vector3f* normal,
    const ReachingSearch& reaching,
    Neighbor* out) {
  const auto& [search, reach] = reaching;
  thread_local VoxelMap::QueryContext context;
  const std::size_t count = normal != nullptr ? map.nearest(point, *normal, search, out, context)
                                              : map.nearest(point, search, out, context);
  if (reach <= 0.0) {
    return count;
  }
  const double covered = covered_distance(point, map.options().voxel_size);
  if (std::min(reach, search.max_distance) <= covered ||
      (count == search.count && out[count - 1].sq_distance <= covered * covered)) {
    return count;
  }
  const auto min_dot = static_cast<float>(std::cos(map.options().max_point_angle));
  const auto agrees = [&](const Neighbor& n) {
    return normal == nullptr || faces(map.normal(n.id), *normal, min_dot);
  };
  const NearestSearch wide{search.count, std::min(search.max_distance, reach), search.gate};
  return nearest_wide(map, point, wide, agrees, out);
}

}  // namespace nvm::adapters
