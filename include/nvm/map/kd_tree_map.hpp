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

#include "nvm/core/finite.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/voxel_set.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// A map of bare points in a k-d tree that is rebuilt at every insertion: the baseline that knows
/// no normals and no sides, with exact neighbours at any distance. Models the map concept, by
/// nanoflann 1.4 or later. Grows without bound; insertion costs O(n log n) of the whole map.
/// `Real` is double.
template <class Real>
class BasicKdTreeMap {
 public:
  struct QueryContext {};

  /// Keeps one point per cubic cell with edge `point_spacing` [m], positive. Throws
  /// std::invalid_argument otherwise.
  explicit BasicKdTreeMap(double point_spacing = 0.1)
      : occupied_(checked(point_spacing)), tree_(3, *this) {}

  // The tree points to the map.
  BasicKdTreeMap(const BasicKdTreeMap&) = delete;
  BasicKdTreeMap& operator=(const BasicKdTreeMap&) = delete;

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
    if (points_.empty() || search.count == 0 || !detail::all_finite(point) ||
        !detail::is_distance(search.max_distance)) {
      return 0;
    }
    Nearest found(search);
    tree_.findNeighbors(found, point.data(), {});
    return found.write(points_, out);
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
  /// The nearest points so far, ascending: what every nanoflann since 1.4 asks of a result set, and
  /// bounded by the largest distance of the search.
  class Nearest {
   public:
    using DistanceType = double;
    using IndexType = std::uint32_t;

    // The tree asks for what is nearer than worstDist(), and points may lie at max_distance.
    explicit Nearest(const NearestSearch& search)
        : wanted_(std::min(search.count, kMaxNeighbors)),
          end_(std::nextafter(
              search.max_distance * search.max_distance, std::numeric_limits<double>::infinity())) {
    }

    bool addPoint(double sq_distance, std::uint32_t index) {
      if (sq_distance < worstDist()) {
        count_ -= full() ? 1U : 0U;
        std::size_t place = count_++;
        for (; place > 0 && sq_distances_[place - 1] > sq_distance; --place) {
          sq_distances_[place] = sq_distances_[place - 1];
          indices_[place] = indices_[place - 1];
        }
        sq_distances_[place] = sq_distance;
        indices_[place] = index;
      }
      return true;
    }
    double worstDist() const { return full() ? sq_distances_[count_ - 1] : end_; }
    bool full() const { return count_ == wanted_; }
    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    void sort() {}

    std::size_t write(const std::vector<Eigen::Vector3d>& points, Neighbor* out) const {
      for (std::size_t i = 0; i < count_; ++i) {
        out[i] = {points[indices_[i]], static_cast<float>(sq_distances_[i]), indices_[i]};
      }
      return count_;
    }

   private:
    std::size_t wanted_;
    double end_;
    std::size_t count_ = 0;
    std::array<double, kMaxNeighbors> sq_distances_;
    std::array<std::uint32_t, kMaxNeighbors> indices_;
  };

  using Tree = nanoflann::KDTreeSingleIndexAdaptor<
      nanoflann::L2_Simple_Adaptor<Real, BasicKdTreeMap>,
      BasicKdTreeMap,
      3,
      std::uint32_t>;

  static double checked(double point_spacing) {
    require(
        point_spacing > 0.0 && detail::is_finite(point_spacing),
        "point_spacing",
        point_spacing,
        "positive [m]");
    return point_spacing;
  }

  std::vector<Eigen::Vector3d> points_;
  VoxelSet occupied_;
  Tree tree_;
};

using KdTreeMap = BasicKdTreeMap<double>;

}  // namespace NVM_TARGET
}  // namespace nvm
