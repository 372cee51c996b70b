// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "nvm/core/executor.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/registration/align_options.hpp"
#include "nvm/registration/association.hpp"
#include "nvm/registration/normal_equations.hpp"
#include "nvm/registration/point_to_plane.hpp"
#include "nvm/registration/pose_solution.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Scan-to-map alignment: Gauss-Newton on the weighted point-to-plane residual of spec §4 with a
/// robust kernel, associated anew in each iteration. Works with any model of the map concept.
///
/// The result has the same bits for every executor and number of threads. Keeps its buffers, so
/// that aligning scan after scan allocates nothing; use one aligner per calling thread.
template <class Map>
class ScanAligner {
  static_assert(is_map_v<Map>, "nvm: this type does not model the map concept (map_concept.hpp)");

 public:
  /// Throws std::invalid_argument for bad options.
  explicit ScanAligner(const AlignOptions& options = {}) : options_(options) {
    options_.validate();
  }

  const AlignOptions& options() const { return options_; }

  /// Aligns `points` with their unit `normals` (ranges of equal length, scan frame; a zero normal
  /// stands for "unknown") to `map`, starting at `T_map_scan`. Non-finite points are counted as
  /// too_few_neighbors. Throws std::invalid_argument for unequal lengths or a start that is not
  /// rigid.
  template <class Points, class Normals, class Executor = SerialExecutor>
  AlignResult align(
      const Map& map,
      const Points& points,
      const Normals& normals,
      const Pose& T_map_scan,
      const Executor& executor = {}) {
    require_input(points, normals, T_map_scan);
    AlignResult result;
    result.T_map_scan = T_map_scan;
    while (result.iterations < options_.max_iterations) {
      const NormalEquations equations =
          linearize(map, points, normals, result.T_map_scan, executor);
      const PoseSolution solution = solve(equations, options_.min_observability);
      describe(equations, solution, result);
      if (equations.counts.valid < options_.min_residuals) {
        result.status = AlignStatus::kTooFewResiduals;
        result.T_map_scan = T_map_scan;
        return result;
      }
      result.T_map_scan = retract(result.T_map_scan, solution.step);
      ++result.iterations;
      if (is_small(solution.step)) {
        result.status = AlignStatus::kConverged;
        return result;
      }
    }
    result.status = AlignStatus::kMaxIterations;
    return result;
  }

  /// The linearised problem at `T_map_scan`; for callers with a solver of their own.
  template <class Points, class Normals, class Executor = SerialExecutor>
  NormalEquations linearize(
      const Map& map,
      const Points& points,
      const Normals& normals,
      const Pose& T_map_scan,
      const Executor& executor = {}) {
    const std::size_t size = points.size();
    const Eigen::Matrix3d R_map_scan = rotation_of(T_map_scan);
    const std::size_t blocks = (size + kBlock - 1) / kBlock;
    partial_sums_.assign(blocks, NormalEquations{});
    contexts_.resize(std::max(contexts_.size(), blocks));
    executor.for_blocks(size, kBlock, [&](std::size_t begin, std::size_t end) {
      NormalEquations& sum = partial_sums_[begin / kBlock];
      typename Map::QueryContext& context = contexts_[begin / kBlock];
      for (std::size_t i = begin; i < end; ++i) {
        const Eigen::Vector3d p_scan = position(points[i]);
        const Eigen::Vector3f n_map = (R_map_scan * position(normals[i])).template cast<float>();
        const Association association =
            associate(map, T_map_scan * p_scan, n_map, options_.association, context);
        sum.add(p_scan, R_map_scan, association, options_.kernel);
      }
    });
    NormalEquations total;
    for (const NormalEquations& sum : partial_sums_) {
      total += sum;
    }
    return total;
  }

 private:
  static constexpr std::size_t kBlock = 128;

  template <class Points, class Normals>
  static void require_input(const Points& points, const Normals& normals, const Pose& T_map_scan) {
    static_assert(is_point_range_v<Points>, "nvm: points must be a range of points");
    static_assert(is_point_range_v<Normals>, "nvm: normals must be a range of 3-vectors");
    if (static_cast<std::size_t>(points.size()) != static_cast<std::size_t>(normals.size())) {
      throw std::invalid_argument("nvm: align needs as many normals as points");
    }
    if (!is_rigid(T_map_scan)) {
      throw std::invalid_argument("nvm: align needs a rigid start pose");
    }
  }

  template <class Step>
  bool is_small(const Step& step) const {
    return step.template head<3>().norm() <= options_.converged_rotation &&
           step.template tail<3>().norm() <= options_.converged_translation;
  }

  void describe(
      const NormalEquations& equations, const PoseSolution& solution, AlignResult& result) const {
    result.counts = equations.counts;
    result.rms_distance = equations.rms_distance();
    result.cost = equations.truncated_cost(options_.association.max_plane_distance);
    result.information = equations.information;
    result.observability = solution.observability;
    result.degenerate_directions = solution.degenerate_directions;
  }

  AlignOptions options_;
  std::vector<NormalEquations> partial_sums_;         // one per block
  std::vector<typename Map::QueryContext> contexts_;  // one per block
};

}  // namespace NVM_TARGET
}  // namespace nvm
