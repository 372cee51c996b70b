// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/face.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/median.hpp"

namespace nvm::survey {

namespace {

constexpr int kClosing = 2;  // cells; gaps of up to 0.4 m are no openings

std::vector<std::uint32_t> points_of(const PatchGrid& grid, const PlanarRegion& region) {
  std::vector<std::uint32_t> points;
  points.reserve(static_cast<std::size_t>(region.sums.count));
  for (const std::uint32_t patch : region.patches) {
    for (std::uint32_t i = grid.patches()[patch].begin; i < grid.patches()[patch].end; ++i) {
      points.push_back(grid.order()[i]);
    }
  }
  return points;
}

/// Four robust standard deviations of the points' distances to `plane`, at least 5 mm; from at most
/// 4000 points at even steps.
double gate_of(
    const SurveyCloud& cloud,
    const std::vector<std::uint32_t>& points,
    const eval::OrientedPlane& plane) {
  constexpr double kDeviationPerMedian = 1.4826;
  constexpr double kMinGate = 0.005;
  const std::size_t step = 1 + points.size() / 4000;
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size(); i += step) {
    distances.push_back(std::abs(plane.distance(cloud.positions[points[i]])));
  }
  return std::max(kMinGate, 4.0 * kDeviationPerMedian * median(std::move(distances)));
}

/// Fits the plane of `face` to those of `all` that lie on it.
bool refine(const SurveyCloud& cloud, const std::vector<std::uint32_t>& all, Face& face) {
  constexpr int kIterations = 3;
  constexpr std::size_t kMinPoints = 15;
  for (int i = 0; i < kIterations; ++i) {
    const double gate = gate_of(cloud, all, face.plane);
    PlaneSums sums;
    face.points.clear();
    for (const std::uint32_t point : all) {
      if (std::abs(face.plane.distance(cloud.positions[point])) <= gate) {
        sums.add(cloud.positions[point]);
        face.points.push_back(point);
      }
    }
    const auto plane = fit_plane(sums, face.plane.normal);
    if (face.points.size() < kMinPoints || !plane) {
      return false;
    }
    face.plane = *plane;
    face.rms = rms_distance(sums, face.plane);
  }
  return true;
}

}  // namespace

std::optional<Face> make_face(
    const SurveyCloud& cloud,
    const PatchGrid& grid,
    const PlanarRegion& region,
    const Directions& directions,
    double cell) {
  Face face;
  face.plane = region.plane;
  if (!refine(cloud, points_of(grid, region), face)) {
    return std::nullopt;
  }
  face.frame = plane_frame(face.plane, region.sums.mean(), directions.along, directions.up);
  for (const std::uint32_t i : face.points) {
    const Eigen::Vector3d& p = cloud.positions[i];
    face.box.extend(face.frame.coordinate_u(p), face.frame.coordinate_v(p));
  }
  Mask mask(face.box, cell, kClosing + 1);
  for (const std::uint32_t i : face.points) {
    const Eigen::Vector3d& p = cloud.positions[i];
    mask.set(mask.column(face.frame.coordinate_u(p)), mask.row(face.frame.coordinate_v(p)));
  }
  face.seen = closed(mask, kClosing);
  return face;
}

}  // namespace nvm::survey
