// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/map_files.hpp"

#include <cstdint>

#include "nvm/map/serialization.hpp"

namespace nvm::io {

MapCloud map_cloud_of(const std::vector<MapPoint>& points, const Eigen::Vector3d& origin) {
  MapCloud cloud;
  for (const MapPoint& point : points) {
    cloud.positions.push_back(point.position + origin);
    cloud.normals.push_back(point.normal);
    cloud.sides.push_back(static_cast<std::uint8_t>(point.side));
  }
  return cloud;
}

void write_map_files(
    const lio::LioMap& map, const Eigen::Vector3d& origin, const std::string& stem) {
  write_map_cloud(stem + ".ply", map_cloud_of(map.points(), origin));
  if (map.voxel_map() != nullptr) {
    save_map(*map.voxel_map(), stem + ".nvm");
  }
}

}  // namespace nvm::io
