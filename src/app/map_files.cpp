// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/map_files.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>

#include "io/file.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm::app {

io::MapCloud map_cloud_of(const std::vector<MapPoint>& points) {
  io::MapCloud cloud;
  for (const MapPoint& point : points) {
    cloud.positions.push_back(point.position);
    cloud.normals.push_back(point.normal);
    cloud.sides.push_back(static_cast<std::uint8_t>(point.side));
  }
  return cloud;
}

void write_map_files(const lio::LioMap& map, const std::string& folder) {
  io::write_map_cloud(folder + "/map.ply", map_cloud_of(map.points()));
  if (map.voxel_map() != nullptr) {
    save_map(*map.voxel_map(), folder + "/map.nvm");
  }
}

void make_output_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    io::fail(folder, "cannot be made: " + error.message());
  }
  const io::AtomicFile probe(folder + "/.nvm");
}

}  // namespace nvm::app
