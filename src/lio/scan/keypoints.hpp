// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/map/voxel_set.hpp"

namespace nvm::lio {

/// The returns of a scan that are matched to the map, spread evenly over its surfaces.
struct KeypointOptions {
  /// At most one keypoint in each cube of this edge [m], positive.
  double spacing = 0.35;
  /// Keypoints at most, 10 to 100000.
  std::size_t max_count = 1500;
  /// A scan that shows little, as a wall close in front of a narrow field of view, gets finer cubes
  /// until it has that many with a normal: of half the edge, up to three times. Twice what an
  /// update needs.
  std::size_t min_count = 100;
  /// Of them with a sighting for a normal, at most: in foliage most points have no plane, and a few
  /// on a floor tell as much as many.
  std::size_t max_sightings = 300;

  void validate() const;
};

/// Picks keypoints. Keeps its memory from scan to scan.
class KeypointSampler {
 public:
  explicit KeypointSampler(const KeypointOptions& options);

  /// Indices of the chosen points among `points` [m, scan frame], of those with a normal, and where
  /// a cube has none with a sighting (nvm/map/sighting.hpp); never with a zero normal. The points
  /// of a cube have equal chances whatever their place in the scan, so that no time of the sweep is
  /// preferred; yet the same scan always gives the same answer.
  const std::vector<std::uint32_t>& sample(
      const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals);

 private:
  /// One point in each of `cubes`, of those that `takes` takes by their indices.
  template <class Predicate>
  void choose(const std::vector<Eigen::Vector3f>& points, const Predicate& takes, VoxelSet& cubes);
  /// The same where `cubes` has none, until there are `max_count`.
  template <class Predicate>
  void add(
      const std::vector<Eigen::Vector3f>& points,
      const Predicate& takes,
      std::size_t max_count,
      VoxelSet& cubes);

  KeypointOptions options_;
  std::vector<VoxelSet> cubes_;  ///< ever finer
  std::vector<std::uint32_t> chosen_;
};

/// Mean distance of `points` [m] from their origin; 0 without any.
double mean_range(const std::vector<Eigen::Vector3f>& points);

/// Makes `picked` the elements of `all` at `indices`.
template <typename Value>
void pick(
    const std::vector<Value>& all,
    const std::vector<std::uint32_t>& indices,
    std::vector<Value>& picked) {
  picked.clear();
  for (const std::uint32_t index : indices) {
    picked.push_back(all[index]);
  }
}

}  // namespace nvm::lio
