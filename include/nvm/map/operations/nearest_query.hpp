// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/map/operations/candidates.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {

/// Reads every surface and every point.
struct NoGate {
  bool reads_surface(const PointChunk&) const { return true; }
  bool tests_points(const PointChunk&) const { return false; }
  std::uint32_t facing(const NormalChunk&) const { return 0xff; }
};

/// Reads the surfaces and the points whose normals agree with the query's (spec §3.6).
struct NormalGate {
  StoredNormal normal;
  int min_surface_dot;
  int min_point_dot;
  int all_points_dot;  // a tight surface at a larger dot than this has no point to reject

  bool reads_surface(const PointChunk& head) const {
    return dot(head.direction, normal) > min_surface_dot;
  }
  bool tests_points(const PointChunk& head) const {
    return head.tight == 0 || dot(head.direction, normal) <= all_points_dot;
  }
  std::uint32_t facing(const NormalChunk& normals) const {
    return lanes_facing(normals, normal, min_point_dot);
  }
};

/// Reads every surface, and the points whose own normals agree with the query's: a facing filter
/// without sides.
struct PointGate : NormalGate {
  explicit PointGate(const NormalGate& gate) : NormalGate(gate) {}
  bool reads_surface(const PointChunk&) const { return true; }
};

/// The cells of one axis of a brick that lie next to a voxel, and those in the brick beside it.
struct AxisWindow {
  int bricks = 0;                     // 1 or 2
  std::array<int, 2> brick_offset{};  // -1, 0 or 1
  std::array<std::array<std::uint64_t, 2>, 3>
      cells{};  // per axis and brick: mask of cells inside the window
};

/// The window from place `first` to `last` of the brick that holds the voxel: -1 and 4 lie in the
/// brick beside it.
constexpr AxisWindow axis_window(int first, int last) {
  AxisWindow window;
  window.bricks = 1;
  if (first < 0 || last >= kBrickEdge) {
    window.bricks = 2;
    window.brick_offset[1] = first < 0 ? -1 : 1;
  }
  for (int cell = 0; cell < kBrickCells; ++cell) {
    const std::array<int, 3> coordinate{cell % 4, cell / 4 % 4, cell / 16};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t brick = 0; brick < static_cast<std::size_t>(window.bricks); ++brick) {
        const int place_seen = coordinate[axis] + kBrickEdge * window.brick_offset[brick];
        if (first <= place_seen && place_seen <= last) {
          window.cells[axis][brick] |= std::uint64_t{1} << cell;
        }
      }
    }
  }
  return window;
}

/// Windows by the voxel's place in its brick (0 to 3) and by which neighbours are wanted (bit 0:
/// the lower, bit 1: the upper).
inline constexpr auto kAxisWindows = [] {
  std::array<std::array<AxisWindow, 4>, kBrickEdge> windows{};
  for (int place = 0; place < kBrickEdge; ++place) {
    for (int wanted = 0; wanted < 4; ++wanted) {
      windows[static_cast<std::size_t>(place)][static_cast<std::size_t>(wanted)] =
          axis_window(place - (wanted & 1), place + (wanted >> 1));
    }
  }
  return windows;
}();

