// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "fuzz_target.hpp"
#include "map_audit.hpp"
#include "nvm/map/voxel_map.hpp"
#include "support/map_oracle.hpp"
#include "support/random_cloud.hpp"

namespace nvm::fuzz {

/// A coordinate or length: most within a few voxels, many on their borders, some absurd.
inline double take_number(Input& input, double voxel_size) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr std::array<double, 8> kOdd{0.0, -1e-17, 1e-300, 1e5, -1e9, 1e15, 1e300, kNan};
  const int kind = input.below(32);
  const int steps = input.take<std::int16_t>();
  if (kind < 24) {
    return 1e-4 * steps * voxel_size;
  }
  return kind < 28 ? 0.5 * voxel_size * (steps % 8)
                   : kOdd[static_cast<std::size_t>(std::abs(steps % 8))];
}

inline Eigen::Vector3d take_point(Input& input, double voxel_size) {
  const double x = take_number(input, voxel_size);
  const double y = take_number(input, voxel_size);
  return {x, y, take_number(input, voxel_size)};
}

/// Points that a seed scatters over some voxels, or that the input tells one by one.
inline test::Cloud take_cloud(Input& input, double voxel_size) {
  std::mt19937_64 random(input.take<std::uint16_t>());
  const int kind = input.below(4);
  const auto size = static_cast<std::size_t>(input.below(100));
  if (kind == 0) {
    return test::uniform_cloud(size, voxel_size, take_point(input, voxel_size), random);
  }
  if (kind == 1) {
    return test::uniform_cloud(3 * size, 6.0 * voxel_size, Eigen::Vector3d::Zero(), random);
  }
  test::Cloud cloud;
  for (std::size_t i = 0; i < size && !input.empty(); ++i) {
    cloud.points.push_back(take_point(input, voxel_size));
    cloud.normals.push_back(
        kind == 2 ? test::random_unit(random)
                  : Eigen::Vector3f(Eigen::Vector3f::Unit(input.below(3)) * (1 - input.below(3))));
  }
  return cloud;
}

using Place = std::array<double, 3>;
using Places = std::multiset<Place>;

inline Place place_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

inline Places places(const VoxelMap& map) {
  Places found;
  map.for_each_point([&](const MapPoint& point) { found.insert(place_of(point.position)); });
  return found;
}

/// Requires that all points that were given are accounted for, and that no others are stored.
inline void check_insertion(
    const VoxelMap& map,
    const test::Cloud& cloud,
    const InsertStats& stats,
    const Places& before,
    std::size_t voxels_before) {
  require(
      stats.stored + stats.settled + stats.too_close + stats.surface_full + stats.no_normal +
              stats.non_finite + stats.out_of_range + stats.map_full ==
          cloud.points.size(),
      "every point is counted once");
  require(
      map.size() + stats.evicted_points == before.size() + stats.stored,
      "stored and evicted points make up the size");
  require(
      map.voxel_count() + stats.evicted_voxels == voxels_before + stats.new_voxels,
      "new and evicted voxels make up their number");
  if (map.options().max_merged_points > 1) {
    return;  // points move
  }
  Places old = before;
  const double rounding = map.options().voxel_size / 8192.0;
  for (const Place& place : places(map)) {
    if (const auto known = old.find(place); known != old.end()) {
      old.erase(known);
      continue;
    }
    const Eigen::Map<const Eigen::Vector3d> stored(place.data());
    const auto is_it = [&](const Eigen::Vector3d& p) { return (p - stored).norm() <= rounding; };
    require(
        std::any_of(cloud.points.begin(), cloud.points.end(), is_it),
        "a new point is one that was given");
  }
}

/// Requires that what is left of `before` is what `excess` (of a point beyond what is erased: above
/// zero where it stays) says, to `rounding`.
template <class Excess>
void check_erasure(
    const VoxelMap& map,
    const Places& before,
    std::size_t erased,
    const Excess& excess,
    double rounding) {
  Places left = places(map);
  require(before.size() == left.size() + erased, "the erased points are counted");
  for (const Place& place : before) {
    const double beyond = excess(Eigen::Vector3d(place[0], place[1], place[2]));
    const auto found = left.find(place);
    const bool is_left = found != left.end();
    require(!(beyond > rounding) || is_left, "what lies outside stays");
    require(!(beyond <= -rounding) || !is_left, "what lies inside goes");
    if (is_left) {
      left.erase(found);
    }
  }
  require(left.empty(), "erasing moves nothing");
}

/// Requires that `found` are the nearest of `candidates`, as far as those are certain.
inline void check_nearest(
    const std::vector<test::MapOracle::Candidate>& candidates,
    const std::array<Neighbor, kMaxNeighbors>& found,
    std::size_t count,
    const NearestSearch& search) {
  const auto tolerance = [](double sq_distance) { return 1e-6 * (sq_distance + 1e-3); };
  const std::size_t wanted = std::min(search.count, kMaxNeighbors);
  require(count <= wanted && count <= candidates.size(), "no more neighbours than there are");
  double last = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double sq_distance = found[i].sq_distance;
    require(i == 0 || sq_distance >= found[i - 1].sq_distance, "neighbours ascend");
    const auto is_it = [&](const auto& candidate) {
      return std::abs(candidate.sq_distance - sq_distance) <= tolerance(sq_distance);
    };
    require(std::any_of(candidates.begin(), candidates.end(), is_it), "neighbours are candidates");
    last = count == wanted ? sq_distance : last;
  }
  const double limit = std::min(last, search.max_distance * search.max_distance);
  const auto is_missed = [&](const auto& candidate) {
    return candidate.certain && candidate.sq_distance < limit - tolerance(limit);
  };
  const auto certain = std::count_if(candidates.begin(), candidates.end(), is_missed);
  require(static_cast<std::size_t>(certain) <= count, "no nearer neighbour is missed");
}

}  // namespace nvm::fuzz
