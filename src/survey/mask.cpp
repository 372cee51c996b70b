// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/mask.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace nvm::survey {

namespace {

/// The maximum of each cell's neighbours within `radius` along one axis.
Mask dilated_along(const Mask& mask, int radius, bool along_rows) {
  Mask result = Mask::like(mask);
  const int lines = along_rows ? mask.rows() : mask.columns();
  const int length = along_rows ? mask.columns() : mask.rows();
  for (int line = 0; line < lines; ++line) {
    int until = -1;  // covered up to here
    int filled = 0;  // the next cell that is not yet decided
    for (int i = 0; i < length; ++i) {
      if (along_rows ? mask.get(i, line) : mask.get(line, i)) {
        until = std::min(i + radius, length - 1);
        filled = std::max(filled, i - radius);
        for (; filled <= until; ++filled) {
          along_rows ? result.set(filled, line) : result.set(line, filled);
        }
      }
    }
  }
  return result;
}

Mask complement(const Mask& mask) {
  Mask result = Mask::like(mask);
  for (int row = 0; row < mask.rows(); ++row) {
    for (int column = 0; column < mask.columns(); ++column) {
      result.set(column, row, !mask.get(column, row));
    }
  }
  return result;
}

using Cells = std::vector<std::pair<int, int>>;

/// Moves the component around (column, row) from `rest` to the result.
Cells take_component(Mask& rest, int column, int row) {
  Cells component{{column, row}};
  rest.set(column, row, false);
  for (std::size_t i = 0; i < component.size(); ++i) {
    const auto [c, r] = component[i];
    constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& step : kSteps) {
      if (rest.get(c + step[0], r + step[1])) {
        rest.set(c + step[0], r + step[1], false);
        component.emplace_back(c + step[0], r + step[1]);
      }
    }
  }
  return component;
}

}  // namespace

Mask::Mask(const PlaneBox& box, double cell, int margin) : cell_(cell) {
  constexpr double kMostCells = 4e6;
  const double width = std::max(box.width(), 0.0);
  const double height = std::max(box.height(), 0.0);
  cell_ = std::max(cell_, std::sqrt(width * height / kMostCells));
  cell_ = std::max(cell_, std::max(width, height) / kMostCells);
  min_u_ = box.min_u - margin * cell_;
  min_v_ = box.min_v - margin * cell_;
  columns_ = static_cast<int>(width / cell_) + 1 + 2 * margin;
  rows_ = static_cast<int>(height / cell_) + 1 + 2 * margin;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

Mask Mask::like(const Mask& like) {
  Mask mask = like;
  std::fill(mask.cells_.begin(), mask.cells_.end(), std::uint8_t{0});
  return mask;
}

std::size_t Mask::count() const {
  return static_cast<std::size_t>(std::count(cells_.begin(), cells_.end(), std::uint8_t{1}));
}

Mask dilated(const Mask& mask, int radius) {
  return dilated_along(dilated_along(mask, radius, true), radius, false);
}

Mask eroded(const Mask& mask, int radius) {
  Mask result = complement(dilated(complement(mask), radius));
  for (int row = 0; row < mask.rows(); ++row) {  // what is outside is not covered
    for (int column = 0; column < mask.columns(); ++column) {
      if (std::min(column, row) < radius || column >= mask.columns() - radius ||
          row >= mask.rows() - radius) {
        result.set(column, row, false);
      }
    }
  }
  return result;
}

Mask closed(const Mask& mask, int radius) { return eroded(dilated(mask, radius), radius); }

Mask closed_along_rows(const Mask& mask, int length) {
  Mask result = mask;
  for (int row = 0; row < mask.rows(); ++row) {
    int last = -1;
    for (int column = 0; column < mask.columns(); ++column) {
      if (!mask.get(column, row)) {
        continue;
      }
      if (last >= 0 && column - last - 1 <= length) {
        for (int fill = last + 1; fill < column; ++fill) {
          result.set(fill, row);
        }
      }
      last = column;
    }
  }
  return result;
}

Mask filled(const Mask& mask) {
  const auto is_inside = [&mask](const std::pair<int, int>& cell) {
    const auto& [column, row] = cell;
    return column > 0 && row > 0 && column < mask.columns() - 1 && row < mask.rows() - 1;
  };
  Mask result = mask;
  Mask rest = complement(mask);
  const Mask empty = rest;
  empty.for_each([&](int column, int row) {
    if (!rest.get(column, row)) {
      return;
    }
    const Cells hole = take_component(rest, column, row);
    if (std::all_of(hole.begin(), hole.end(), is_inside)) {
      for (const auto& [c, r] : hole) {
        result.set(c, r);
      }
    }
  });
  return result;
}

Mask intersection(const Mask& a, const Mask& b) {
  Mask result = Mask::like(a);
  a.for_each([&](int column, int row) { result.set(column, row, b.get(column, row)); });
  return result;
}

Mask difference(const Mask& a, const Mask& b) {
  Mask result = Mask::like(a);
  a.for_each([&](int column, int row) { result.set(column, row, !b.get(column, row)); });
  return result;
}

std::vector<Mask> components(const Mask& mask, double min_area) {
  std::vector<Cells> found;
  Mask rest = mask;
  mask.for_each([&](int column, int row) {
    if (rest.get(column, row)) {
      Cells component = take_component(rest, column, row);
      if (static_cast<double>(component.size()) * mask.cell() * mask.cell() >= min_area) {
        found.push_back(std::move(component));
      }
    }
  });
  std::stable_sort(found.begin(), found.end(), [](const Cells& a, const Cells& b) {
    return a.size() > b.size();
  });
  std::vector<Mask> result;
  for (const Cells& component : found) {
    result.push_back(Mask::like(mask));
    for (const auto& [column, row] : component) {
      result.back().set(column, row);
    }
  }
  return result;
}

}  // namespace nvm::survey
