// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "survey/plane_frame.hpp"

namespace nvm::survey {

/// Which square cells of a plane are covered. Cells outside are not.
class Mask {
 public:
  Mask() = default;

  /// Empty cells of edge `cell` [m] over `box`, and `margin` more of them on each side. More than
  /// 4 million cells are coarsened.
  Mask(const PlaneBox& box, double cell, int margin);

  /// Empty, with the cells of `like`.
  static Mask like(const Mask& like);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }

  double u(double column) const { return min_u_ + column * cell_; }
  double v(double row) const { return min_v_ + row * cell_; }
  int column(double at_u) const { return static_cast<int>(std::floor((at_u - min_u_) / cell_)); }
  int row(double at_v) const { return static_cast<int>(std::floor((at_v - min_v_) / cell_)); }

  bool get(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
           cells_[index(column, row)] != 0;
  }
  /// Does nothing outside.
  void set(int column, int row, bool value = true) {
    if (column >= 0 && row >= 0 && column < columns_ && row < rows_) {
      cells_[index(column, row)] = value ? 1 : 0;
    }
  }
  bool covers(double at_u, double at_v) const { return get(column(at_u), row(at_v)); }

  std::size_t count() const;
  double area() const { return static_cast<double>(count()) * cell_ * cell_; }

  /// Calls `visit(column, row)` for the covered cells.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (cells_[index(column, row)] != 0) {
          visit(column, row);
        }
      }
    }
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  double min_u_ = 0.0;
  double min_v_ = 0.0;
  double cell_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> cells_;
};

/// Cells that have a covered one within `radius` cells, diagonally too.
Mask dilated(const Mask& mask, int radius);

/// Cells all of whose neighbours within `radius` cells are covered.
Mask eroded(const Mask& mask, int radius);

/// `mask` with gaps of up to 2 `radius` cells closed. Needs a margin of `radius` cells.
Mask closed(const Mask& mask, int radius);

/// `mask` with uncovered runs of at most `length` cells between covered ones of a row filled.
Mask closed_along_rows(const Mask& mask, int length);

/// `mask` with what it encloses.
Mask filled(const Mask& mask);

/// Covered in both, or in the first and not in the second; of equal cells.
Mask intersection(const Mask& a, const Mask& b);
Mask difference(const Mask& a, const Mask& b);

/// The pieces of `mask` that touch along edges and cover `min_area` [m²] or more, each as a mask,
/// largest first.
std::vector<Mask> components(const Mask& mask, double min_area);

}  // namespace nvm::survey
