// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::lio {

/// The map of a pipeline, whatever its kind: models the map concept (nvm/map/map_concept.hpp), so
/// that everything that runs on it is one code path.
class LioMap {
 public:
  using QueryContext = VoxelMap::QueryContext;

  virtual ~LioMap() = default;

  /// Adds a scan: points [m] and unit normals or sightings (nvm/map/sighting.hpp), in the scan
  /// frame (Eq. 3), and what they carry beside, all of equal number. Points with neither (zero) are
  /// not stored, by any kind of map: they lie on no surface.
  virtual InsertStats insert(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const std::vector<PointValues>& values,
      const Pose& T_map_scan) = 0;

  /// See map_concept.hpp.
  virtual std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept = 0;

  virtual void clear() = 0;
  virtual std::size_t size() const = 0;  ///< points
  virtual std::size_t memory_bytes() const = 0;
  /// Those whose plane is known, or all of a map without normals.
  virtual std::vector<MapPoint> points() const = 0;

  /// The voxel map inside, null for a map of another kind.
  virtual const VoxelMap* voxel_map() const { return nullptr; }

  /// Which values points() have.
  MapColumns columns() const {
    return voxel_map() != nullptr ? voxel_map()->options().columns : MapColumns();
  }

  /// Whether insert() leaves it as it is.
  virtual bool is_frozen() const { return false; }
};

/// Names of the kinds of map, for `map.type`.
enum class MapType {
  kNvm,     ///< two sides, gated by surface and point normals
  kVoxel,   ///< no normals: the CT-LIO baseline
  kFacing,  ///< one surface per voxel, points gated by their normals inside the query
  kReject,  ///< the k nearest of all points first, those that face away dropped afterwards
  kKdTree,  ///< k-d tree of points, no normals
};

/// Throws std::invalid_argument for bad options, and for columns that no scan fills.
std::unique_ptr<LioMap> make_map(MapType type, const MapOptions& options);

/// A two-sided map that others have begun, with its own options. Frozen, it stays as it is; else
/// scans go on into it.
std::unique_ptr<LioMap> continued_map(VoxelMap prior, bool is_frozen);

}  // namespace nvm::lio
