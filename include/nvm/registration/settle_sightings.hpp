// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/executor.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/registration/association.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Gives the points with a sighting for a normal the plane of the map where it knows one, to be
/// called before they are inserted: their normal becomes that of the plane, turned to the sensor,
/// and they move onto it. `points` [m] and `normals` are in the scan frame and of equal length;
/// only those at `indices` are looked at, the others stay as they are. Returns how many were
/// settled. 0.3 to 0.5 us per point. The same for any number of threads.
template <class Map, class Executor = SerialExecutor>
std::size_t settle_sightings(
    const Map& map,
    const Pose& T_map_scan,
    const std::vector<std::uint32_t>& indices,
    const AssociationOptions& options,
    std::vector<Eigen::Vector3f>& points,
    std::vector<Eigen::Vector3f>& normals,
    const Executor& executor = {}) {
  constexpr std::size_t kGrain = 256;
  const Eigen::Matrix3d R = T_map_scan.linear();
  std::vector<std::size_t> settled((indices.size() + kGrain - 1) / kGrain, 0);
  executor.for_blocks(indices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    typename Map::QueryContext context;
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector3f& point = points[indices[i]];
      Eigen::Vector3f& normal = normals[indices[i]];
      if (!is_sighting(normal)) {
        continue;
      }
      const Eigen::Vector3d p_map = T_map_scan * point.cast<double>();
      const Association found = associate(map, p_map, R.cast<float>() * normal, options, context);
      if (found.status == AssociationStatus::kValid) {
        normal = (R.transpose() * found.normal).cast<float>();
        point -= static_cast<float>(found.distance) * normal;
        ++settled[begin / kGrain];
      }
    }
  });
  std::size_t total = 0;
  for (const std::size_t count : settled) {
    total += count;
  }
  return total;
}

}  // namespace NVM_TARGET
}  // namespace nvm
