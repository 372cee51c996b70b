// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/deskew_watch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/printed.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/registration/plane.hpp"

namespace nvm::lio {

namespace {

/// Pose of the scan, then the share of deskewing.
constexpr int kUnknowns = 7;
using Row = Eigen::Matrix<double, kUnknowns, 1>;
using NormalMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// Through the map's points around `place` that face as `normal` does.
std::optional<Plane> plane_near(
    const LioMap& map,
    const Eigen::Vector3d& place,
    const Eigen::Vector3f& normal,
    LioMap::QueryContext& context) {
  constexpr std::size_t kNeighbors = 8;
  constexpr std::size_t kMinNeighbors = 5;
  constexpr double kReach = 0.6;          // [m]
  constexpr double kMaxDeviation = 0.05;  // [m]
  constexpr double kMinPlanarity = 0.2;
  std::array<Neighbor, kNeighbors> found;
  const std::size_t count = map.nearest(place, normal, {kNeighbors, kReach}, found.data(), context);
  if (count < kMinNeighbors) {
    return std::nullopt;
  }
  std::optional<Plane> plane = fit_plane(found.data(), count);
  const bool is_flat =
      plane && plane->deviation[0] <= kMaxDeviation && plane->planarity >= kMinPlanarity;
  return is_flat ? plane : std::nullopt;
}

struct Equations {
  NormalMatrix matrix = NormalMatrix::Zero();
  Row vector = Row::Zero();
  std::size_t count = 0;
};

/// Of distances of the keypoints from the map's planes, to first order around the pose and all of
/// deskewing. `motion` of the LiDAR.
Equations equations(
    const LioMap& map,
    const DeskewedKeypoints& keypoints,
    const Pose& T_map_lidar,
    const SweepMotion& motion) {
  constexpr std::size_t kMaxPoints = 150;
  constexpr double kSpread = 0.03;  // of residuals that count [m]
  const Eigen::Matrix3d R = T_map_lidar.linear();
  LioMap::QueryContext context;
  Equations equations;
  const std::size_t stride = keypoints.points.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < keypoints.points.size(); i += stride) {
    if (is_sighting(keypoints.normals[i])) {
      continue;
    }
    const Eigen::Vector3d p = keypoints.points[i].cast<double>();
    const Eigen::Vector3f n_map = R.cast<float>() * keypoints.normals[i];
    const auto plane = plane_near(map, T_map_lidar * p, n_map, context);
    if (!plane) {
      continue;
    }
    const Eigen::Vector3d n = R.transpose() * plane->normal;
    const double distance = plane->normal.dot(T_map_lidar * p - plane->centroid);
    const auto age = static_cast<double>(keypoints.ages[i]);
    Row h;
    h << n, p.cross(n), -age * n.dot(motion.velocity + motion.rate.cross(p));
    const double weight = 1.0 / (1.0 + distance * distance / (kSpread * kSpread));
    equations.matrix += weight * h * h.transpose();
    equations.vector += weight * distance * h;
    ++equations.count;
  }
  return equations;
}

}  // namespace

void DeskewWatch::add(
    const LioMap& map,
    const DeskewedKeypoints& keypoints,
    const Pose& T_map_body,
    const Pose& T_body_lidar,
    const SweepMotion& motion) {
  constexpr std::size_t kMaxScans = 100;
  constexpr std::size_t kFewest = 30;  // points
  constexpr double kMinTurn = 0.02;    // within the sweep [rad]
  const auto oldest = std::max_element(keypoints.ages.begin(), keypoints.ages.end());
  if (share_.count() >= kMaxScans || oldest == keypoints.ages.end() ||
      motion.rate.norm() * static_cast<double>(*oldest) < kMinTurn) {
    return;
  }
  const Eigen::Matrix3d R_lidar_body = T_body_lidar.linear().transpose();
  const SweepMotion of_lidar{
      R_lidar_body * (motion.velocity + motion.rate.cross(T_body_lidar.translation())),
      R_lidar_body * motion.rate};
  const auto [A, b, count] = equations(map, keypoints, T_map_body * T_body_lidar, of_lidar);
  // The pose is eliminated, whatever it is.
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> pose(A.topLeftCorner<6, 6>());
  const Eigen::Matrix<double, 6, 1> a = pose.solve(A.topRightCorner<6, 1>());
  const double weight = A(6, 6) - a.dot(A.topRightCorner<6, 1>());
  const double share = 1.0 - (b[6] - a.dot(b.head<6>())) / weight;
  if (count >= kFewest && weight > 0.0 && std::isfinite(share)) {
    share_.add(share, weight);
  }
}

// On worlds of two simulators with right times, with an IMU and without, the shares of runs lay
// between 0.977 and 1.006. What was deskewed twice or by half began far off, and came to 0.9 and
// 1.2 as the map filled with such scans.
std::string DeskewWatch::finding() const {
  constexpr std::size_t kFewest = 10;
  constexpr double kMinError = 0.06;
  constexpr double kDeviations = 5.0;
  if (share_.count() < kFewest) {
    return "";
  }
  const double share = share_.mean();
  const double deviation = std::sqrt(share_.variance() / static_cast<double>(share_.count()));
  if (std::abs(share - 1.0) < std::max(kMinError, kDeviations * deviation)) {
    return "";
  }
  const std::string seen = printed(
      "the points do not lie where their times put them: %zu scans that turn fit the map better "
      "when deskewing moves their points %s: ",
      share_.count(),
      share < 1.0 ? "less" : "more");
  return seen +
         (share < 1.0
              ? "the driver has deskewed them already (set input.point_time_field=none), or their "
                "times span too much or run backwards"
              : "their times span too little of the sweep (check input.point_time_unit and how the "
                "driver dates points)") +
         "; what is said of the IMU may come from it";
}

}  // namespace nvm::lio
