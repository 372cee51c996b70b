// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "nvm/map/sighting.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::test {

/// Answers the queries of a VoxelMap from nothing but its points, by brute force and in double
/// precision.
class MapOracle {
 public:
  struct Candidate {
    double sq_distance;
    bool certain;  // false: an angle is so near its threshold that rounding may decide either way
  };

  explicit MapOracle(const VoxelMap& map) : options_(map.options()), points_(map.points()) {
    std::map<SurfaceKey, std::vector<Eigen::Vector3d>> normals;
    for (const MapPoint& point : points_) {
      const SurfaceKey surface = surface_of(point);
      if (is_sighting(point.normal)) {  // a surface of sightings looks as the first of them does
        directions_.try_emplace(surface, Direction{2.0 * point.normal.cast<double>(), true});
      } else {
        normals[surface].push_back(point.normal.cast<double>());
      }
    }
    for (const auto& [surface, vectors] : normals) {
      directions_[surface] = principal_direction(vectors);
    }
  }

  /// All points in the voxels around `query` within `max_distance`, ascending; with a normal, only
  /// those that may agree with it.
  std::vector<Candidate> candidates(
      const Eigen::Vector3d& query,
      const Eigen::Vector3f* normal,
      const NearestSearch& search) const {
    const Eigen::Vector3d snapped = snap(query);
    std::vector<Candidate> result;
    for (const MapPoint& point : points_) {
      const Eigen::Array3i apart = (voxel_of(point.position) - voxel_of(query)).array().abs();
      const double sq_distance = (point.position - snapped).squaredNorm();
      if (apart.maxCoeff() > search.rings ||
          sq_distance > search.max_distance * search.max_distance) {
        continue;
      }
      Candidate candidate{sq_distance, true};
      if (normal == nullptr || agrees(point, *normal, search.gate, candidate.certain)) {
        result.push_back(candidate);
      }
    }
    std::sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
      return a.sq_distance < b.sq_distance;
    });
    return result;
  }

  Eigen::Vector3i voxel_of(const Eigen::Vector3d& position) const {
    return (position * (1.0 / options_.voxel_size)).array().floor().cast<int>();
  }

 private:
  using SurfaceKey = std::tuple<int, int, int, int>;

  SurfaceKey surface_of(const MapPoint& point) const {
    const Eigen::Vector3i v = voxel_of(point.position);
    return {v.x(), v.y(), v.z(), point.side};
  }

  // Distances are between lattice points (see VoxelMap).
  Eigen::Vector3d snap(const Eigen::Vector3d& position) const {
    const double step = options_.voxel_size / 8192.0;
    return ((position * (1.0 / options_.voxel_size) * 8192.0).array().floor() + 0.5) * step;
  }

  struct Direction {
    Eigen::Vector3d vector;
    bool distinct;  // the normals do have a principal direction, and it has a sign
  };

  static Direction principal_direction(const std::vector<Eigen::Vector3d>& normals) {
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& n : normals) {
      scatter += n * n.transpose();
      sum += n;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    const Eigen::Vector3d direction = solver.eigenvectors().col(2);
    const bool distinct = solver.eigenvalues()[1] < 0.5 * solver.eigenvalues()[2] &&
                          std::abs(direction.dot(sum)) > 0.1;
    return {direction.dot(sum) < 0.0 ? Eigen::Vector3d(-direction) : direction, distinct};
  }

  bool agrees(const MapPoint& point, const Eigen::Vector3f& asked, Gate gate, bool& certain) const {
    const bool sees_sightings = is_sighting(asked);
    const Eigen::Vector3d normal = (sees_sightings ? 2.0 : 1.0) * asked.cast<double>();
    constexpr double kRounding = 0.04;  // of two stored normals and an iterated direction
    const auto within = [&](const Eigen::Vector3d& a, double limit) {
      const double excess = std::acos(std::clamp(a.dot(normal), -1.0, 1.0)) - limit;
      certain = certain && excess < -kRounding;
      return excess < kRounding;
    };
    if (is_sighting(point.normal) && !sees_sightings) {
      return false;
    }
    bool ok = within(point.normal.cast<double>().normalized(), options_.max_point_angle);
    if (gate == Gate::kSurfaces) {
      const Direction& direction = directions_.at(surface_of(point));
      const bool agrees_with_surface = within(direction.vector, options_.max_surface_angle);
      certain = certain && direction.distinct;
      ok = (agrees_with_surface || !direction.distinct) && ok;
    }
    return ok;
  }

  MapOptions options_;
  std::vector<MapPoint> points_;
  std::map<SurfaceKey, Direction> directions_;
};

// All answers must be candidates, in ascending order, and no certain candidate that is nearer than
// the last may be missing.
inline void expect_right(
    const std::vector<MapOracle::Candidate>& candidates,
    const Neighbor* found,
    std::size_t count,
    std::size_t wanted) {
  constexpr double kTolerance = 1e-6;  // of a squared distance stored as float
  std::size_t certain = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double sq_distance = found[i].sq_distance;
    if (i > 0) {
      ASSERT_GE(found[i].sq_distance, found[i - 1].sq_distance);
    }
    const auto match =
        std::find_if(candidates.begin(), candidates.end(), [&](const auto& candidate) {
          return std::abs(candidate.sq_distance - sq_distance) < kTolerance;
        });
    ASSERT_NE(match, candidates.end()) << "no such candidate: " << sq_distance;
  }
  const double last =
      count < wanted ? std::numeric_limits<double>::infinity() : found[count - 1].sq_distance;
  for (const auto& candidate : candidates) {
    certain += candidate.certain && candidate.sq_distance < last - kTolerance ? 1 : 0;
  }
  EXPECT_LE(certain, count) << "a nearer neighbour was missed";
  EXPECT_LE(count, std::min(wanted, candidates.size()));
}

}  // namespace nvm::test
