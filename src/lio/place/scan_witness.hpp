// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lio/place/sight_lines.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::lio {

/// What a point of a scan says of a place in a map.
enum class Testimony : std::uint8_t {
  kNone,     ///< the map has nothing there
  kFor,      ///< it lies on a face of the map that faces it
  kAgainst,  ///< its line of sight passes such a face, or it lies right beside one
};

using Testimonies = std::vector<Testimony>;

/// How many points say `testimony` of a place.
std::size_t count(const Testimonies& place, Testimony testimony);

/// How many points say `testimony` of `place` and not of `other`.
std::size_t count_only(const Testimonies& place, const Testimonies& other, Testimony testimony);

/// The points of a scan as witnesses of where it was made. Light does not pass a wall: only what
/// the map has can speak against a place, so that places are not told apart by how well they were
/// mapped.
class ScanWitness {
 public:
  /// Takes the returns `points` [m, scan frame], seen from the origin, and their unit normals
  /// (zero: left out) of equal number; of very many some.
  ScanWitness(
      const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals);

  std::size_t size() const { return points_.size(); }

  /// What each point says when the scan is at `T_map_scan`, in an order of their own.
  Testimonies testify(const VoxelMap& map, const Pose& T_map_scan) const;

 private:
  struct Question;
  struct Face;

  void look_through(const Face& face, Question& question) const;
  Testimony lies_on(std::size_t point, Question& question) const;

  SightLines lines_;
  // In their order.
  std::vector<Eigen::Vector3f> points_;      ///< [m]
  std::vector<Eigen::Vector3f> normals_;     ///< unit
  std::vector<Eigen::Vector3f> directions_;  ///< unit
  std::vector<float> ranges_;                ///< [m]
};

}  // namespace nvm::lio
