// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/pool.hpp"
#include "nvm/map/storage/principal_direction.hpp"
#include "nvm/map/storage/stored_normal.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

inline constexpr int kLanes = 8;  // points in a chunk

/// Eight points of one surface, in one cache line. The chunks of a surface form a list; its first
/// chunk, the head, also says what a query must know of the surface before it reads a point, and
/// links the heads of the voxel's surfaces, front first. All chunks of a surface but the last are
/// full; lanes without a point lie where no query looks.
struct alignas(64) PointChunk {
  std::int16_t xy[2 * kLanes];  // x0 y0 x1 y1 ...: interleaved, so that one instruction squares and
                                // adds both
  std::int16_t z[kLanes];
  std::uint32_t next;          // chunk of this surface, or kNone
  std::uint32_t next_surface;  // heads only: head of the voxel's next surface, or kNone
  std::uint32_t voxel;
  StoredNormal direction;  // heads only: principal direction
  std::uint8_t size : 7;   // heads only: points in the surface
  std::uint8_t tight : 1;  // heads only: every normal is within kTightAngle of the direction

  void set_position(int lane, const WrappedPoint& point) {
    xy[2 * lane] = point.x;
    xy[2 * lane + 1] = point.y;
    z[lane] = point.z;
  }
  /// Moves all lanes 4 voxels away from `inside`, a point of the voxel, along each axis: a query,
  /// whose voxel is the same or next to it, has them more than 2 voxels away along each.
  void clear_lanes(const WrappedPoint& inside) {
    const auto away = [](std::int16_t coordinate) {
      return static_cast<std::int16_t>(coordinate ^ std::numeric_limits<std::int16_t>::min());
    };
    for (int lane = 0; lane < kLanes; ++lane) {
      set_position(lane, {away(inside.x), away(inside.y), away(inside.z)});
    }
  }
  WrappedPoint wrapped(std::size_t lane) const { return {xy[2 * lane], xy[2 * lane + 1], z[lane]}; }
};
static_assert(sizeof(PointChunk) == 64);

/// Normals of a plane scatter less than this [rad]; a surface with a larger scatter tests each
/// point's normal.
inline constexpr double kTightAngle = 0.5235987755982988;
inline constexpr int kTightDot = 13968;  // dot_threshold(kTightAngle)

/// The normals of a chunk, apart from it: most queries never read them.
struct NormalChunk {
  std::int8_t x[kLanes];
  std::int8_t y[kLanes];
  std::int8_t z[kLanes];
  PowerStep power_step;  // heads only

  void set(int lane, const StoredNormal& normal) {
    x[lane] = normal.x;
    y[lane] = normal.y;
    z[lane] = normal.z;
  }
  StoredNormal get(int lane) const { return {x[lane], y[lane], z[lane]}; }
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