/// Collects the points near a query from the up to 27 voxels around it.
template <class Gate>
class NearestQuery {
 public:
  NearestQuery(const VoxelStorage& storage, const LatticePoint& point, const Gate& gate)
      : storage_(storage), gate_(gate), voxel_(point.voxel), lanes_(wrap(point)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t below = point.step[static_cast<int>(axis)] + 1;
      const std::int32_t above = kStepsPerVoxel - point.step[static_cast<int>(axis)];
      sq_gap_[axis] = {below * below, 0, above * above};
    }
  }

  /// Fills `found` with the points whose squared distance is below `limit`; of those only the
  /// wanted nearest need to be there. `brick` is the brick of the query's voxel, or kNone.
  [[gnu::always_inline]] void collect(
      std::uint32_t brick, std::int32_t limit, Candidates& found) const noexcept {
    found.clear();
    const AxisWindow& x = window(0, limit);
    const AxisWindow& y = window(1, limit);
    const AxisWindow& z = window(2, limit);
    for (std::size_t k = 0; k < static_cast<std::size_t>(z.bricks); ++k) {
      for (std::size_t j = 0; j < static_cast<std::size_t>(y.bricks); ++j) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(x.bricks); ++i) {
          const VoxelIndex offset(x.brick_offset[i], y.brick_offset[j], z.brick_offset[k]);
          const std::uint32_t id = brick_at(brick, offset);
          if (id != kNone) {
            const std::uint64_t cells = x.cells[0][i] & y.cells[1][j] & z.cells[2][k];
            collect_brick(storage_.brick(id), offset, cells, limit, found);
          }
        }
      }
    }
  }

 private:
  const AxisWindow& window(std::size_t axis, std::int32_t limit) const noexcept {
    const auto place = static_cast<std::size_t>(voxel_[static_cast<int>(axis)] & (kBrickEdge - 1));
    const std::size_t wanted = static_cast<std::size_t>(sq_gap_[axis][0] < limit) |
                               static_cast<std::size_t>(sq_gap_[axis][2] < limit) << 1;
    return kAxisWindows[place][wanted];
  }

  std::uint32_t brick_at(std::uint32_t center, const VoxelIndex& offset) const noexcept {
    if (center != kNone) {
      return storage_.brick(center)
          .around[static_cast<std::size_t>(around_slot(offset.x(), offset.y(), offset.z()))];
    }
    return offset.isZero() ? kNone : storage_.find_brick(index_key(brick_index(voxel_) + offset));
  }

  [[gnu::always_inline]] void collect_brick(
      const Brick& brick,
      const VoxelIndex& offset,
      std::uint64_t cells,
      std::int32_t& limit,
      Candidates& found) const noexcept {
    constexpr int kMask = kBrickEdge - 1;
    // Of a cell's coordinate in this brick to the index of its gap: 0, 1, 2 for the voxel below,
    // at, above the query's.
    const int x0 = offset.x() * kBrickEdge - (voxel_.x() & kMask) + 1;
    const int y0 = offset.y() * kBrickEdge - (voxel_.y() & kMask) + 1;
    const int z0 = offset.z() * kBrickEdge - (voxel_.z() & kMask) + 1;
    for (cells &= brick.occupied; cells != 0; cells &= cells - 1) {
      const int cell = __builtin_ctzll(cells);
      const std::int32_t sq_gap = sq_gap_[0][static_cast<std::size_t>(x0 + (cell & kMask))] +
                                  sq_gap_[1][static_cast<std::size_t>(y0 + (cell >> 2 & kMask))] +
                                  sq_gap_[2][static_cast<std::size_t>(z0 + (cell >> 4))];
      if (sq_gap < limit) {
        collect_voxel(brick.head[static_cast<std::size_t>(cell)], limit, found);
      }
    }
  }

  [[gnu::always_inline]] void collect_voxel(
      std::uint32_t head, std::int32_t& limit, Candidates& found) const noexcept {
    for (; head != kNone; head = storage_.chunk(head).next_surface) {
      const PointChunk& surface = storage_.chunk(head);
      if (gate_.reads_surface(surface)) {
        collect_surface(head, surface, limit, found);
      }
    }
  }

  [[gnu::always_inline]] void collect_surface(
      std::uint32_t head,
      const PointChunk& surface,
      std::int32_t& limit,
      Candidates& found) const noexcept {
    const bool tests_points = gate_.tests_points(surface);
    int left = surface.size;
    for (std::uint32_t id = head; left > 0; id = storage_.chunk(id).next, left -= kLanes) {
      IntLanes distances;
      sq_distances(storage_.chunk(id), lanes_, distances);
      std::uint32_t mask = lanes_below(distances, limit) & first_lanes(left);
      if (tests_points && mask != 0) {
        mask &= gate_.facing(storage_.normals(id));
      }
      if (mask == 0) {
        continue;
      }
      if (found.full()) {
        limit = std::min(limit, found.keep_nearest());
      }
      found.append(mask, distances, id * kLanes);
    }
  }

  const VoxelStorage& storage_;
  const Gate& gate_;
  VoxelIndex voxel_;
  LanePoint lanes_;
  std::array<std::array<std::int32_t, 3>, 3> sq_gap_;  // per axis: to the voxel below, here, above
};

}  // namespace nvm::detail
