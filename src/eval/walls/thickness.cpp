// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/thickness.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace nvm::eval {

namespace {

/// How far the points of `behind` lie behind the plane of `front` on average [m].
double mean_depth(const FaceFit& front, const FaceFit& behind) {
  double sum = 0.0;
  for (const Eigen::Vector3d& p : behind.points) {
    sum -= front.plane.distance(p);
  }
  return sum / static_cast<double>(behind.points.size());
}

double sq_standard_error(const FaceFit& face) {
  return face.spread * face.spread / static_cast<double>(face.points.size());
}

}  // namespace

std::optional<Thickness> measure_thickness(
    const SidedPoints& points,
    const std::array<OrientedPlane, 2>& start,
    const std::array<FaceFitOptions, 2>& options) {
  auto first = fit_face(points[0], start[0], options[0]);
  auto second = fit_face(points[1], start[1], options[1]);
  if (!first || !second) {
    return std::nullopt;
  }
  Thickness thickness;
  thickness.value = 0.5 * (mean_depth(*first, *second) + mean_depth(*second, *first));
  thickness.standard_error = std::sqrt(sq_standard_error(*first) + sq_standard_error(*second));
  thickness.faces = {std::move(*first), std::move(*second)};
  return thickness;
}

}  // namespace nvm::eval
