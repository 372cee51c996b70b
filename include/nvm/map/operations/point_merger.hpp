// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_POINT_MERGER_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_POINT_MERGER_HPP

#include <algorithm>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Moves stored points to the mean plane of the points that were too close to be stored beside them
/// (MapOptions::max_merged_points). In integers, so that maps do not differ between processors.
template <class = void>
class PointMerger {
 public:
  PointMerger(const MapOptions& options, std::int32_t min_sq_steps, VoxelStorage& storage)
      : max_merged_(options.max_merged_points),
        min_sq_steps_(min_sq_steps),
        min_dot_(dot_threshold(kMaxTurn)),
        storage_(storage) {}

  bool is_on() const noexcept { return max_merged_ > 1; }

  /// Merges a point with the nearest point of `chunk`, unless all of them stand for enough.
  [[gnu::always_inline]] void merge_into_nearest(
      std::uint32_t chunk, const WrappedPoint& point, const StoredNormal& normal) noexcept {
    if (!storage_.all_stand_for(chunk, max_merged_)) {  // in a place seen often they do
      merge_into_nearest_of(chunk, point, normal);
    }
  }

  /// Moves the stored point along `normal` towards the plane of `point`, by the share that one
  /// point has in the mean, unless it stands for enough points or the two lie on different things.
  void merge(
      std::uint32_t chunk,
      int lane,
      const WrappedPoint& point,
      const StoredNormal& normal) noexcept {
    const std::int32_t merged = storage_.merged_points(chunk, lane);
    if (merged >= max_merged_ || dot(storage_.normals(chunk).get(lane), normal) <= min_dot_) {
      return;
    }
    const WrappedPoint stored = storage_.chunk(chunk).wrapped(static_cast<std::size_t>(lane));
    const std::int32_t along = normal.x * wrapped_difference(point.x, stored.x) +
                               normal.y * wrapped_difference(point.y, stored.y) +
                               normal.z * wrapped_difference(point.z, stored.z);
    const std::int32_t sq_length = dot(normal, normal);
    if (kSqOffsets * along * along > std::int64_t{min_sq_steps_} * sq_length) {
      return;
    }
    const std::int32_t divisor = sq_length * (merged + 1);
    const auto moved = [&](std::int16_t from, std::int8_t direction) {
      return moved_in_voxel(from, rounded_quotient(along * direction, divisor));
    };
    storage_.replace(
        chunk,
        lane,
        {moved(stored.x, normal.x), moved(stored.y, normal.y), moved(stored.z, normal.z)});
  }

 private:
  // Points whose normals differ by more lie on both sides of an edge [rad]; 20 degrees.
  static constexpr double kMaxTurn = 0.3490658503988659;
  // As do points off the plane by more than a quarter of min_point_distance: the square of 4.
  static constexpr std::int64_t kSqOffsets = 16;

  [[gnu::noinline]] void merge_into_nearest_of(
      std::uint32_t chunk, const WrappedPoint& point, const StoredNormal& normal) noexcept {
    IntLanes distances;
    detail::sq_distances(storage_.chunk(chunk), LanePoint(point), distances);
    merge(chunk, nearest_lane(distances, 0xff), point, normal);
  }

  /// `divisor` is positive.
  static std::int32_t rounded_quotient(std::int32_t value, std::int32_t divisor) noexcept {
    return (value + (value < 0 ? -divisor : divisor) / 2) / divisor;
  }

  /// A coordinate moved by `steps`, but not out of its voxel.
  static std::int16_t moved_in_voxel(std::int16_t from, std::int32_t steps) noexcept {
    const std::int32_t step = step_in_voxel(from);
    const std::int32_t to = std::clamp(step + steps, 0, kStepsPerVoxel - 1);
    return static_cast<std::int16_t>(from + (to - step));
  }

  int max_merged_;
  std::int32_t min_sq_steps_;
  int min_dot_;
  VoxelStorage& storage_;
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_POINT_MERGER_HPP
