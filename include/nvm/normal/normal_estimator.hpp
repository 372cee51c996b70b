// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "nvm/core/executor.hpp"
#include "nvm/core/finite.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/core/processor.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/normal/block_search.hpp"
#include "nvm/normal/block_tree.hpp"
#include "nvm/normal/cell_grid.hpp"
#include "nvm/normal/local_points.hpp"
#include "nvm/normal/normal_kernels.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/normal/normal_result.hpp"
#include "nvm/normal/spatial_sorter.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Estimates the normals of LiDAR scans (spec §2).
///
/// Keep one per sensor: its buffers are reused, so that nothing is allocated once they have grown
/// to the size of the scans. An estimator serves one caller at a time; the executor spreads the
/// work. The result is the same, bit for bit, for every executor.
class NormalEstimator {
 public:
  /// Throws std::invalid_argument when the options are out of range.
  explicit NormalEstimator(const NormalOptions& options = {}) : options_(options) {
    options_.validate();
  }

  const NormalOptions& options() const { return options_; }

  /// Normals of `points`, from their neighbours in `points`.
  ///
  /// `viewpoints` is where the sensor was, in the frame of the points [m]: one point for a raw
  /// scan, or a range with one per point for a deskewed one. Bad points get a status, never an
  /// exception. Throws std::invalid_argument when the numbers of points and viewpoints differ.
  /// The result stays valid until the next call.
  template <class Points, class Viewpoints, class Executor = SerialExecutor>
  const NormalResult& estimate(
      const Points& points, const Viewpoints& viewpoints, const Executor& executor = {}) & {
    prepare_cloud(points, viewpoints, executor);
    result_.status = cloud_status_;
    clear_planes(points);
    if (options_.method == NormalMethod::kPerCell) {
      solve_cells(executor);
    } else {
      solve(cloud_, result_, executor);
    }
    finish(points, viewpoints, executor);
    return result_;
  }

  /// Normals at `queries`, from their neighbours in `points`: for hosts that work on a thinned scan
  /// and still have the full one. A query counts among its neighbours only when it is one of the
  /// points. `viewpoint` is one point. Otherwise like estimate().
  template <class Queries, class Points, class Viewpoint, class Executor = SerialExecutor>
  const NormalResult& estimate_at(
      const Queries& queries,
      const Points& points,
      const Viewpoint& viewpoint,
      const Executor& executor = {}) & {
    static_assert(
        is_point_range_v<Queries>, "nvm: queries must have size() and operator[] of points");
    static_assert(is_point_v<Viewpoint>, "nvm: estimate_at() takes one viewpoint for all points");
    prepare_cloud(points, viewpoint, executor);
    localize(queries, viewpoint, position(viewpoint), result_.status, executor);
    sorter_.sort(local_, result_.status, sort_edge(), queries_);
    clear_planes(queries);
    solve(queries_, result_, executor);
    finish(queries, viewpoint, executor);
    return result_;
  }

 private:
  static constexpr std::size_t kPointGrain = 4096;
  static constexpr std::size_t kBlockGrain = 32;

  // Points that share a cube of half the smallest radius need no better order.
  double sort_edge() const {
    return options_.method == NormalMethod::kPerCell ? options_.cell_size
                                                     : 0.5 * options_.min_radius;
  }

