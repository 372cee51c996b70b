// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <vector>

#include "nvm/core/point_access.hpp"
#include "nvm/core/require.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/voxel_set.hpp"

namespace nvm {

/// A map of bare points in a k-d tree that is rebuilt at every insertion: the baseline that knows
/// no normals and no sides, with exact neighbours at any distance. Models the map concept. Grows
/// without bound; insertion costs O(n log n) of the whole map.
class KdTreeMap {
 public:
  struct QueryContext {};

  /// Keeps one point per cubic cell with edge `point_spacing` [m], positive. Throws
  /// std::invalid_argument otherwise.
  explicit KdTreeMap(double point_spacing = 0.1)
      : occupied_(checked(point_spacing)), tree_(3, *this) {}

  // The tree points to the map.
  KdTreeMap(const KdTreeMap&) = delete;
  KdTreeMap& operator=(const KdTreeMap&) = delete;

  /// Adds `points` (any point range, frame scan). Counts what was dropped.
  template <class Points>
  InsertStats insert_unsided(const Points& points, const Pose& T_map_scan = Pose::Identity()) {
    static_assert(is_point_range_v<Points>, "nvm: points must be a range of points");
    InsertStats stats;
    for (std::size_t i = 0; i < static_cast<std::size_t>(points.size()); ++i) {
      const Eigen::Vector3d point = T_map_scan * nvm::position(points[i]);
      switch (occupied_.insert(point)) {
        case VoxelSet::Insertion::kNewCell:
          ++stats.stored;
          points_.push_back(point);
          break;
        case VoxelSet::Insertion::kOccupied:
          ++stats.too_close;
          break;
        case VoxelSet::Insertion::kNonFinite:
          ++stats.non_finite;
          break;
        case VoxelSet::Insertion::kOutOfRange:
          ++stats.out_of_range;
          break;
      }
    }
    tree_.buildIndex();
    return stats;
  }

  /// The nearest stored points (see map_concept.hpp); `normal` is ignored.
  // nanoflann throws only where no tree has been built.
  // NOLINTNEXTLINE(bugprone-exception-escape)
  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& /*normal*/,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& /*context*/) const noexcept {
    if (points_.empty() || !point.allFinite()) {
      return 0;
    }
    const std::size_t count = std::clamp<std::size_t>(search.count, 1, kMaxNeighbors);
    std::array<std::uint32_t, kMaxNeighbors> indices;
    std::array<double, kMaxNeighbors> sq_distances;
    nanoflann::KNNResultSet<double, std::uint32_t> found(count);
    found.init(indices.data(), sq_distances.data());
    // The result set takes what is nearer than its last entry: that bounds the search, inclusively.
    sq_distances[count - 1] = std::nextafter(
        search.max_distance * search.max_distance, std::numeric_limits<double>::infinity());
    tree_.findNeighbors(found, point.data(), nanoflann::SearchParams());
    for (std::size_t i = 0; i < found.size(); ++i) {
      out[i] = {points_[indices[i]], static_cast<float>(sq_distances[i]), indices[i]};
    }
    return found.size();
  }

  /// Stored points, map frame [m].
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  std::size_t size() const { return points_.size(); }

  // What nanoflann asks of its data set.
  std::size_t kdtree_get_point_count() const { return points_.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points_[index][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }

 private:
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<
      nanoflann::L2_Simple_Adaptor<double, KdTreeMap>,
      KdTreeMap,
      3,
      std::uint32_t>;

  static double checked(double point_spacing) {
    require(
        point_spacing > 0.0 && std::isfinite(point_spacing),
        "point_spacing",
        point_spacing,
        "positive [m]");
    return point_spacing;
  }

  std::vector<Eigen::Vector3d> points_;
  VoxelSet occupied_;
  Tree tree_;
};

}  // namespace nvm
