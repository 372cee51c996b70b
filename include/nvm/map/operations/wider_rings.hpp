// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/nearest_request.hpp"
#include "nvm/map/operations/normal_gate.hpp"
#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

inline bool reads_point(const NoGate& /*gate*/, const StoredNormal& /*normal*/) { return true; }
inline bool reads_point(const NormalGate& gate, const StoredNormal& normal) {
  return is_sighting(normal)  // the dot of half a vector is half as large
             ? gate.reads_sightings && dot(normal, gate.normal) > gate.min_point_dot >> 1
             : dot(normal, gate.normal) > gate.min_point_dot;
}

/// Keeps the nearest `room` of the neighbours that it is shown, ascending, in a caller's array.
class NearestList {
 public:
  NearestList(Neighbor* out, std::size_t room) : out_(out), room_(room) {}

  template <class = void>
  void show(const Neighbor& neighbor) noexcept {
    if (is_full() && !before(neighbor, out_[count_ - 1])) {
      return;
    }
    std::size_t place = is_full() ? count_ - 1 : count_++;
    for (; place > 0 && before(neighbor, out_[place - 1]); --place) {
      out_[place] = out_[place - 1];
    }
    out_[place] = neighbor;
  }

  std::size_t count() const noexcept { return count_; }
  bool is_full() const noexcept { return count_ == room_; }
  /// Squared distance of the last; only when is_full().
  double sq_worst() const noexcept { return static_cast<double>(out_[count_ - 1].sq_distance); }

 private:
  static bool before(const Neighbor& a, const Neighbor& b) noexcept {
    return a.sq_distance != b.sq_distance ? a.sq_distance < b.sq_distance : a.id < b.id;
  }

  Neighbor* out_;
  std::size_t room_;
  std::size_t count_ = 0;
};

/// Answers requests for NearestSearch::rings above 1: boxes of voxels that grow until they settle
/// the answer. Much slower than the 27 voxels.
template <class Gate>
class WiderRings {
 public:
  WiderRings(
      const VoxelStorage& storage,
      const Lattice& lattice,
      const Gate& gate,
      const NearestRequest& request)
      : storage_(storage),
        lattice_(lattice),
        gate_(gate),
        request_(request),
        wanted_(std::min(request.search.count, kMaxNeighbors)),
        edge_(lattice.meters_per_step() * kStepsPerVoxel) {
    located_ = wanted_ > 0 && is_distance(request.search.max_distance) &&
               lattice.locate(request.point, query_) == LatticeStatus::kInside;
    point_ = located_ ? lattice.position(query_.voxel, query_.step) : zeros<Eigen::Vector3d>();
  }

  /// `count`: neighbours of the 27 voxels, which are in request.out.
  std::size_t search(std::size_t count) const noexcept {
    constexpr int kLastSmall = 16;             // beyond, most of a map is as near as the next box
    constexpr int kMost = 2 * kMaxVoxelIndex;  // from one end of all maps to the other
    const int last = located_ ? std::min(request_.search.rings, kMost) : 1;
    for (int ring = 1; ring < last && !settles(ring, count);) {
      ring = ring < kLastSmall ? std::min(2 * ring, last) : last;
      count = collect(ring);
    }
    return count;
  }

 private:
  /// Whether nothing beyond `ring` could come before the `count` neighbours that were found.
  bool settles(int ring, std::size_t count) const noexcept {
    const Eigen::Vector3d to_side = per_axis([&](int axis) {
      const double inside = static_cast<double>(query_.step[axis]) / kStepsPerVoxel;
      return std::min(inside, 1.0 - inside);
    });
    const double covered =
        edge_ * (ring + std::min(std::min(to_side.x(), to_side.y()), to_side.z()));
    return covered > request_.search.max_distance ||
           (count == wanted_ &&
            static_cast<double>(request_.out[count - 1].sq_distance) < covered * covered);
  }

  std::size_t collect(int ring) const noexcept {
    const auto& [x, y, z] = query_.voxel.axes;
    const VoxelIndex low{x - ring, y - ring, z - ring};
    const VoxelIndex high{x + ring, y + ring, z + ring};
    const double max_distance = request_.search.max_distance;
    const double sq_limit = max_distance * max_distance;
    NearestList nearest(request_.out, wanted_);
    const auto visit = [&](std::uint32_t front, const VoxelIndex& index) {
      const double sq_gap = sq_distance_to_voxels(lattice_, point_, index, index);
      const bool is_inside = on_all_axes(
          [&](int axis) { return index[axis] >= low[axis] && index[axis] <= high[axis]; });
      if (is_inside && sq_gap <= sq_limit && !(nearest.is_full() && sq_gap > nearest.sq_worst())) {
        show_voxel(front, index, sq_limit, nearest);
      }
    };
    for_each_voxel_near(
        storage_,
        lattice_,
        per_axis([&](int axis) { return edge_ * (low[axis] + 0.5); }),  // away from rounding
        per_axis([&](int axis) { return edge_ * (high[axis] + 0.5); }),
        visit);
    for (std::size_t i = 0; i < nearest.count(); ++i) {
      storage_.recency().use(storage_.chunk(request_.out[i].id / kLanes).voxel);
    }
    return nearest.count();
  }

  void show_voxel(
      std::uint32_t front,
      const VoxelIndex& index,
      double sq_limit,
      NearestList& nearest) const noexcept {
    for (std::uint32_t head = front; head != kNone; head = storage_.chunk(head).next_surface) {
      const PointChunk& surface = storage_.chunk(head);
      if (!gate_.reads_surface(surface)) {
        continue;
      }
      const bool tests_points = gate_.tests_points(surface);
      for_each_id(storage_, head, [&](PointId id) {
        const Eigen::Vector3d position = lattice_.position(index, stored_step(storage_, id));
        const double sq_distance = sq_norm(difference(position, point_));
        if (sq_distance <= sq_limit &&
            (!tests_points || reads_point(gate_, stored_normal(storage_, id)))) {
          nearest.show({position, static_cast<float>(sq_distance), id});
        }
      });
    }
  }

  const VoxelStorage& storage_;
  const Lattice& lattice_;
  Gate gate_;
  const NearestRequest& request_;
  std::size_t wanted_;
  double edge_;  ///< of a voxel [m]
  bool located_;
  LatticePoint query_{};
  Eigen::Vector3d point_;  ///< that of the query, as stored points are
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
