// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/start_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "nvm/core/require.hpp"

namespace nvm::lio {

namespace {

MapOptions map_options(const StartSearchOptions& options) {
  MapOptions map;
  map.voxel_size = options.voxel_size;
  map.min_point_distance = 0.25 * options.voxel_size;
  return map;
}

AlignOptions align_options(const StartSearchOptions& options) {
  AlignOptions align;
  align.association.neighbors = 10;
  align.association.max_neighbor_distance = 2.0 * options.voxel_size;
  align.association.max_plane_distance = 2.0 * options.voxel_size;
  align.kernel.scale = 0.5 * options.voxel_size;
  align.max_iterations = 30;
  return align;
}

KeypointOptions keypoint_options(const StartSearchOptions& options) {
  constexpr std::size_t kMaxCount = 500;
  return {options.keypoint_spacing, kMaxCount, 0};
}

}  // namespace

StartSearch::StartSearch(const StartSearchOptions& options, const Executor& executor)
    : options_((options.validate(), options)),
      executor_(executor),
      map_(map_options(options)),
      sampler_(keypoint_options(options)),
      aligner_(align_options(options)) {}

void StartSearch::insert(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan) {
  map_.insert(points, normals, T_map_scan);
}

void StartSearch::insert(const VoxelMap& map) {
  constexpr std::size_t kBlock = 65536;  // so that large maps are not held twice
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  const auto insert_block = [&] {
    map_.insert(points, normals);
    points.clear();
    normals.clear();
  };
  map.for_each_point([&](const MapPoint& point) {
    points.push_back(point.position.cast<float>());
    normals.push_back(point.normal);
    if (points.size() == kBlock) {
      insert_block();
    }
  });
  insert_block();
}

std::vector<Pose> StartSearch::search(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const std::vector<Pose>& guesses) {
  std::vector<Eigen::Vector3f> key_points;
  std::vector<Eigen::Vector3f> key_normals;
  for (const std::uint32_t index : sampler_.sample(points, normals)) {
    key_points.push_back(points[index]);
    key_normals.push_back(normals[index]);
  }
  std::vector<AlignResult> found;
  found.reserve(guesses.size());
  for (const Pose& guess : guesses) {
    found.push_back(aligner_.align(map_, key_points, key_normals, guess, executor_));
  }
  std::stable_sort(found.begin(), found.end(), [](const AlignResult& a, const AlignResult& b) {
    return a.cost < b.cost;
  });
  std::vector<Pose> poses;
  poses.reserve(found.size());
  for (const AlignResult& result : found) {
    poses.push_back(result.T_map_scan);
  }
  return poses;
}

std::vector<Pose> StartSearch::turned(const std::vector<Pose>& guesses) const {
  std::vector<Pose> result;
  for (const Pose& guess : guesses) {
    for (int axis = 0; axis < 3 && options_.turn > 0.0; ++axis) {
      for (const double angle : {-options_.turn, options_.turn}) {
        result.push_back(guess);
        result.back().linear() *= so3_exp(angle * Eigen::Vector3d::Unit(axis));
      }
    }
  }
  return result;
}

void StartSearchOptions::validate() const {
  require(
      voxel_size >= 0.1 && voxel_size <= 10.0, "search voxel_size", voxel_size, "0.1 to 10 [m]");
  require(keypoint_spacing > 0.0, "search keypoint_spacing", keypoint_spacing, "positive [m]");
  require(turn >= 0.0 && turn <= 3.1415926535897932, "search turn", turn, "0 to pi [rad]");
}

}  // namespace nvm::lio
