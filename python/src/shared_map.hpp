// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>
#include <vector>

#include "nvm/map/voxel_map.hpp"

namespace nvm::python {

/// A VoxelMap that Python's threads may use as they like: readers run at once, a writer alone, all
/// without the GIL. Points are told by their row: their place in for_each().
class SharedMap {
 public:
  explicit SharedMap(VoxelMap map) : map_(std::move(map)) {}

  template <class Read>
  auto read(const Read& read) const {
    const nanobind::gil_scoped_release no_gil;
    const std::shared_lock lock(mutex_);
    return read(map_);
  }

  template <class Write>
  auto write(const Write& write) {
    const nanobind::gil_scoped_release no_gil;
    const std::unique_lock lock(mutex_);
    rows_.reset();
    return write(map_);
  }

  /// Calls visit(const Neighbor&) for every point of `map`, in the order of the rows.
  template <class Visitor>
  static void for_each(const VoxelMap& map, const Visitor& visit) {
    constexpr double kBeyondAnyMap = 1e9;  // [m]: 2^20 voxels of 100 m lie within
    map.for_each_within(Eigen::Vector3d::Zero(), kBeyondAnyMap, visit);
  }

  /// The row of each PointId of `map`, which read() gave. Made once after each change.
  std::shared_ptr<const std::vector<std::uint32_t>> rows(const VoxelMap& map) const {
    const std::lock_guard lock(rows_mutex_);
    if (rows_ == nullptr) {
      auto rows = std::make_shared<std::vector<std::uint32_t>>();
      std::uint32_t row = 0;
      for_each(map, [&](const Neighbor& point) {
        if (point.id >= rows->size()) {
          rows->resize(2 * std::size_t{point.id} + 1);
        }
        (*rows)[point.id] = row++;
      });
      rows_ = std::move(rows);
    }
    return rows_;
  }

 private:
  VoxelMap map_;
  mutable std::shared_mutex mutex_;
  mutable std::mutex rows_mutex_;
  mutable std::shared_ptr<const std::vector<std::uint32_t>> rows_;
};

}  // namespace nvm::python
