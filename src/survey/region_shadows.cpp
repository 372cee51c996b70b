// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/region_shadows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>

namespace nvm::survey {

namespace {

constexpr double kMinShare = 0.6;  // of a shadow's patches that lie beside the same region
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

/// True when `region` could be the tail of the noise of `other`.
bool may_shade(const PlanarRegion& other, const PlanarRegion& region, double reach) {
  constexpr double kMinCosine = 0.95;
  return other.sums.count >= 2.0 * region.sums.count &&
         other.plane.normal.dot(region.plane.normal) > kMinCosine &&
         std::abs(other.plane.distance(region.sums.mean())) < reach;
}

/// True when most patches of `region`, of about 100 of them, lie beside one larger region.
bool is_shadow(
    const PatchGrid& grid,
    const std::vector<PlanarRegion>& regions,
    const std::vector<std::size_t>& owner,
    const PlanarRegion& region,
    double reach) {
  const std::size_t step = 1 + region.patches.size() / 100;
  const double share = static_cast<double>(step) / static_cast<double>(region.patches.size());
  std::map<std::size_t, double> shares;
  std::set<std::size_t> beside;
  for (std::size_t k = 0; k < region.patches.size(); k += step) {
    beside.clear();
    grid.for_each_near(region.patches[k], [&](std::uint32_t i) {
      if (owner[i] != kNone && may_shade(regions[owner[i]], region, reach)) {
        beside.insert(owner[i]);
      }
    });
    for (const std::size_t other : beside) {
      shares[other] += share;
    }
  }
  return std::any_of(
      shares.begin(), shares.end(), [](const auto& entry) { return entry.second > kMinShare; });
}

}  // namespace

void drop_shadows(const PatchGrid& grid, double noise, std::vector<PlanarRegion>& regions) {
  const double reach = std::max(0.02, 4.0 * noise);
  const std::vector<std::size_t> owner = owners(grid, regions);
  std::vector<PlanarRegion> kept;
  for (const PlanarRegion& region : regions) {
    if (!is_shadow(grid, regions, owner, region, reach)) {
      kept.push_back(region);
    }
  }
  regions = std::move(kept);
}

}  // namespace nvm::survey
