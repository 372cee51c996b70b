// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/change/changed_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>

namespace nvm::lio {

namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Eigen::Vector3d& position, double size) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    cell[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::floor(position[axis] / size));
  }
  return cell;
}

/// Sets of numbers, of which each is named by one of its own.
class Sets {
 public:
  explicit Sets(std::size_t size) : parents_(size) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }

  std::size_t find(std::size_t member) {
    while (parents_[member] != member) {
      parents_[member] = parents_[parents_[member]];
      member = parents_[member];
    }
    return member;
  }

  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parents_;
};

/// Joins what lies in one cell of `size` [m] or in two that touch.
Sets joined(const std::vector<ChangedSurface>& surfaces, double size) {
  Sets sets(surfaces.size());
  std::map<Cell, std::size_t> first;  // surface in each cell
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto [entry, is_new] = first.emplace(cell_of(surfaces[i].position, size), i);
    sets.join(entry->second, i);
    constexpr int kAround = 27;
    for (int k = 0; is_new && k < kAround; ++k) {
      const Cell& cell = entry->first;
      const auto near =
          first.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      if (near != first.end()) {
        sets.join(near->second, i);
      }
    }
  }
  return sets;
}

}  // namespace

std::vector<ChangedPlace> changed_places(const std::vector<ChangedSurface>& surfaces) {
  constexpr double kTogether = 0.15;   // [m]
  constexpr double kLeastArea = 0.05;  // [m^2]
  Sets sets = joined(surfaces, kTogether);
  std::map<std::size_t, ChangedPlace> by_set;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    ChangedPlace& place = by_set[sets.find(i)];
    place.surfaces.push_back(surfaces[i]);
    place.area += surfaces[i].area;
    place.center += surfaces[i].position;
  }
  std::vector<ChangedPlace> places;
  for (auto& [set, place] : by_set) {
    if (place.area >= kLeastArea) {
      place.center /= static_cast<double>(place.surfaces.size());
      places.push_back(std::move(place));
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const ChangedPlace& a, const ChangedPlace& b) {
    return a.area > b.area;
  });
  return places;
}

}  // namespace nvm::lio
