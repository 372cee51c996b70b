// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/region_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace nvm::survey {

namespace {

constexpr double kMinPatchCosine = 0.87;  // 30 degrees, of a patch to the plane
constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

class Grower {
 public:
  Grower(const PatchGrid& grid, const GrowthGates& gates)
      : grid_(grid),
        gates_(gates),
        region_of_(grid.patches().size(), kFree),
        visit_of_(grid.patches().size(), 0) {}

  std::optional<PlanarRegion> grow(std::uint32_t seed) {
    if (region_of_[seed] != kFree) {
      return std::nullopt;
    }
    auto plane = seed_plane(seed);
    if (!plane) {
      return std::nullopt;
    }
    const PlanarRegion first = gather(seed, *plane, true);
    plane = fit_plane(first.sums, first.plane.normal);
    if (first.patches.size() < kMinPatches || !plane) {
      return std::nullopt;
    }
    PlanarRegion region = gather(seed, *plane, false);
    if (region.patches.size() < kMinPatches) {
      return std::nullopt;
    }
    for (const std::uint32_t patch : region.patches) {
      region_of_[patch] = seed;
    }
    return region;
  }

 private:
  static constexpr std::size_t kMinPatches = 5;

  bool fits(const Patch& patch, const eval::OrientedPlane& plane, double gate) const {
    return patch.normal.dot(plane.normal) > kMinPatchCosine &&
           std::abs(plane.distance(patch.mean)) < gate;
  }

  /// The plane of the seed and what is around it.
  std::optional<eval::OrientedPlane> seed_plane(std::uint32_t seed) const {
    const Patch& center = grid_.patches()[seed];
    const eval::OrientedPlane rough{center.normal, center.normal.dot(center.mean)};
    PlaneSums sums;
    grid_.for_each_near(seed, [&](std::uint32_t i) {
      if (region_of_[i] == kFree && fits(grid_.patches()[i], rough, 2.0 * gates_.growing)) {
        sums += grid_.patches()[i].sums;
      }
    });
    const auto plane = fit_plane(sums, center.normal);
    return plane && fits(center, *plane, gates_.growing) ? plane : std::nullopt;
  }

  PlanarRegion gather(std::uint32_t seed, const eval::OrientedPlane& start, bool follows) {
    constexpr double kGrowth = 1.3;  // of the region between two fits
    ++visit_;
    PlanarRegion region;
    region.plane = start;
    region.patches.push_back(seed);
    visit_of_[seed] = visit_;
    double next_fit = 60.0;  // [points]
    for (std::size_t i = 0; i < region.patches.size(); ++i) {
      region.sums += grid_.patches()[region.patches[i]].sums;
      if (follows && region.sums.count >= next_fit) {
        region.plane = fit_plane(region.sums, region.plane.normal).value_or(region.plane);
        next_fit = kGrowth * region.sums.count;
      }
      grid_.for_each_near(region.patches[i], [&](std::uint32_t j) {
        if (visit_of_[j] != visit_ && region_of_[j] == kFree &&
            fits(grid_.patches()[j], region.plane, follows ? gates_.growing : gates_.final)) {
          visit_of_[j] = visit_;
          region.patches.push_back(j);
        }
      });
    }
    return region;
  }

  const PatchGrid& grid_;
  GrowthGates gates_;
  std::vector<std::uint32_t> region_of_;
  std::vector<std::uint32_t> visit_of_;
  std::uint32_t visit_ = 0;
};

}  // namespace

std::vector<PlanarRegion> grow_regions(const PatchGrid& grid, const GrowthGates& gates) {
  std::vector<std::pair<std::int64_t, std::uint32_t>> seeds;  // most points first
  for (std::uint32_t i = 0; i < grid.patches().size(); ++i) {
    const Patch& patch = grid.patches()[i];
    seeds.emplace_back(-static_cast<std::int64_t>(patch.end - patch.begin), i);
  }
  std::sort(seeds.begin(), seeds.end());
  Grower grower(grid, gates);
  std::vector<PlanarRegion> regions;
  for (const auto& [count, seed] : seeds) {
    if (auto region = grower.grow(seed)) {
      regions.push_back(std::move(*region));
    }
  }
  return regions;
}

}  // namespace nvm::survey
