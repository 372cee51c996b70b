// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_NEAREST_QUERY_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_NEAREST_QUERY_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/operations/axis_window.hpp"
#include "nvm/map/operations/candidates.hpp"
#include "nvm/map/operations/normal_gate.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// The lanes of a chunk that a gate reads.
inline std::uint32_t facing(const NoGate&, const NormalChunk&) { return 0xff; }
inline std::uint32_t facing(const NormalGate& gate, const NormalChunk& normals) {
  const std::uint32_t sighted = detail::lanes_sighted(normals);
  std::uint32_t facing = detail::lanes_facing(normals, gate.normal, gate.min_point_dot) & ~sighted;
  if (gate.reads_sightings && sighted != 0) {  // the dot of half a vector is half as large
    facing |= detail::lanes_facing(normals, gate.normal, gate.min_point_dot >> 1) & sighted;
  }
  return facing;
}

/// Collects the points near a query from the up to 27 voxels around it.
template <class Gate>
class NearestQuery {
 public:
  /// `is_cold`: the query comes to another place than the one before.
  NearestQuery(
      const VoxelStorage& storage, const LatticePoint& point, const Gate& gate, bool is_cold)
      : storage_(storage),
        is_cold_(is_cold),
        bricks_(storage.bricks()),
        chunks_(storage.chunks()),
        normals_(storage.normals()),
        gate_(gate),
        voxel_(point.voxel),
        lanes_(wrap(point)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t below = point.step[static_cast<int>(axis)] + 1;
      const std::int32_t above = kStepsPerVoxel - point.step[static_cast<int>(axis)];
      sq_gap_[axis] = {below * below, above * above};
    }
  }

  /// Fills `found` with the points whose squared distance is below `limit`; of those only the
  /// wanted nearest need to be there. `brick` is the brick of the query's voxel, or kNone.
  [[gnu::always_inline]] void collect(
      std::uint32_t brick, std::int32_t limit, Candidates<>& found) const noexcept {
    found.clear();
    const AxisWindow& x = window(0, limit);
    const AxisWindow& y = window(1, limit);
    const AxisWindow& z = window(2, limit);
    const std::size_t wide = static_cast<std::size_t>(x.is_wide) |
                             static_cast<std::size_t>(y.is_wide) << 1 |
                             static_cast<std::size_t>(z.is_wide) << 2;
    for (std::uint32_t bricks = kWindowBricks[wide]; bricks != 0; bricks &= bricks - 1) {
      const auto beside = static_cast<std::uint32_t>(__builtin_ctz(bricks));
      const std::size_t i = beside & 1U;
      const std::size_t j = beside >> 1 & 1U;
      const std::size_t k = beside >> 2;
      const int slot =
          kBricksAround / 2 + x.around_step[0][i] + y.around_step[1][j] + z.around_step[2][k];
      const std::uint32_t id = brick_at(brick, slot);
      if (id != kNone) {
        const std::uint64_t cells = x.cells[0][i] & y.cells[1][j] & z.cells[2][k];
        collect_brick(bricks_[id], cells, limit, found);
      }
    }
  }

 private:
  const AxisWindow& window(std::size_t axis, std::int32_t limit) const noexcept {
    const auto place = static_cast<std::size_t>(voxel_[static_cast<int>(axis)] & (kBrickEdge - 1));
    const std::size_t wanted = static_cast<std::size_t>(sq_gap_[axis][0] < limit) |
                               static_cast<std::size_t>(sq_gap_[axis][1] < limit) << 1;
    return kAxisWindows[place][wanted];
  }

  /// The brick in `slot` around the one of the query's voxel, `center`.
  std::uint32_t brick_at(std::uint32_t center, int slot) const noexcept {
    if (center != kNone) {
      return bricks_[center].around[static_cast<std::size_t>(slot)];
    }
    return storage_.find_brick(index_key(index_around(brick_index(voxel_), slot)));
  }

  [[gnu::always_inline]] void collect_brick(
      const Brick& brick,
      std::uint64_t cells,
      std::int32_t& limit,
      Candidates<>& found) const noexcept {
    cells &= brick.occupied;
    // The heads come in together, not one after the other's points.
    for (std::uint64_t left = is_cold_ ? cells : 0; left != 0; left &= left - 1) {
      __builtin_prefetch(&chunks_[brick.head[static_cast<std::size_t>(__builtin_ctzll(left))]]);
    }
    for (; cells != 0; cells &= cells - 1) {
      collect_voxel(brick.head[static_cast<std::size_t>(__builtin_ctzll(cells))], limit, found);
    }
  }

  [[gnu::always_inline]] void collect_voxel(
      std::uint32_t head, std::int32_t& limit, Candidates<>& found) const noexcept {
    for (; head != kNone; head = chunks_[head].next_surface) {
      const PointChunk& surface = chunks_[head];
      if (gate_.reads_surface(surface)) {
        collect_surface(head, surface, limit, found);
      }
    }
  }

  [[gnu::always_inline]] void collect_surface(
      std::uint32_t head,
      const PointChunk& surface,
      std::int32_t& limit,
      Candidates<>& found) const noexcept {
    const bool tests_points = gate_.tests_points(surface);
    for (std::uint32_t id = head; id != kNone; id = chunks_[id].next) {
      IntLanes distances;
      sq_distances(chunks_[id], lanes_, distances);
      std::uint32_t mask = lanes_below(distances, limit);
      if (tests_points && mask != 0) {
        mask &= detail::facing(gate_, normals_[id]);
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
  bool is_cold_;
  // Copied from it: behind a reference they would be read again after each candidate is stored.
  const Brick* bricks_;
  const PointChunk* chunks_;
  const NormalChunk* normals_;
  Gate gate_;
  VoxelIndex voxel_;
  LanePoint lanes_;
  std::array<std::array<std::int32_t, 2>, 3> sq_gap_;  // per axis: to the voxel below and above
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_NEAREST_QUERY_HPP
