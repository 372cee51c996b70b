// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/map/operations/admission.hpp"
#include "nvm/map/operations/insertion.hpp"
#include "nvm/map/operations/look_ahead.hpp"
#include "nvm/map/operations/map_judge.hpp"
#include "nvm/map/operations/point_block.hpp"
#include "nvm/map/storage/pool.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Inserts points over an executor, with the result of inserting them one after the other, bit for
/// bit.
///
/// Most points of a scan are rejected, and stay so until their voxel changes. So the threads bring
/// a slab of points to the map frame and judge them by the map as it is; then the points are stored
/// in order, but for those that were rejected by a voxel that has not changed since.
template <class Executor>
class ParallelInsertion {
 public:
  /// Fewer points take less than a millisecond, which is not worth splitting.
  static constexpr std::size_t kMinPoints = 65'536;

  ParallelInsertion(Insertion& insertion, const VoxelStorage& storage, const Executor& executor)
      : insertion_(insertion),
        storage_(storage),
        executor_(executor),
        blocks_(kSlab / PointBlock::kSize),
        judges_(kSlab / kTask, MapJudge(insertion.admission(), storage)) {}

  /// Inserts the first of `size` points, up to where a voxel might have to leave the map, and
  /// returns how many. fill(begin, end, block) reads points and brings them to the map frame, from
  /// several threads.
  template <class Fill>
  std::size_t insert(std::size_t size, const Fill& fill) {
    std::size_t begin = 0;
    while (begin < size && storage_.has_room_for(kSlab)) {
      const std::size_t end = std::min(begin + kSlab, size);
      judge(begin, end, fill);
      store(end - begin);
      begin = end;
    }
    return begin;
  }

 private:
  static constexpr std::size_t kTask = 32 * PointBlock::kSize;
  static constexpr std::size_t kSlab = 8 * kTask;

  template <class Fill>
  void judge(std::size_t begin, std::size_t end, const Fill& fill) {
    executor_.for_blocks(end - begin, kTask, [&](std::size_t first, std::size_t last) {
      MapJudge& judge = judges_[first / kTask];
      for (std::size_t i = first; i < last; i += PointBlock::kSize) {
        JudgedBlock& block = blocks_[i / PointBlock::kSize];
        const std::size_t count = std::min(PointBlock::kSize, last - i);
        fill(begin + i, begin + i + count, block.points);
        judge.judge(block, count);
      }
    });
  }

  void store(std::size_t size) {
    has_changed_.resize(storage_.voxel_high_water(), false);
    for (std::size_t i = 0; i < size; i += PointBlock::kSize) {
      store_block(blocks_[i / PointBlock::kSize], std::min(PointBlock::kSize, size - i));
    }
    for (const std::uint32_t voxel : changed_) {
      has_changed_[voxel] = false;
    }
    changed_.clear();
  }

  void store_block(const JudgedBlock& block, std::size_t count) {
    if (block.admissible_count >= LookAhead::kWorthwhile) {
      insertion_.look_ahead(block.points, count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Verdict verdict = block.verdicts[i];
      if (verdict.admissible != Admissible::kYes && !has_changed_[verdict.voxel]) {
        insertion_.reject(verdict.admissible);
        continue;
      }
      insertion_.insert_one(block.points, i);
      if (verdict.voxel != kNone) {
        has_changed_[verdict.voxel] = true;
        changed_.push_back(verdict.voxel);
      }
    }
  }

  Insertion& insertion_;
  const VoxelStorage& storage_;
  const Executor& executor_;
  std::vector<JudgedBlock> blocks_;     // of the slab
  std::vector<MapJudge> judges_;        // of its tasks
  std::vector<bool> has_changed_;       // by voxel, since the slab was judged
  std::vector<std::uint32_t> changed_;  // those voxels
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
