// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/tile_store.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/file/file.hpp"
#include "io/file/stays_below.hpp"
#include "io/result/map_files.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::io {

namespace {

constexpr int kStoreVersion = 1;

struct Tile {
  std::array<double, 3> index;  ///< in edges of a tile
  std::string file;
  std::size_t points;
};

struct Index {
  double tile_size = 0.0;  ///< [m]
  std::vector<Tile> tiles;
};

Index read_index(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    fail(path, "is missing: no store of tiles, or its build has not come to its end");
  }
  Index index;
  int version = 0;
  try {
    const nlohmann::json json = nlohmann::json::parse(read_file(path));
    version = json.at("format") == "nvm-store" ? json.at("version").get<int>() : 0;
    if (version == kStoreVersion) {
      index.tile_size = json.at("tile_size").get<double>();
      for (const auto& tile : json.at("tiles")) {
        index.tiles.push_back(
            {tile.at("tile").get<std::array<double, 3>>(),
             tile.at("file").get<std::string>(),
             tile.at("points").get<std::size_t>()});
      }
    }
  } catch (const nlohmann::json::exception&) {
    version = 0;
  }
  if (version > kStoreVersion) {
    fail(path, "has version " + std::to_string(version) + "; this nvm reads 1");
  }
  if (version < kStoreVersion || !(index.tile_size > 0.0)) {
    fail(path, "is not the index of a store, or is damaged");
  }
  return index;
}

bool is_in(const Tile& tile, double tile_size, const Eigen::Vector3d& position) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::floor(position[static_cast<Eigen::Index>(axis)] / tile_size) != tile.index[axis]) {
      return false;
    }
  }
  return true;
}

}  // namespace

MapCloud read_tile_store(const std::string& folder) {
  const Index index = read_index(folder + "/index.json");
  std::vector<MapPoint> points;
  for (const Tile& tile : index.tiles) {
    if (!stays_below(tile.file)) {
      fail(folder + "/index.json", "names a file outside the store: " + tile.file);
    }
    const std::string path = folder + "/" + tile.file;
    const std::size_t before = points.size();
    for (const MapPoint& point : load_map(path).points()) {
      if (is_in(tile, index.tile_size, point.position)) {
        points.push_back(point);
      }
    }
    if (points.size() - before != tile.points) {
      fail(path, "is not the file that index.json tells of: build the store again");
    }
  }
  return map_cloud_of(without_sightings(std::move(points)), {}, Eigen::Vector3d::Zero());
}

}  // namespace nvm::io
