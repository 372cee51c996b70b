// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/value_row.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// The points from `min` to `max` [m], inclusive.
struct BoxRegion {
  Eigen::Vector3d min;
  Eigen::Vector3d max;

  bool contains(const Eigen::Vector3d& point) const {
    return on_all_axes(
        [&](int axis) { return point[axis] >= min[axis] && point[axis] <= max[axis]; });
  }
  bool may_touch(const Lattice& lattice, const VoxelIndex& voxel) const {
    const double edge = lattice.meters_per_step() * kStepsPerVoxel;
    return on_all_axes([&](int axis) {
      const double low = voxel[axis] * edge;
      return low + edge >= min[axis] && low <= max[axis];
    });
  }
  bool is_valid() const { return all_numbers(min) && all_numbers(max); }
  const Eigen::Vector3d& low() const { return min; }
  const Eigen::Vector3d& high() const { return max; }
};

/// The points at most `radius` [m] from `center`.
struct BallRegion {
  Eigen::Vector3d center;
  double radius;

  bool contains(const Eigen::Vector3d& point) const {
    return is_within(difference(point, center), radius);
  }
  bool may_touch(const Lattice& lattice, const VoxelIndex& voxel) const {
    return sq_distance_to_voxels(lattice, center, voxel, voxel) <= radius * radius * (1.0 + 1e-9);
  }
  bool is_valid() const { return all_finite(center) && is_distance(radius); }
  Eigen::Vector3d low() const {
    return per_axis([&](int axis) { return center[axis] - radius; });
  }
  Eigen::Vector3d high() const {
    return per_axis([&](int axis) { return center[axis] + radius; });
  }
};

/// Keeps of the surface at `head` only the points outside `region`. Head of what is left, or kNone.
template <class Region>
std::uint32_t erase_from_surface(
    VoxelStorage& storage, const Lattice& lattice, std::uint32_t head, const Region& region) {
  struct Point {
    WrappedPoint position;
    StoredNormal normal;
    ValueRow row;
  };
  std::array<Point, MapOptions::kMaxPointsPerSurface> kept;
  std::size_t count = 0;
  for_each_id(storage, head, [&](PointId id) {
    if (!region.contains(stored_position(storage, lattice, id))) {
      kept[count].position = stored_point(storage, id);
      kept[count].normal = stored_normal(storage, id);
      storage.get_row(id / kLanes, static_cast<int>(id % kLanes), kept[count].row);
      ++count;
    }
  });
  if (count == storage.chunk(head).size) {
    return head;
  }
  const std::uint32_t voxel = storage.chunk(head).voxel;
  storage.release_surface(head);
  if (count == 0) {
    return kNone;
  }
  const std::uint32_t surface = storage.create_surface(voxel, kept[0].position);
  std::uint32_t last = surface;
  for (std::size_t i = 0; i < count; ++i) {
    last = storage.append(surface, last, kept[i].position, kept[i].normal);
    storage.set_row(last, static_cast<int>(i % kLanes), kept[i].row);
  }
  return surface;
}

/// Erases the points of `region` from the voxel with the front surface `front`; a voxel without
/// points goes. The front goes before the back: what is left of a voxel whose front is erased
/// becomes its front.
template <class Region>
void erase_from_voxel(
    VoxelStorage& storage, const Lattice& lattice, std::uint32_t front, const Region& region) {
  const std::uint32_t voxel = storage.chunk(front).voxel;
  std::uint32_t last = kNone;
  for (std::uint32_t head = front; head != kNone;) {
    const std::uint32_t next = storage.chunk(head).next_surface;
    const std::uint32_t left = erase_from_surface(storage, lattice, head, region);
    if (left != kNone) {
      storage.link_surface(left, kNone);
      if (last == kNone) {
        storage.set_front(left);
      } else {
        storage.link_surface(last, left);
      }
      last = left;
    }
    head = next;
  }
  if (last == kNone) {
    storage.forget_voxel(voxel);
  }
}

/// Looks only at the bricks that the region touches, so that erasing a little costs little.
template <class Region>
void erase_region(VoxelStorage& storage, const Lattice& lattice, const Region& region) {
  if (!region.is_valid()) {
    return;
  }
  // Rounding may put a point at the region's border into the brick beside it.
  const double margin = lattice.meters_per_step();
  const Eigen::Vector3d low = region.low();
  const Eigen::Vector3d high = region.high();
  for_each_voxel_near(
      storage,
      lattice,
      per_axis([&](int axis) { return low[axis] - margin; }),
      per_axis([&](int axis) { return high[axis] + margin; }),
      [&](std::uint32_t front, const VoxelIndex& index) {
        if (region.may_touch(lattice, index)) {
          erase_from_voxel(storage, lattice, front, region);
        }
      });
}

template <class = void>
void erase_voxels_beyond(
    VoxelStorage& storage, const Lattice& lattice, const Eigen::Vector3d& center, double radius) {
  if (!all_finite(center) || !is_distance(radius)) {
    return;
  }
  constexpr int kMiddle = kStepsPerVoxel / 2;
  const BallRegion near{center, radius};
  for (std::uint32_t brick = 0; brick < storage.brick_high_water(); ++brick) {
    storage.visit_brick(brick, [&](std::uint32_t front, const VoxelIndex& index) {
      if (!near.contains(lattice.position(index, {kMiddle, kMiddle, kMiddle}))) {
        storage.erase_voxel(storage.chunk(front).voxel);
      }
    });
  }
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
