// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/map/map_point.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/point_values.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/value_row.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Like VoxelStorage::for_each_voxel, for the bricks of which a part lies between the corners `min`
/// and `max` [m], neither of which has a NaN, and maybe others.
template <class Visitor>
void for_each_voxel_near(
    const VoxelStorage& storage,
    const Lattice& lattice,
    const Eigen::Vector3d& min,
    const Eigen::Vector3d& max,
    Visitor&& visit) {
  constexpr double kEnd = kMaxVoxelIndex / kBrickEdge;  // of the bricks, in both directions
  const double bricks_per_meter = lattice.voxels_per_meter() / kBrickEdge;
  const Eigen::Vector3d low =
      per_axis([&](int axis) { return std::max(std::floor(min[axis] * bricks_per_meter), -kEnd); });
  const Eigen::Vector3d high =
      per_axis([&](int axis) { return std::min(std::floor(max[axis] * bricks_per_meter), kEnd); });
  const Eigen::Vector3d counts = per_axis(  // none where the map cannot reach
      [&](int axis) { return std::max(high[axis] - low[axis] + 1.0, 0.0); });
  const double bricks = counts.x() * counts.y() * counts.z();
  if (bricks >= static_cast<double>(storage.brick_count())) {  // cheaper to look at all
    storage.for_each_voxel(visit);
    return;
  }
  if (bricks < 1.0) {
    return;
  }
  const VoxelIndex first = truncated(low);
  const VoxelIndex last = truncated(high);
  for (std::int32_t z = first.z(); z <= last.z(); ++z) {
    for (std::int32_t y = first.y(); y <= last.y(); ++y) {
      for (std::int32_t x = first.x(); x <= last.x(); ++x) {
        const std::uint32_t id = storage.find_brick(index_key({x, y, z}));
        if (id != kNone) {
          storage.visit_brick(id, visit);
        }
      }
    }
  }
}

/// Calls visit(PointId) for each point of the surface at `head`.
template <class Visitor>
void for_each_id(const VoxelStorage& storage, std::uint32_t head, Visitor&& visit) {
  int left = storage.chunk(head).size;
  for (std::uint32_t id = head; left > 0; id = storage.chunk(id).next, left -= kLanes) {
    for (int lane = 0; lane < std::min(left, kLanes); ++lane) {
      visit(id * kLanes + static_cast<PointId>(lane));
    }
  }
}

inline WrappedPoint stored_point(const VoxelStorage& storage, PointId id) {
  return storage.chunk(id / kLanes).wrapped(id % kLanes);
}

inline VoxelStep stored_step(const VoxelStorage& storage, PointId id) {
  const WrappedPoint point = stored_point(storage, id);
  return {step_in_voxel(point.x), step_in_voxel(point.y), step_in_voxel(point.z)};
}

inline StoredNormal stored_normal(const VoxelStorage& storage, PointId id) {
  return storage.normals(id / kLanes).get(static_cast<int>(id % kLanes));
}

inline Eigen::Vector3d stored_position(
    const VoxelStorage& storage, const Lattice& lattice, PointId id) {
  return lattice.position(
      storage.index_of(storage.chunk(id / kLanes).voxel), stored_step(storage, id));
}

inline int side_of(const VoxelStorage& storage, PointId id) {
  int side = 0;
  for (std::uint32_t head = storage.head_of(storage.chunk(id / kLanes).voxel); head != kNone;
       head = storage.chunk(head).next_surface, ++side) {
    for (std::uint32_t chunk = head; chunk != kNone; chunk = storage.chunk(chunk).next) {
      if (chunk == id / kLanes) {
        return side;
      }
    }
  }
  NVM_ASSERT(false);
  return side;
}

/// A visitor that appends to `items`. (A lambda in a shared class would have one name for every
/// target.)
template <class Item>
struct Collector {
  std::vector<Item>& items;
  void operator()(const Item& item) const { items.push_back(item); }
};

inline PointValues stored_values(
    const VoxelStorage& storage, const MapColumns& columns, PointId id) {
  ValueRow row;
  storage.get_row(id / kLanes, static_cast<int>(id % kLanes), row);
  return unpack(columns, row);
}

template <class Visitor>
void for_each_point(
    const VoxelStorage& storage,
    const Lattice& lattice,
    const MapColumns& columns,
    Visitor&& visit) {
  storage.for_each_voxel([&](std::uint32_t front, const VoxelIndex& index) {
    int side = 0;
    for (std::uint32_t head = front; head != kNone;
         head = storage.chunk(head).next_surface, ++side) {
      for_each_id(storage, head, [&](PointId id) {
        visit(MapPoint{
            lattice.position(index, stored_step(storage, id)),
            load_normal(stored_normal(storage, id)),
            side,
            stored_values(storage, columns, id)});
      });
    }
  });
}

/// Squared distance from `point` to the box of the voxels `low` to `high`, inclusive [m^2].
inline double sq_distance_to_voxels(
    const Lattice& lattice,
    const Eigen::Vector3d& point,
    const VoxelIndex& low,
    const VoxelIndex& high) {
  const double edge = lattice.meters_per_step() * kStepsPerVoxel;
  return sq_norm(per_axis([&](int axis) {
    const double below = low[axis] * edge - point[axis];
    const double above = point[axis] - (high[axis] + 1.0) * edge;
    return std::max(std::max(below, above), 0.0);
  }));
}

/// Whether `offset` [m] is at most `radius` long, also where the squares of both are too large for
/// a double.
inline bool is_within(const Eigen::Vector3d& offset, double radius) {
  constexpr double kLargestSquared = 1e150;
  return radius < kLargestSquared
             ? sq_norm(offset) <= radius * radius
             : sq_norm(per_axis([&](int axis) { return offset[axis] / radius; })) <= 1.0;
}

template <class Visitor>
void for_each_within(
    const VoxelStorage& storage,
    const Lattice& lattice,
    const Eigen::Vector3d& center,
    double radius,
    Visitor&& visit) {
  const double sq_radius = radius * radius;
  if (!all_finite(center) || !is_distance(radius)) {
    return;
  }
  const auto visit_voxel = [&](std::uint32_t front, const VoxelIndex& index) {
    if (sq_distance_to_voxels(lattice, center, index, index) > sq_radius) {
      return;
    }
    for (std::uint32_t head = front; head != kNone; head = storage.chunk(head).next_surface) {
      for_each_id(storage, head, [&](PointId id) {
        const Eigen::Vector3d position = lattice.position(index, stored_step(storage, id));
        const Eigen::Vector3d offset = difference(position, center);
        if (is_within(offset, radius)) {
          storage.recency().use(storage.chunk(head).voxel);
          visit(Neighbor{position, static_cast<float>(sq_norm(offset)), id});
        }
      });
    }
  };
  for_each_voxel_near(
      storage,
      lattice,
      per_axis([&](int axis) { return center[axis] - radius; }),
      per_axis([&](int axis) { return center[axis] + radius; }),
      visit_voxel);
}

inline MapStats count_all(const VoxelStorage& storage) {
  MapStats stats;
  stats.points = storage.point_count();
  stats.voxels = storage.voxel_count();
  stats.memory_bytes = storage.memory_bytes();
  storage.for_each_voxel([&](std::uint32_t front, const VoxelIndex&) {
    for (std::uint32_t head = front; head != kNone; head = storage.chunk(head).next_surface) {
      ++stats.surfaces;
    }
    stats.two_sided_voxels += storage.chunk(front).next_surface != kNone ? 1U : 0U;
  });
  return stats;
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
