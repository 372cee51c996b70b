// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_ADMISSION_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_ADMISSION_HPP

#include <cstdint>
#include <limits>

#include "nvm/core/target.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/point_chunk.hpp"
#include "nvm/map/storage/pool.hpp"
#include "nvm/map/storage/stored_normal.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// The surface of a voxel that takes a normal.
struct SurfaceChoice {
  std::uint32_t surface;  // its head
  bool makes_new;         // behind `surface`, which is the last one
};

/// Whether a surface takes a point, and if not, why.
enum class Admissible : std::uint8_t { kYes, kTooClose, kSurfaceFull };

/// The place of a sighting.
struct SightedPlace {
  std::uint32_t chunk;  // kNone: there is no sighting
  int lane;
};

struct Room {
  Admissible admissible;
  std::uint32_t chunk;  // kYes: the last one of the surface; kTooClose: that of a point too close
};

/// What a voxel, as it is, makes of a point: the rules of spec §3.3 and §3.4. Changes nothing.
template <class = void>
class Admission {
 public:
  Admission(
      const MapOptions& options,
      std::int32_t min_surface_dot,
      std::int32_t min_sq_steps,
      const PointChunk* chunks,
      const NormalChunk* normals)
      : chunks_(chunks),
        normals_(normals),
        min_surface_dot_(min_surface_dot),
        min_sq_steps_(min_sq_steps),
        max_surfaces_(options.max_surfaces),
        points_per_surface_(options.points_per_surface),
        rule_(options.surface_rule) {}

  /// True when the front surface at `front` takes the point, whatever its normal: there is nothing
  /// to compare.
  [[gnu::always_inline]] bool takes_any(
      std::uint32_t front, const StoredNormal& normal) const noexcept {
    return normal == StoredNormal{} || chunks_[front].size == 0;
  }
  /// The view-consistency judgment (paper III-B-1, spec §3.4) otherwise.
  [[gnu::always_inline]] SurfaceChoice choose(
      std::uint32_t front, const StoredNormal& normal) const noexcept {
    return rule_ == SurfaceRule::kPaper ? first_consistent(front, normal)
                                        : smallest_angle(front, normal);
  }

  /// Whether the surface at `head` has room for the point (spec §3.3).
  [[gnu::always_inline]] Room find_room(std::uint32_t head, const LanePoint& point) const noexcept {
    if (chunks_[head].size >= points_per_surface_) {
      return {Admissible::kSurfaceFull, kNone};
    }
    std::uint32_t last = head;
    for (std::uint32_t id = head; id != kNone; id = chunks_[id].next) {
      IntLanes distances;
      detail::sq_distances(chunks_[id], point, distances);
      if (lanes_below(distances, min_sq_steps_) != 0) {
        return {Admissible::kTooClose, id};
      }
      last = id;
    }
    return {Admissible::kYes, last};
  }

  /// The sighting in whose place a point with the normal `normal` goes that the surface at `head`
  /// has no room for: the nearest one, of the chunk `room` when it is too close to it, but not when
  /// it is nearer to a point with a normal there.
  [[gnu::always_inline]] SightedPlace find_sighting(
      std::uint32_t head,
      const Room& room,
      const LanePoint& point,
      const StoredNormal& normal) const noexcept {
    if (chunks_[head].tight != 0 || is_sighting(normal)) {
      return {kNone, 0};
    }
    return room.admissible == Admissible::kTooClose ? nearest_in(room.chunk, point)
                                                    : nearest_sighting(head, point);
  }

 private:
  /// The point of `chunk` nearest to `point`, if it is a sighting.
  [[gnu::noinline]] SightedPlace nearest_in(
      std::uint32_t chunk, const LanePoint& point) const noexcept {
    const std::uint32_t sighted = detail::lanes_sighted(normals_[chunk]);
    if (sighted == 0) {
      return {kNone, 0};
    }
    IntLanes distances;
    detail::sq_distances(chunks_[chunk], point, distances);
    const int lane = nearest_lane(distances, 0xff);
    return {(sighted >> lane & 1U) != 0 ? chunk : kNone, lane};
  }

  /// The sighting of a surface nearest to `point`.
  [[gnu::noinline]] SightedPlace nearest_sighting(
      std::uint32_t head, const LanePoint& point) const noexcept {
    SightedPlace best{kNone, 0};
    auto best_sq_distance = std::numeric_limits<std::uint32_t>::max();
    int left = chunks_[head].size;
    for (std::uint32_t id = head; left > 0; id = chunks_[id].next, left -= kLanes) {
      // Lanes without a point hold anything.
      const std::uint32_t taken = left < kLanes ? (1U << left) - 1U : 0xffU;
      const std::uint32_t sighted = detail::lanes_sighted(normals_[id]) & taken;
      if (sighted == 0) {
        continue;
      }
      IntLanes distances;
      detail::sq_distances(chunks_[id], point, distances);
      const int lane = nearest_lane(distances, sighted);
      const auto sq_distance = static_cast<std::uint32_t>(distances[lane]);
      if (sq_distance < best_sq_distance) {
        best = {id, lane};
        best_sq_distance = sq_distance;
      }
    }
    return best;
  }

  /// The first surface that agrees with the normal; the last one takes whatever is left.
  SurfaceChoice first_consistent(std::uint32_t front, const StoredNormal& normal) const noexcept {
    std::uint32_t surface = front;
    for (int count = 1;; ++count) {
      const PointChunk& chunk = chunks_[surface];
      if (count == max_surfaces_ || dot(chunk.direction, normal) > min_surface_dot_) {
        return {surface, false};
      }
      if (chunk.next_surface == kNone) {
        return {surface, true};
      }
      surface = chunk.next_surface;
    }
  }

  SurfaceChoice smallest_angle(std::uint32_t front, const StoredNormal& normal) const noexcept {
    int best_dot = std::numeric_limits<int>::min();
    std::uint32_t best = front;
    std::uint32_t last = front;
    int count = 0;
    for (std::uint32_t surface = front; surface != kNone; surface = chunks_[surface].next_surface) {
      const int surface_dot = dot(chunks_[surface].direction, normal);
      if (surface_dot > best_dot) {
        best_dot = surface_dot;
        best = surface;
      }
      last = surface;
      ++count;
    }
    const bool agrees = best_dot > min_surface_dot_;
    return agrees || count == max_surfaces_ ? SurfaceChoice{best, false}
                                            : SurfaceChoice{last, true};
  }

  const PointChunk* chunks_;
  const NormalChunk* normals_;
  std::int32_t min_surface_dot_;
  std::int32_t min_sq_steps_;
  int max_surfaces_;
  int points_per_surface_;
  SurfaceRule rule_;
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_ADMISSION_HPP
