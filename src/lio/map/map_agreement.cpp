// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/map/map_agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "nvm/map/sighting.hpp"
#include "nvm/registration/plane.hpp"

namespace nvm::lio {

namespace {

constexpr std::size_t kMaxPoints = 150;
constexpr std::size_t kNeighbors = 8;
constexpr std::size_t kMinNeighbors = 5;
constexpr double kReach = 0.6;         // of a point's surface [m]
constexpr double kMaxDistance = 0.06;  // of a point from its surface [m]

/// Planes of the map around places.
class Surfaces {
 public:
  explicit Surfaces(const LioMap& map) : map_(map) {}

  /// Through the map's points within `reach` [m] of `place` that face as `normal` does; nothing
  /// when they are too few or no plane.
  std::optional<Plane> near(
      const Eigen::Vector3d& place, const Eigen::Vector3f& normal, double reach) {
    constexpr double kMaxDeviation = 0.05;  // [m]
    const std::size_t count =
        map_.nearest(place, normal, {kNeighbors, reach}, found_.data(), context_);
    if (count < kMinNeighbors) {
      return std::nullopt;
    }
    std::optional<Plane> plane = fit_plane(found_.data(), count);
    return plane && plane->deviation[0] <= kMaxDeviation ? plane : std::nullopt;
  }

 private:
  const LioMap& map_;
  LioMap::QueryContext context_;
  std::array<Neighbor, kNeighbors> found_;
};

/// Whether the beam from `from` to `to` goes through a surface of the map before it ends.
bool sees_through(Surfaces& surfaces, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double kStep = 0.2;        // [m]
  constexpr double kMargin = 0.5;      // to both ends [m]
  constexpr double kMaxLength = 30.0;  // [m]
  constexpr double kMinCosine = 0.3;   // a grazing beam may well go past
  const double length = std::min((to - from).norm(), kMaxLength);
  const Eigen::Vector3d beam = (to - from).normalized();
  const Eigen::Vector3f facing = (-beam).cast<float>();
  for (double s = kMargin; s < length - kMargin; s += kStep) {
    const Eigen::Vector3d place = from + s * beam;
    const std::optional<Plane> plane = surfaces.near(place, facing, kStep);
    if (!plane || std::abs(plane->normal.dot(beam)) < kMinCosine) {
      continue;
    }
    // Where the beam meets the plane: among its points, not beside them.
    const double ahead = plane->normal.dot(plane->centroid - place) / plane->normal.dot(beam);
    const Eigen::Vector3d hit = place + ahead * beam;
    if (std::abs(ahead) <= 0.5 * kStep && (hit - plane->centroid).norm() <= 0.5 * kStep) {
      return true;
    }
  }
  return false;
}

double distance_from(const Plane& plane, const Eigen::Vector3d& place) {
  return std::abs(plane.normal.dot(place - plane.centroid));
}

/// Calls `look(place, normal)`, both in the map, for kMaxPoints with normals at most.
template <typename Look>
void for_some(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan,
    const Look& look) {
  const std::size_t stride = points.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!is_sighting(normals[i])) {
      const Eigen::Vector3d normal = T_map_scan.linear() * normals[i].cast<double>();
      look(
          Eigen::Vector3d(T_map_scan * points[i].cast<double>()),
          Eigen::Vector3f(normal.cast<float>()));
    }
  }
}

}  // namespace

MapAgreement judge_agreement(
    const LioMap& map,
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan) {
  MapAgreement agreement;
  Surfaces surfaces(map);
  for_some(points, normals, T_map_scan, [&](const auto& place, const auto& normal) {
    const std::optional<Plane> plane = surfaces.near(place, normal, kReach);
    if (plane && distance_from(*plane, place) <= kMaxDistance) {
      ++agreement.agreeing;
    } else if (plane || sees_through(surfaces, T_map_scan.translation(), place)) {
      ++agreement.contradicting;
    } else {
      ++agreement.unmapped;
    }
  });
  return agreement;
}

double distance_from_map(
    const LioMap& map,
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan) {
  Surfaces surfaces(map);
  double sum_sq = 0.0;
  std::size_t count = 0;
  for_some(points, normals, T_map_scan, [&](const auto& place, const auto& normal) {
    const std::optional<Plane> plane = surfaces.near(place, normal, kReach);
    const double distance = plane ? distance_from(*plane, place) : kMaxDistance;
    sum_sq += std::pow(std::min(distance, kMaxDistance), 2);
    ++count;
  });
  return std::sqrt(sum_sq / static_cast<double>(std::max<std::size_t>(count, 1)));
}

}  // namespace nvm::lio
