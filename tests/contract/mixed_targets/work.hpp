// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/map/map_archive.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/normal/normal_estimator.hpp"

namespace nvm::test {

// What a translation unit did with a map of its own, one that another unit made, and a scan.
struct Work {
  std::vector<std::uint8_t> map;
  std::size_t neighbors = 0;
  std::vector<Eigen::Vector3f> normals;
};

// `normals` too uses templates of the standard library and of Eigen that are nobody's own.
Work plain_work(VoxelMap& shared, bool normals);
Work avx2_work(VoxelMap& shared, bool normals);

// Each unit has its own, and what it has in arrays shares no code of std::vector with others.
namespace {

constexpr std::size_t kPoints = 900;
using Points = std::array<Eigen::Vector3d, kPoints>;
using Normals = std::array<Eigen::Vector3f, kPoints>;

[[maybe_unused]] Work work(VoxelMap& shared, bool with_normals) {
  Points points;
  Normals normals;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double u = 0.05 * static_cast<double>(i % 30);
    const double v = 0.05 * static_cast<double>(i / 30) + 0.001 * static_cast<double>(i % 7);
    const bool on_floor = i < kPoints / 2;
    points[i] = on_floor ? Eigen::Vector3d(u, v, 0.0) : Eigen::Vector3d(u, 0.0, v);
    normals[i] = on_floor ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitY();
  }
  Work work;
  MapOptions options;
  options.max_merged_points = 4;
  options.space_across_voxels = true;
  VoxelMap map(options);
  map.insert(points, normals);
  map.insert_unsided(points);
  map.erase_within({0.5, 0.5, 0.0}, 0.2);
  for (VoxelMap* each : {&map, &shared}) {
    each->insert(points, normals);
    VoxelMap::QueryContext context;
    std::array<Neighbor, 20> found;
    for (std::size_t i = 0; i < kPoints; ++i) {
      work.neighbors += each->nearest(points[i], normals[i], {20, 0.5}, found.data(), context);
      work.neighbors += each->nearest(points[i], {5, 0.5}, found.data(), context);
    }
  }
  work.map = MapArchive::write(MapArchive::read(MapArchive::write(map)));
  if (with_normals) {
    work.normals = estimate_normals(points, Eigen::Vector3d(0.7, 0.7, 0.7)).normals;
  }
  return work;
}

}  // namespace
}  // namespace nvm::test
