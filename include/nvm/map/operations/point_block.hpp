// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/value_row.hpp"
#include "nvm/map/storage/voxel_cache.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Up to 64 points on their way into a map, one array per quantity: transforming, flooring and
/// rounding them in plain loops over arrays lets the compiler do four or eight at a time: the loops
/// become part of the kernel that they are called from (nvm/core/target.hpp).
class PointBlock {
 public:
  static constexpr std::size_t kSize = 64;

  enum class Status : std::uint8_t { kOk, kSighting, kNonFinite, kOutOfRange, kNoNormal };

  void set_position(std::size_t i, const Eigen::Vector3d& p_scan) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      position_[axis][i] = p_scan[static_cast<Eigen::Index>(axis)];
    }
  }
  void set_normal(std::size_t i, const Eigen::Vector3d& n_scan) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal_[axis][i] = static_cast<float>(n_scan[static_cast<Eigen::Index>(axis)]);
    }
  }

  /// What the map keeps of point `i` beside. Not set, and not read, where it keeps nothing.
  ValueRow& row(std::size_t i) noexcept { return rows_[i]; }
  const ValueRow& row(std::size_t i) const noexcept { return rows_[i]; }

  /// Brings the positions to the map frame (Eq. 3) and to the lattice (Eq. 4).
  [[gnu::always_inline]] void locate(const Pose& T_map_scan, const Lattice& lattice) noexcept {
    const double scale = lattice.voxels_per_meter();
    Axes<double> scaled;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      const double x = T_map_scan(row, 0) * scale;
      const double y = T_map_scan(row, 1) * scale;
      const double z = T_map_scan(row, 2) * scale;
      const double offset = T_map_scan(row, 3) * scale;
      for (std::size_t i = 0; i < kSize; ++i) {
        scaled[axis][i] = x * position_[0][i] + y * position_[1][i] + z * position_[2][i] + offset;
      }
    }
    judge_range(scaled);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      split(scaled[axis], voxel_[axis], wrapped_[axis]);
    }
    make_keys();
  }

  /// Brings the normals to the map frame and to their stored form; to be called after locate().
  [[gnu::always_inline]] void turn_normals(const Pose& T_map_scan) noexcept {
    Axes<float> turned;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      const auto x = static_cast<float>(T_map_scan(row, 0));
      const auto y = static_cast<float>(T_map_scan(row, 1));
      const auto z = static_cast<float>(T_map_scan(row, 2));
      for (std::size_t i = 0; i < kSize; ++i) {
        turned[axis][i] = x * normal_[0][i] + y * normal_[1][i] + z * normal_[2][i];
      }
    }
    judge_normals(turned);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < kSize; ++i) {
        stored_[axis][i] = store_component(turned[axis][i]);
      }
    }
  }

  /// Leaves the points without normals.
  void drop_normals() noexcept { stored_ = {}; }

  Status status(std::size_t i) const noexcept { return status_[i]; }
  IndexKey key(std::size_t i) const noexcept { return key_[i]; }
  std::uint32_t cache_slot(std::size_t i) const noexcept { return cache_slot_[i]; }
  VoxelIndex voxel(std::size_t i) const noexcept {
    return {voxel_[0][i], voxel_[1][i], voxel_[2][i]};
  }
  WrappedPoint wrapped(std::size_t i) const noexcept {
    return {wrapped_[0][i], wrapped_[1][i], wrapped_[2][i]};
  }
  StoredNormal normal(std::size_t i) const noexcept {
    return {stored_[0][i], stored_[1][i], stored_[2][i]};
  }

 private:
  template <class T>
  using Lane = std::array<T, kSize>;
  template <class T>
  using Axes = std::array<Lane<T>, 3>;

  /// Sets the status and replaces what the lattice cannot hold by zero.
  [[gnu::always_inline]] void judge_range(Axes<double>& scaled) noexcept {
    status_.fill(Status::kOk);
    int inside = 1;
    for (std::size_t i = 0; i < kSize; ++i) {  // the usual case, without a branch per point
      inside &= static_cast<int>(Lattice::is_inside(scaled[0][i])) &
                static_cast<int>(Lattice::is_inside(scaled[1][i])) &
                static_cast<int>(Lattice::is_inside(scaled[2][i]));
    }
    for (std::size_t i = 0; i < kSize && inside == 0; ++i) {
      const Eigen::Vector3d point(scaled[0][i], scaled[1][i], scaled[2][i]);
      const LatticeStatus status = Lattice::judge(point);
      if (status != LatticeStatus::kInside) {
        status_[i] = status == LatticeStatus::kNonFinite ? Status::kNonFinite : Status::kOutOfRange;
        scaled[0][i] = scaled[1][i] = scaled[2][i] = 0.0;
      }
    }
  }

  [[gnu::always_inline]] static void split(
      const Lane<double>& scaled, Lane<std::int32_t>& voxel, Lane<std::int16_t>& wrapped) noexcept {
    for (std::size_t i = 0; i < kSize; ++i) {
      const std::int32_t floor = floor_to_int(scaled[i]);
      // A hair below a border the difference is rounded to a whole voxel.
      const auto step = std::min(
          static_cast<std::int32_t>((scaled[i] - floor) * kStepsPerVoxel), kStepsPerVoxel - 1);
      voxel[i] = floor;
      wrapped[i] = wrap(floor, step);
    }
  }

  [[gnu::always_inline]] void make_keys() noexcept {
    for (std::size_t i = 0; i < kSize; ++i) {
      key_[i] = index_key(voxel_[0][i], voxel_[1][i], voxel_[2][i]);
    }
    for (std::size_t i = 0; i < kSize; ++i) {
      cache_slot_[i] = VoxelCache::slot(voxel_[0][i], voxel_[1][i], voxel_[2][i]);
    }
  }

  [[gnu::always_inline]] void judge_normals(Axes<float>& turned) noexcept {
    Lane<float> sq_length;
    int unit = 1;
    for (std::size_t i = 0; i < kSize; ++i) {
      sq_length[i] =
          turned[0][i] * turned[0][i] + turned[1][i] * turned[1][i] + turned[2][i] * turned[2][i];
      unit &= static_cast<int>(is_unit_length(sq_length[i]));
    }
    for (std::size_t i = 0; i < kSize && unit == 0; ++i) {
      if (!is_unit_length(sq_length[i])) {
        judge_short(i, sq_length[i], turned);
      }
    }
  }

  void judge_short(std::size_t i, float sq_length, Axes<float>& turned) noexcept {
    const bool is_sighting = is_sighting_length(sq_length);
    if (status_[i] == Status::kOk) {
      status_[i] = is_sighting ? Status::kSighting : Status::kNoNormal;
    }
    if (!is_sighting) {
      turned[0][i] = turned[1][i] = turned[2][i] = 0.0F;
    }
  }

  Axes<double> position_{};
  Axes<float> normal_{};
  Axes<std::int32_t> voxel_;
  Axes<std::int16_t> wrapped_;
  Axes<std::int8_t> stored_;
  Lane<IndexKey> key_;
  Lane<std::uint32_t> cache_slot_;
  std::array<ValueRow, kSize> rows_;
  Lane<Status> status_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
