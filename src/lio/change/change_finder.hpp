// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lio/change/change_votes.hpp"
#include "lio/change/changed_places.hpp"
#include "lio/scan/deskew.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::lio {

/// Finds what has changed since a map was made, by the lines of sight of scans that were localised
/// in it. A face of the map is no longer there when lines that it would stop end far behind it; a
/// surface is added when it stops lines before a face that they would reach, and the map has
/// nothing about it. Either must be so in several scans and hardly ever be contradicted, so that
/// neither noise nor people who pass are changes. What the map never had in view cannot be told
/// from what was added: also the sides of furniture that it was not seen from.
///
/// Uses `prior` while it lives. Memory grows with the changes, up to a limit (see ChangeVotes).
class ChangeFinder {
 public:
  explicit ChangeFinder(const VoxelMap& prior) : prior_(prior) {}

  /// Takes a scan with the normals of its points (sightings and zero are left out), where it was
  /// localised. Costs as much as a few frames of odometry: some scans from places half a metre
  /// apart tell as much as all.
  void add(
      const DeskewedScan& scan,
      const std::vector<Eigen::Vector3f>& normals,
      const Pose& T_map_scan);

  std::size_t scans() const { return scans_; }

  /// Surfaces that the map lacks, and such as it has that are no longer there; largest first.
  std::vector<ChangedPlace> added() const { return changed_places(added_.elected()); }
  std::vector<ChangedPlace> gone() const { return changed_places(gone_.elected()); }

 private:
  struct View;

  void look_at_face(View& view, const Neighbor& face);
  void note_added(View& view);
  void look_through_added(const View& view);

  const VoxelMap& prior_;
  ChangeVotes added_, gone_;
  std::size_t scans_ = 0;
};

}  // namespace nvm::lio
