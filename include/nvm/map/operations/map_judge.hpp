// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/operations/admission.hpp"
#include "nvm/map/operations/look_ahead.hpp"
#include "nvm/map/operations/point_block.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/pool.hpp"
#include "nvm/map/storage/voxel_cache.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// What the map, as it is, makes of a point.
struct Verdict {
  std::uint32_t voxel = kNone;  // none: there is no voxel yet
  Admissible admissible = Admissible::kYes;
};

/// A block of points with their verdicts.
struct JudgedBlock {
  PointBlock points;
  std::array<Verdict, PointBlock::kSize> verdicts;
  std::size_t admissible_count;
};

/// Judges points while nobody changes the map; one for each thread. Marks the voxels that they fall
/// into as used, as insertion does.
class MapJudge {
 public:
  MapJudge(const Admission& admission, const VoxelStorage& storage)
      : admission_(admission), storage_(storage) {}

  /// Judges the first `count` points.
  void judge(JudgedBlock& block, std::size_t count) noexcept {
    look_ahead_.start(block.points, count, cache_, storage_);
    block.admissible_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_ok = block.points.status(i) == PointBlock::Status::kOk;
      const Verdict verdict = is_ok ? judge_point(block.points, i) : Verdict{};
      block.verdicts[i] = verdict;
      block.admissible_count += static_cast<std::size_t>(verdict.admissible == Admissible::kYes);
    }
  }

 private:
  Verdict judge_point(const PointBlock& points, std::size_t i) noexcept {
    const IndexKey key = points.key(i);
    VoxelCache::Entry& cached = cache_[points.cache_slot(i)];
    if (cached.key != key) {
      const VoxelIndex index = points.voxel(i);
      const std::uint32_t brick =
          storage_.find_brick(index_key(brick_index(index)), look_ahead_.brick_hint(i));
      const std::uint32_t front = storage_.head_in(brick, cell_in_brick(index));
      if (front == kNone) {
        return {};
      }
      storage_.recency().use(storage_.chunk(front).voxel);
      cached = {key, front, 0};
    }
    const LanePoint point(points.wrapped(i));
    return {
        storage_.chunk(cached.head).voxel, admission_.judge(cached.head, point, points.normal(i))};
  }

  const Admission& admission_;
  const VoxelStorage& storage_;
  VoxelCache cache_;
  LookAhead look_ahead_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
