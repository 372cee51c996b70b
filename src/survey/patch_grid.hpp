// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/result/map_cloud.hpp"
#include "survey/plane_sums.hpp"

namespace nvm::survey {

/// The points with normals that a survey works on.
struct SurveyCloud {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of `positions` in the map's frame [m]
  std::vector<Eigen::Vector3d> positions;            ///< relative to `origin` [m]
  std::vector<Eigen::Vector3f> normals;              ///< unit vectors
  std::size_t left_out = 0;  ///< points of the map without a position, without a normal, or more
                             ///< than 50 km from the middle
  double rounding = 0.0;     ///< between neighbours of the largest coordinate, when all are float32
                             ///< numbers; 0 when they are finer [m]
};

/// The usable points of `cloud`, in an order of their own. Throws std::invalid_argument when none
/// has a normal.
SurveyCloud survey_cloud(const io::MapCloud& cloud);

/// Points of one cell that look the same way and lie on one plane.
struct Patch {
  std::uint32_t cell = 0;   ///< index of its cell
  std::uint32_t begin = 0;  ///< its points: PatchGrid::order[begin, end)
  std::uint32_t end = 0;
  PlaneSums sums;
  Eigen::Vector3d mean;    ///< [m]
  Eigen::Vector3d normal;  ///< mean of the points' normals, unit length
};

/// The patches of a cloud in cubic cells, and which cells are neighbours.
class PatchGrid {
 public:
  /// `size`: edge of the cells [m].
  PatchGrid(const SurveyCloud& cloud, double size);

  const std::vector<Patch>& patches() const { return patches_; }
  double size() const { return size_; }

  /// Indices of the points, patch by patch.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Median RMS distance of the points of a patch to its own plane, times what a fit to so few
  /// points hides [m]: the noise of the map's points.
  double noise() const;

  /// Calls `visit(index)` for the patches in the 27 cells around that of `patch`, itself included.
  template <class Visit>
  void for_each_near(std::uint32_t patch, const Visit& visit) const {
    const std::uint32_t cell = patches_[patch].cell;
    for (int row = 0; row < kRows; ++row) {
      const RowSpan& span = rows_[cell][static_cast<std::size_t>(row)];
      for (std::uint32_t i = first_patch_[span.begin]; i < first_patch_[span.end]; ++i) {
        visit(i);
      }
    }
  }

 private:
  static constexpr int kRows = 9;
  struct RowSpan {
    std::uint32_t begin = 0;  ///< of cells: three at most, next to each other along x
    std::uint32_t end = 0;
  };

  void sort_points(const SurveyCloud& cloud);
  void add_patches(const SurveyCloud& cloud, std::size_t begin, std::size_t end);
  void find_rows();

  double size_;
  std::vector<std::uint64_t> keys_;  ///< of the cells, ascending
  std::vector<std::uint64_t> point_keys_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> first_patch_;  ///< of each cell, and the number of patches
  std::vector<std::array<RowSpan, kRows>> rows_;
  std::vector<Patch> patches_;
};

}  // namespace nvm::survey
