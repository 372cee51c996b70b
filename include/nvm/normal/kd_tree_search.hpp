// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// Without nanoflann NormalMethod::kKdTree is refused.
#if __has_include(<nanoflann.hpp>)

#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>

#include "nvm/core/target.hpp"
#include "nvm/geometry/float_lanes.hpp"
#include "nvm/geometry/moments.hpp"
#include "nvm/normal/query_block.hpp"
#include "nvm/normal/sorted_points.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Sums the neighbourhoods of a block of queries over nanoflann's k-d tree: the reference of
/// spec §2.2, with the same neighbours as BlockSearch. Reads only; safe from many threads.
class KdTreeSearch {
 public:
  explicit KdTreeSearch(const SortedPoints& points)
      : points_(points), view_{points}, tree_(3, view_) {}

  void operator()(const QueryBlock& query, Moments<FloatLanes>& sums) const {
    for (std::size_t i = query.begin; i < query.end; ++i) {
      const float position[3] = {query.queries.x[i], query.queries.y[i], query.queries.z[i]};
      Neighborhood neighborhood(points_, position, query.queries.sq_radius[i]);
      tree_.findNeighbors(neighborhood, position, {});
      set_lane(sums, i - query.begin, neighborhood.moments());
    }
  }

 private:
  // What nanoflann asks of a data set.
  struct View {
    const SortedPoints& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points.coordinate(axis)[i];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  // What nanoflann asks of a result set. nanoflann prunes by distances that it rounds in another
  // way, so it is asked for a little more and the exact test is made here.
  class Neighborhood {
   public:
    using DistanceType = float;
    using IndexType = std::uint32_t;

    Neighborhood(const SortedPoints& points, const float (&position)[3], float sq_radius)
        : points_(points),
          x_(position[0]),
          y_(position[1]),
          z_(position[2]),
          sq_radius_(sq_radius) {}

    bool addPoint(float, std::uint32_t i) {
      const float dx = points_.x[i] - x_, dy = points_.y[i] - y_, dz = points_.z[i] - z_;
      if (sq_length(dx, dy, dz) <= sq_radius_) {
        moments_.add(1.0F, dx, dy, dz);
      }
      return true;
    }
    float worstDist() const { return sq_radius_ * 1.00001F; }
    bool full() const { return true; }
    bool empty() const { return size() == 0; }
    std::size_t size() const { return static_cast<std::size_t>(moments_.count); }
    void sort() {}
    const Moments<float>& moments() const { return moments_; }

   private:
    const SortedPoints& points_;
    float x_, y_, z_, sq_radius_;
    Moments<float> moments_;
  };

  static void set_lane(Moments<FloatLanes>& sums, std::size_t lane, const Moments<float>& m) {
    sums.count[lane] = m.count;
    sums.x[lane] = m.x;
    sums.y[lane] = m.y;
    sums.z[lane] = m.z;
    sums.xx[lane] = m.xx;
    sums.xy[lane] = m.xy;
    sums.xz[lane] = m.xz;
    sums.yy[lane] = m.yy;
    sums.yz[lane] = m.yz;
    sums.zz[lane] = m.zz;
  }

  using Tree = nanoflann::
      KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, View>, View, 3, std::uint32_t>;

  const SortedPoints& points_;
  View view_;
  Tree tree_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail

#endif
