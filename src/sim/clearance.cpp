// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/clearance.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace nvm::sim {
namespace {

constexpr double kInterval = 0.1;      ///< between the checked places [s]
constexpr std::size_t kRayCount = 64;  ///< from each of them

/// Directions spread evenly over the sphere (Fibonacci lattice).
std::vector<Eigen::Vector3d> even_directions(std::size_t count) {
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double radius = std::sqrt(1.0 - z * z);
    const double azimuth = golden_angle * static_cast<double>(i);
    directions.emplace_back(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
  }
  return directions;
}

[[noreturn]] void fail(
    const std::string& obstacle, double time, const Eigen::Vector3d& p, double clearance) {
  char text[160];
  std::snprintf(
      text,
      sizeof text,
      " is within %.2f m of the sensor at %.1f s, at (%.2f, %.2f, %.2f)",
      clearance,
      time,
      p.x(),
      p.y(),
      p.z());
  throw std::runtime_error("the route is blocked: \"" + obstacle + "\"" + text);
}

}  // namespace

void check_clearance(
    const Scene& scene, const RayCaster& rays, const Motion& motion, double clearance) {
  const std::vector<Eigen::Vector3d> directions = even_directions(kRayCount);
  Eigen::Vector3d previous = motion.pose(0.0).translation();
  const auto intervals = static_cast<std::size_t>(motion.duration() / kInterval);
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double time = static_cast<double>(i) * kInterval;
    const Eigen::Vector3d p = motion.pose(time).translation();
    for (const Eigen::Vector3d& direction : directions) {
      if (const auto hit = rays.cast(p, direction, clearance)) {
        fail(object_name(scene, hit->surface.object), time, p, clearance);
      }
    }
    const double step = (p - previous).norm();
    if (step > 1e-6) {
      if (const auto hit = rays.cast(previous, (p - previous) / step, step)) {
        fail(object_name(scene, hit->surface.object), time, p, clearance);
      }
    }
    previous = p;
  }
}

}  // namespace nvm::sim
