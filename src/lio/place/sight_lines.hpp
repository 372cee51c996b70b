// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nvm::lio {

/// Points as seen from the origin, in the order of their directions, so that those in about one
/// direction are found at once.
class SightLines {
 public:
  /// Of `points` [m], those farther than `min_range` [m] for which `is_of_use(index)`.
  template <class Predicate>
  SightLines(
      const std::vector<Eigen::Vector3f>& points, float min_range, const Predicate& is_of_use) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float range = points[i].norm();
      if (range > min_range && is_of_use(i)) {
        add(points[i] / range, static_cast<std::uint32_t>(i));
      }
    }
    sort();
  }

  /// Calls visit(k) for the places in indices() of the points whose direction is within `angle`
  /// [rad] of the unit vector `direction`, and of some whose is not.
  template <class Visitor>
  void for_each_near(const Eigen::Vector3f& direction, float angle, const Visitor& visit) const {
    const float reach = angle / kCell;
    const float flat = std::max(0.1F, std::hypot(direction.x(), direction.y()));
    const int row = row_of(direction);
    const int column = column_of(direction);
    const int rows = static_cast<int>(reach) + 1;
    const int columns = static_cast<int>(reach / flat) + 1;
    for (int i = std::max(0, row - rows); i <= std::min(kRows - 1, row + rows); ++i) {
      for (int j = column - columns; j <= column + columns; ++j) {
        const std::size_t cell = cell_at(i, j);
        for (std::uint32_t k = cells_[cell]; k < cells_[cell + 1]; ++k) {
          visit(std::size_t{k});
        }
      }
    }
  }

  /// Of the points, in the order of their directions.
  const std::vector<std::uint32_t>& indices() const { return indices_; }

 private:
  static constexpr float kPi = 3.14159265F;
  static constexpr int kRows = 120;  // of directions, from pole to pole
  static constexpr int kColumns = 2 * kRows;
  static constexpr float kCell = kPi / static_cast<float>(kRows);  // [rad]

  static std::size_t cell_at(int row, int column) {
    return static_cast<std::size_t>(row * kColumns + (column + kColumns) % kColumns);
  }
  static int row_of(const Eigen::Vector3f& direction);
  static int column_of(const Eigen::Vector3f& direction);

  void add(const Eigen::Vector3f& direction, std::uint32_t index);
  void sort();

  std::vector<std::uint32_t>
      cells_;  ///< where the points of each begin; of each point until sort()
  std::vector<std::uint32_t> indices_;
};

}  // namespace nvm::lio