  template <class Points, class Viewpoints, class Executor>
  void prepare_cloud(const Points& points, const Viewpoints& viewpoints, const Executor& executor) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must have size() and operator[] of points");
    static_assert(
        is_point_v<Viewpoints> || is_point_range_v<Viewpoints>,
        "nvm: viewpoints must be one point or have size() and operator[] of points");
    localize(points, viewpoints, local_origin(viewpoints), cloud_status_, executor);
    sorter_.sort(local_, cloud_status_, sort_edge(), cloud_);
    if (options_.method == NormalMethod::kPerCell) {
      grid_.build(cloud_, sorter_, 1.5 * options_.cell_size);
      tree_.build(detail::CellItems{grid_.means(), grid_.cells()}, executor);
    } else {
      tree_.build(detail::PointItems{cloud_}, executor);
    }
  }

  // The first viewpoint, so that a scan anywhere in a map keeps the resolution of its floats.
  template <class Viewpoints>
  static Eigen::Vector3d local_origin(const Viewpoints& viewpoints) {
    if constexpr (is_point_v<Viewpoints>) {
      return position(viewpoints);
    } else {
      for (std::size_t i = 0; i < viewpoints.size(); ++i) {
        if (const Eigen::Vector3d viewpoint = position(viewpoints[i]);
            detail::all_finite(viewpoint)) {
          return viewpoint;
        }
      }
      return detail::zeros<Eigen::Vector3d>();
    }
  }

  template <class Points, class Viewpoints, class Executor>
  void localize(
      const Points& points,
      const Viewpoints& viewpoints,
      const Eigen::Vector3d& origin,
      std::vector<NormalStatus>& status,
      const Executor& executor) {
    if constexpr (!is_point_v<Viewpoints>) {
      require(
          viewpoints.size() == points.size(),
          "number of viewpoints",
          viewpoints.size(),
          "one, or as many as points");
    }
    const detail::Localizer localizer(options_, origin);
    local_.resize(points.size());
    status.resize(points.size());
    executor.for_blocks(points.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        status[i] = localizer(position(points[i]), detail::viewpoint_of(viewpoints, i), i, local_);
      }
    });
  }

  template <class Points>
  void clear_planes(const Points& points) {
    const auto size = static_cast<std::size_t>(points.size());
    result_.normals.assign(size, detail::zeros<Eigen::Vector3f>());
    result_.plane_offsets.assign(size, 0.0F);
    result_.plane_variances.assign(size, 0.0F);
  }

  // With a second try, in a wider neighbourhood, where that makes sense.
  template <class Executor>
  void solve(const detail::SortedPoints& queries, NormalResult& result, const Executor& executor) {
    solve_once(queries, result, executor);
    if (options_.widening > 1.0) {
      select_thin(queries, result.status);
      solve_once(wider_, result, executor);
    }
  }

  // The queries whose neighbours are a line or too few, with a wider radius, into wider_.
  template <class = void>
  void select_thin(const detail::SortedPoints& queries, const std::vector<NormalStatus>& status) {
    const auto sq_widening = static_cast<float>(options_.widening * options_.widening);
    wider_.resize(queries.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const std::uint32_t index = queries.index[i];
      if (status[index] == NormalStatus::kLineLike ||
          status[index] == NormalStatus::kFewNeighbors) {
        wider_.x[count] = queries.x[i];
        wider_.y[count] = queries.y[i];
        wider_.z[count] = queries.z[i];
        wider_.sq_radius[count] = sq_widening * queries.sq_radius[i];
        wider_.index[count] = index;
        ++count;
      }
    }
    wider_.resize(count);
  }

  template <class Executor>
  void solve_once(
      const detail::SortedPoints& queries, NormalResult& result, const Executor& executor) {
    if (options_.method == NormalMethod::kBlockTree) {
      return solve_among_points(queries, result, executor);
    }
    using Items = detail::CellItems;
    const Items cells{grid_.means(), grid_.cells()};
    run(detail::PlaneSolver<detail::BlockSearch<Items>>(options_, queries, result, cells, tree_),
        executor);
  }

  template <class Executor>
  void solve_among_points(
      const detail::SortedPoints& queries, NormalResult& result, const Executor& executor) const {
#ifdef NVM_CHOOSES_KERNELS
    if (detail::has_avx2()) {
      using Items = for_avx2_kernels::detail::PointItems;
      using Solver = for_avx2_kernels::detail::PointSolver;
      return run(Solver(options_, queries, result, Items{cloud_}, tree_), executor);
    }
#endif
    run(detail::PointSolver(options_, queries, result, detail::PointItems{cloud_}, tree_),
        executor);
  }

  template <class Executor>
  void solve_cells(const Executor& executor) {
    cell_result_.status.resize(grid_.size());
    cell_result_.normals.resize(grid_.size());
    cell_result_.plane_offsets.resize(grid_.size());
    cell_result_.plane_variances.resize(grid_.size());
    solve(grid_.means(), cell_result_, executor);
    grid_.for_each_point(cloud_, [this](std::size_t cell, std::size_t point) {
      result_.status[point] = cell_result_.status[cell];
      const Eigen::Vector3f& normal = cell_result_.normals[cell];
      const detail::SortedPoints& mean = grid_.means();
      const Eigen::Vector3f to_mean(
          mean.x[cell] - local_.x[point],
          mean.y[cell] - local_.y[point],
          mean.z[cell] - local_.z[point]);
      result_.normals[point] = normal;
      result_.plane_offsets[point] = cell_result_.plane_offsets[cell] + normal.dot(to_mean);
      result_.plane_variances[point] = cell_result_.plane_variances[cell];
    });
  }

  template <class Solver, class Executor>
  static void run(const Solver& solver, const Executor& executor) {
    executor.for_blocks(solver.block_count(), kBlockGrain, [&](std::size_t begin, std::size_t end) {
      solver(begin, end);
    });
  }

  // Turns the normals to their viewpoints (spec §2.3).
  template <class Points, class Viewpoints, class Executor>
  void finish(const Points& points, const Viewpoints& viewpoints, const Executor& executor) {
    executor.for_blocks(points.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Eigen::Vector3d ray = position(points[i]) - detail::viewpoint_of(viewpoints, i);
        Eigen::Vector3f& normal = result_.normals[i];
        if (result_.status[i] == NormalStatus::kValid &&
            detail::dot(ray, detail::cast<double>(normal)) > 0.0) {
          normal = {-normal.x(), -normal.y(), -normal.z()};
          result_.plane_offsets[i] = -result_.plane_offsets[i];
        }
      }
    });
    result_.stats = count_statuses(result_.status);
  }

  NormalOptions options_;
  detail::LocalPoints local_;
  std::vector<NormalStatus> cloud_status_;
  detail::SpatialSorter sorter_;
  detail::SortedPoints cloud_, queries_, wider_;
  detail::CellGrid grid_;
  detail::BlockTree tree_;
  NormalResult result_, cell_result_;
};

/// Normals of one scan: NormalEstimator::estimate() for callers without a stream of scans.
template <class Points, class Viewpoints, class Executor = SerialExecutor>
NormalResult estimate_normals(
    const Points& points,
    const Viewpoints& viewpoints,
    const NormalOptions& options = {},
    const Executor& executor = {}) {
  NormalEstimator estimator(options);
  return estimator.estimate(points, viewpoints, executor);
}

}  // namespace NVM_TARGET
}  // namespace nvm
