// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/map_files.hpp"

#include <algorithm>
#include <cstdint>

#include "nvm/map/serialization.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::io {

namespace {

/// Scans without intensities leave zeros, which are not worth a field.
bool has_intensities(const MapCloud& cloud) {
  return cloud.columns.intensity &&
         std::any_of(cloud.values.begin(), cloud.values.end(), [](const PointValues& values) {
           return values.intensity != 0.0F;
         });
}

}  // namespace

MapCloud map_cloud_of(
    const std::vector<MapPoint>& points, const MapColumns& columns, const Eigen::Vector3d& origin) {
  MapCloud cloud;
  cloud.columns = columns;
  for (const MapPoint& point : points) {
    cloud.positions.push_back(point.position + origin);
    cloud.normals.push_back(point.normal);
    cloud.sides.push_back(static_cast<std::uint8_t>(point.side));
    cloud.values.push_back(point.values);
  }
  cloud.columns.intensity = has_intensities(cloud);
  return cloud;
}

MapCloud map_cloud_of(const VoxelMap& map, const Eigen::Vector3d& origin) {
  return map_cloud_of(without_sightings(map.points()), map.options().columns, origin);
}

void write_map_files(
    const lio::LioMap& map, const Eigen::Vector3d& origin, const std::string& stem) {
  write_map_cloud(stem + ".ply", map_cloud_of(map.points(), map.columns(), origin));
  if (map.voxel_map() != nullptr) {
    save_map(*map.voxel_map(), stem + ".nvm");
  }
}

}  // namespace nvm::io
