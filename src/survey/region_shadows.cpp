// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/region_shadows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>

namespace nvm::survey {

namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The region that each patch belongs to.
std::vector<std::size_t> owners(const PatchGrid& grid, const std::vector<PlanarRegion>& regions) {
  std::vector<std::size_t> owner(grid.patches().size(), kNone);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (const std::uint32_t patch : regions[i].patches) {
      owner[patch] = i;
    }
  }
  return owner;
}

/// The share of the patches of `region`, of about 100 of them, that has one of each other region
/// beside it.
std::map<std::size_t, double> neighbor_shares(
    const PatchGrid& grid, const PlanarRegion& region, const std::vector<std::size_t>& owner) {
  const std::size_t step = 1 + region.patches.size() / 100;
  const double share = static_cast<double>(step) / static_cast<double>(region.patches.size());
  std::map<std::size_t, double> shares;
  std::vector<std::size_t> beside;
  for (std::size_t k = 0; k < region.patches.size(); k += step) {
    const std::uint32_t patch = region.patches[k];
    beside.clear();
    grid.for_each_near(patch, [&](std::uint32_t i) {
      if (owner[i] != kNone && owner[i] != owner[patch]) {
        beside.push_back(owner[i]);
      }
    });
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const std::size_t other : beside) {
      shares[other] += share;
    }
  }
  return shares;
}

}  // namespace

void drop_shadows(const PatchGrid& grid, double noise, std::vector<PlanarRegion>& regions) {
  constexpr double kMinCosine = 0.95;
  constexpr double kMinShare = 0.6;
  const double reach = std::max(0.02, 4.0 * noise);
  const std::vector<std::size_t> owner = owners(grid, regions);
  const auto is_shadow = [&](const PlanarRegion& region) {
    for (const auto& [index, share] : neighbor_shares(grid, region, owner)) {
      const PlanarRegion& other = regions[index];
      if (share > kMinShare && other.sums.count >= 2.0 * region.sums.count &&
          other.plane.normal.dot(region.plane.normal) > kMinCosine &&
          std::abs(other.plane.distance(region.sums.mean())) < reach) {
        return true;
      }
    }
    return false;
  };
  std::vector<PlanarRegion> kept;
  for (const PlanarRegion& region : regions) {
    if (!is_shadow(region)) {
      kept.push_back(region);
    }
  }
  regions = std::move(kept);
}

}  // namespace nvm::survey
