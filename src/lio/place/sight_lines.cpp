// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/sight_lines.hpp"

#include <numeric>

namespace nvm::lio {

int SightLines::row_of(const Eigen::Vector3f& direction) {
  const float elevation = std::asin(std::clamp(direction.z(), -1.0F, 1.0F));
  return std::clamp(static_cast<int>((elevation + 0.5F * kPi) / kCell), 0, kRows - 1);
}

int SightLines::column_of(const Eigen::Vector3f& direction) {
  const float azimuth = std::atan2(direction.y(), direction.x());
  return std::clamp(static_cast<int>((azimuth + kPi) / kCell), 0, kColumns - 1);
}

void SightLines::add(const Eigen::Vector3f& direction, std::uint32_t index) {
  cells_.push_back(static_cast<std::uint32_t>(cell_at(row_of(direction), column_of(direction))));
  indices_.push_back(index);
}

// Counting sort: points of one cell keep their order.
void SightLines::sort() {
  const std::vector<std::uint32_t> cell_of = std::move(cells_);
  const std::vector<std::uint32_t> unsorted = std::move(indices_);
  cells_.assign(static_cast<std::size_t>(kRows * kColumns) + 1, 0);
  for (const std::uint32_t cell : cell_of) {
    ++cells_[cell + 1];
  }
  std::partial_sum(cells_.begin(), cells_.end(), cells_.begin());
  std::vector<std::uint32_t> next(cells_.begin(), cells_.end() - 1);
  indices_.resize(unsorted.size());
  for (std::size_t i = 0; i < unsorted.size(); ++i) {
    indices_[next[cell_of[i]]++] = unsorted[i];
  }
}

}  // namespace nvm::lio
