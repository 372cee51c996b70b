// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/coplanar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "survey/plane_frame.hpp"

namespace nvm::survey {

namespace {

constexpr double kMinRegionCosine = 0.99;  // 8 degrees: small regions know their direction badly

/// A region with what the comparisons need.
struct Candidate {
  PlanarRegion region;
  Eigen::Vector3d mean;
  PlaneFrame frame;
  PlaneBox box;  ///< in `frame`
  bool is_taken = false;
};

PlaneBox box_of(const PatchGrid& grid, const PlanarRegion& region, const PlaneFrame& frame) {
  const double half = 0.5 * grid.size();
  PlaneBox box;
  for (const std::uint32_t patch : region.patches) {
    const Eigen::Vector3d& p = grid.patches()[patch].mean;
    const double u = frame.coordinate_u(p);
    const double v = frame.coordinate_v(p);
    box.extend(u - half, v - half);
    box.extend(u + half, v + half);
  }
  return box;
}

void update(const PatchGrid& grid, Candidate& candidate) {
  PlanarRegion& region = candidate.region;
  region.plane = fit_plane(region.sums, region.plane.normal).value_or(region.plane);
  candidate.mean = region.sums.mean();
  const bool is_level = std::abs(region.plane.normal.z()) > 0.9;
  const Eigen::Vector3d up = is_level ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d along = is_level ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  candidate.frame = plane_frame(region.plane, candidate.mean, along, up);
  candidate.box = box_of(grid, region, candidate.frame);
}

/// What tells most regions off a plane at once, close together in memory.
struct Outlook {
  Eigen::Vector3d normal;
  Eigen::Vector3d mean;

  bool may_lie_on(const eval::OrientedPlane& plane, double max_offset) const {
    return plane.normal.dot(normal) >= kMinRegionCosine &&
           std::abs(plane.distance(mean)) <= max_offset;
  }
};

/// True when `small` lies on the plane of `large`: one plane fits both as well as one each.
bool lies_on(const Candidate& large, const Candidate& small, double max_misfit) {
  PlaneSums both = large.region.sums;
  both += small.region.sums;
  const auto joint = fit_plane(both, large.region.plane.normal);
  const auto fits = [&](const PlanarRegion& region) {
    return rms_distance(region.sums, *joint) <
           std::hypot(rms_distance(region.sums, region.plane), max_misfit);
  };
  return joint && fits(large.region) && fits(small.region);
}

}  // namespace

std::vector<PlanarRegion> join_coplanar(
    const PatchGrid& grid, std::vector<PlanarRegion> regions, const JoinLimits& limits) {
  std::stable_sort(regions.begin(), regions.end(), [](const auto& a, const auto& b) {
    return a.sums.count > b.sums.count;
  });
  std::vector<Candidate> candidates(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    candidates[i].region = std::move(regions[i]);
    update(grid, candidates[i]);
  }
  const double max_offset = 0.002 + limits.noise;
  std::vector<Outlook> outlooks;
  for (const Candidate& candidate : candidates) {
    outlooks.push_back({candidate.region.plane.normal, candidate.mean});
  }
  std::vector<PlanarRegion> joined;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& large = candidates[i];
    if (large.is_taken) {
      continue;
    }
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (std::size_t j = i + 1; j < candidates.size(); ++j) {
        Candidate& small = candidates[j];
        if (outlooks[j].may_lie_on(large.region.plane, max_offset) && !small.is_taken &&
            lies_on(large, small, max_offset) &&
            large.box.gap(box_in(large.frame, small.frame, small.box)) <= limits.max_gap) {
          small.is_taken = true;
          large.region.sums += small.region.sums;
          large.region.patches.insert(
              large.region.patches.end(), small.region.patches.begin(), small.region.patches.end());
          update(grid, large);
          has_grown = true;
        }
      }
    }
    joined.push_back(std::move(large.region));
  }
  return joined;
}

}  // namespace nvm::survey
