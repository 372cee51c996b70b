// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "nvm/core/point_access.hpp"
#include "nvm/core/processor.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/erasure.hpp"
#include "nvm/map/operations/map_kernels.hpp"
#include "nvm/map/operations/nearest_request.hpp"
#include "nvm/map/operations/normal_gate.hpp"
#include "nvm/map/operations/point_block.hpp"
#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/operations/wider_rings.hpp"
#include "nvm/map/point_values.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/map_capacity.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/value_row.hpp"
#include "nvm/map/storage/voxel_cache.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// For points without values: those are zero.
struct NoValues {
  PointValues operator[](std::size_t /*i*/) const { return {}; }
};

/// What is inside a VoxelMap, which says what its members do: code for the instruction set of this
/// translation unit (nvm/core/target.hpp) on data that is the same for all of them.
class MapEngine {
 public:
  explicit MapEngine(const MapOptions& options)
      : options_((options.validate(), options)),
        lattice_(options.voxel_size),
        capacity_(map_capacity(options)),
        storage_(capacity_),
        gate_(normal_gate(options)) {}

  MapEngine(MapEngine&& other) noexcept
      : options_(other.options_),
        lattice_(other.lattice_),
        capacity_(other.capacity_),
        storage_(std::exchange(other.storage_, {})),
        gate_(other.gate_) {
    other.cache_.clear();
  }
  MapEngine& operator=(MapEngine&& other) noexcept {
    options_ = other.options_;
    lattice_ = other.lattice_;
    capacity_ = other.capacity_;
    storage_ = std::exchange(other.storage_, {});
    gate_ = other.gate_;
    cache_.clear();
    other.cache_.clear();
    return *this;
  }
  ~MapEngine() = default;

  const MapOptions& options() const noexcept { return options_; }
  const Lattice& lattice() const noexcept { return lattice_; }
  const VoxelStorage& storage() const noexcept { return storage_; }
  VoxelStorage& storage() noexcept { return storage_; }
  std::size_t memory_limit_bytes() const noexcept { return capacity_.bytes(); }

  template <class Points, class Normals, class Values>
  InsertStats insert(
      const Points& points, const Normals& normals, const Pose& T_map_scan, const Values& values) {
    require(points.size() == normals.size(), "normals.size()", normals.size(), "points.size()");
    const auto fill = [&](std::size_t begin, std::size_t end, PointBlock& block) {
      for (std::size_t i = begin; i < end; ++i) {
        block.set_position(i - begin, nvm::position(points[i]));
        block.set_normal(i - begin, nvm::position(normals[i]));
      }
      fill_rows(begin, end, values, block);
    };
    return insert_blocks(static_cast<std::size_t>(points.size()), true, T_map_scan, fill);
  }

  template <class Points, class Values>
  InsertStats insert_unsided(const Points& points, const Pose& T_map_scan, const Values& values) {
    const auto fill = [&](std::size_t begin, std::size_t end, PointBlock& block) {
      for (std::size_t i = begin; i < end; ++i) {
        block.set_position(i - begin, nvm::position(points[i]));
      }
      fill_rows(begin, end, values, block);
    };
    return insert_blocks(static_cast<std::size_t>(points.size()), false, T_map_scan, fill);
  }

  template <class = void>
  std::size_t nearest(const Eigen::Vector3f& normal, const NearestRequest& request) const noexcept {
    if (!is_unit(normal) && !nvm::is_sighting(normal)) {
      return 0;
    }
    const NormalGate gate = gate_for(gate_, store_normal(normal));
    return request.search.gate == Gate::kPoints ? nearest_through(PointGate{gate}, request)
                                                : nearest_through(gate, request);
  }
  template <class = void>
  std::size_t nearest(const NearestRequest& request) const noexcept {
    return nearest_through(NoGate{}, request);
  }

  template <class Visitor>
  void for_each_within(const Eigen::Vector3d& center, double radius, const Visitor& visit) const {
    detail::for_each_within(storage_, lattice_, center, radius, visit);
  }
  template <class Visitor>
  void for_each_point(const Visitor& visit) const {
    detail::for_each_point(storage_, lattice_, options_.columns, visit);
  }

  template <class Region>
  std::size_t erase_region(const Region& region) {
    const std::size_t before = storage_.point_count();
    detail::erase_region(storage_, lattice_, region);
    cache_.clear();
    return before - storage_.point_count();
  }
  template <class = void>
  std::size_t erase_voxels_beyond(const Eigen::Vector3d& center, double radius) {
    const std::size_t before = storage_.point_count();
    detail::erase_voxels_beyond(storage_, lattice_, center, radius);
    cache_.clear();
    return before - storage_.point_count();
  }
  template <class = void>
  void keep_within(const Eigen::Vector3d& center, double radius, InsertStats& stats) {
    const std::size_t voxels = storage_.voxel_count();
    stats.evicted_points += erase_voxels_beyond(center, radius);
    stats.evicted_voxels += voxels - storage_.voxel_count();
  }
  void clear() noexcept {
    storage_.clear();
    cache_.clear();
  }

 private:
  template <class Gate>
  std::size_t nearest_through(const Gate& gate, const NearestRequest& request) const noexcept {
    const std::size_t count = nearest_around(gate, request);
    return request.search.rings > 1
               ? WiderRings<Gate>(storage_, lattice_, gate, request).search(count)
               : count;
  }

  template <class Gate>
  std::size_t nearest_around(const Gate& gate, const NearestRequest& request) const noexcept {
#ifdef NVM_CHOOSES_KERNELS
    if (has_avx2()) {
      return for_avx2_kernels::detail::gated_nearest(storage_, lattice_, gate, request);
    }
#endif
    return gated_nearest(storage_, lattice_, gate, request);
  }

  template <class Values>
  void fill_rows(
      std::size_t begin, std::size_t end, const Values& values, PointBlock& block) const {
    for (std::size_t i = begin; i < end && capacity_.row_bytes > 0; ++i) {
      pack(options_.columns, values[i], block.row(i - begin));
    }
  }

  template <class Fill>
  InsertStats insert_blocks(
      std::size_t size, bool has_normals, const Pose& T_map_scan, const Fill& fill) {
    if (!is_rigid(T_map_scan)) {
      throw std::invalid_argument(
          "nvm: T_map_scan must be rigid: finite, with an orthonormal rotation");
    }
    if (!storage_.has_memory()) {
      storage_ = VoxelStorage(capacity_);
    }
#ifdef NVM_CHOOSES_KERNELS
    if (has_avx2()) {
      return insert_blocks_by<for_avx2_kernels::detail::Insertion>(
          size, has_normals, T_map_scan, fill);
    }
#endif
    return insert_blocks_by<Insertion>(size, has_normals, T_map_scan, fill);
  }

  template <class Inserter, class Fill>
  InsertStats insert_blocks_by(
      std::size_t size, bool has_normals, const Pose& T_map_scan, const Fill& fill) {
    Inserter insertion(options_, lattice_, gate_, storage_, cache_);
    PointBlock block;
    for (std::size_t begin = 0; begin < size; begin += PointBlock::kSize) {
      const std::size_t end = std::min(begin + PointBlock::kSize, size);
      fill(begin, end, block);
      insertion.locate(block, has_normals, T_map_scan);
      insertion.insert(block, end - begin);
    }
    storage_.recency().begin_epoch();  // the queries that follow are more recent
    return insertion.stats();
  }

  MapOptions options_;
  Lattice lattice_;
  MapCapacity capacity_;
  VoxelStorage storage_;
  VoxelCache cache_;
  NormalGate gate_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
