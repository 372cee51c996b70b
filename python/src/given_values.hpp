// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "nvm/map/point_values.hpp"

namespace nvm::python {

/// What points carry beside, of arrays of as many rows as there are points, or None: a range of
/// PointValues.
class GivenValues {
 public:
  /// Throws ValueError for a column that the map does not keep, for another number of rows, and for
  /// what the column cannot hold.
  GivenValues(
      nb::handle intensity,
      nb::handle time,
      nb::handle color,
      nb::handle label,
      const MapColumns& columns,
      std::size_t size);

  std::size_t size() const { return size_; }
  PointValues operator[](std::size_t i) const;

 private:
  std::size_t size_;
  std::optional<Numbers> intensity_;
  std::optional<Numbers> time_;
  std::optional<Vectors> color_;
  std::optional<Numbers> label_;
};

/// One column of the points of a map, (N,), or (N, 3) of colours. Throws ValueError for a name that
/// is not among `columns`.
nb::object column_array(
    const std::vector<PointValues>& values, const MapColumns& columns, const std::string& name);

}  // namespace nvm::python
