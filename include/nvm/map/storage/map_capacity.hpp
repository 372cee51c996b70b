// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/brick_table.hpp"
#include "nvm/map/storage/point_chunk.hpp"
#include "nvm/map/storage/principal_direction.hpp"
#include "nvm/map/storage/recency.hpp"
#include "nvm/map/storage/value_row.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

inline constexpr std::size_t kMaxChunks = std::size_t{1}
                                          << 29;  // a PointId is a chunk and a lane in 32 bits

/// How many voxels, bricks and chunks a map has room for, whatever is inserted (spec §3.5).
struct MapCapacity {
  std::size_t voxels;
  std::size_t bricks;
  std::size_t chunks;
  bool counts_merged;     // points that each stored point stands for: a byte per lane
  std::size_t row_bytes;  // of the values of each stored point

  std::size_t bytes() const {
    return voxels * sizeof(std::uint32_t) + Recency::bytes(voxels) + bricks * sizeof(Brick) +
           BrickTable::max_bytes(bricks) + chunks * bytes_per_chunk();
  }

  std::size_t bytes_per_chunk() const {
    return sizeof(PointChunk) + sizeof(NormalChunk) +
           kLanes * ((counts_merged ? 1 : 0) + row_bytes);
  }
};

/// Without a limit in bytes there is room for the worst case: each voxel in a brick of its own, all
/// surfaces full. With one, the number of voxels is cut to what fits when a brick holds 4 of them
/// and a voxel 2 chunks, as scans of walls and clutter do, and whichever runs out first makes the
/// map evict.
inline MapCapacity map_capacity(const MapOptions& options) {
  const auto surfaces = static_cast<std::size_t>(options.max_surfaces);
  const std::size_t chunks_per_surface =
      (static_cast<std::size_t>(options.points_per_surface) + kLanes - 1) / kLanes;
  const bool counts_merged = options.max_merged_points > 1;
  const std::size_t values = row_bytes(options.columns);
  const auto worst_case = [&](std::size_t voxels) {
    const std::size_t chunks = std::min(kMaxChunks, voxels * surfaces * chunks_per_surface);
    return MapCapacity{voxels, voxels, chunks, counts_merged, values};
  };
  const MapCapacity unlimited = worst_case(options.capacity);
  if (options.max_bytes == 0 || unlimited.bytes() <= options.max_bytes) {
    return unlimited;
  }
  const auto typical = [&](std::size_t voxels) {
    const std::size_t bricks = std::max<std::size_t>(1, voxels / 4);
    return MapCapacity{voxels, bricks, std::max<std::size_t>(1, 2 * voxels), counts_merged, values};
  };
  std::size_t voxels = 1;
  for (std::size_t step = MapOptions::kMaxCapacity; step > 0; step /= 2) {  // the largest that fits
    if (voxels + step <= options.capacity && typical(voxels + step).bytes() <= options.max_bytes) {
      voxels += step;
    }
  }
  MapCapacity capacity = typical(voxels);
  capacity.chunks += (options.max_bytes - capacity.bytes()) / capacity.bytes_per_chunk();
  capacity.chunks = std::min(capacity.chunks, unlimited.chunks);
  return capacity;
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
