// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/crispness.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "common/median.hpp"

namespace nvm::eval {

namespace {

/// What nanoflann asks of its data set.
struct PointRange {
  const std::vector<OrientedPoint>& points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index].position[static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using Tree = nanoflann::
    KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointRange>, PointRange, 3>;
using Patch = std::vector<Eigen::Vector3d>;

constexpr std::size_t kMinPatchPoints = 8;

/// Eigenvalues of the covariance of `patch`, ascending and positive [m^2].
Eigen::Vector3d principal_variances(const Patch& patch) {
  const auto count = static_cast<double>(patch.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : patch) {
    mean += p / count;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : patch) {
    covariance += (p - mean) * (p - mean).transpose() / count;
  }
  constexpr double kMinVariance = 1e-12;  // of exact planes, whose entropy would be -infinity
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseMax(kMinVariance);
}

double entropy(const Eigen::Vector3d& variances) {
  constexpr double kTwoPiE = 17.079468445347132;
  return 0.5 * (kTwoPiE * variances).array().log().sum();
}

/// The points around a point, and those of them on its own side.
struct Patches {
  Patch all;
  Patch same_side;
};

/// What every nanoflann since 1.4 asks of a result set.
class PatchCollector {
 public:
  using DistanceType = double;
  using IndexType = std::size_t;

  PatchCollector(const std::vector<OrientedPoint>& points, std::size_t center, double radius)
      : points_(points), normal_(points[center].normal), sq_radius_(radius * radius) {}

  bool addPoint(double sq_distance, std::size_t index) {
    if (sq_distance < sq_radius_) {
      patches.all.push_back(points_[index].position);
      if (points_[index].normal.dot(normal_) >= 0.0) {
        patches.same_side.push_back(points_[index].position);
      }
    }
    return true;
  }
  double worstDist() const { return sq_radius_; }
  bool full() const { return true; }
  bool empty() const { return patches.all.empty(); }
  std::size_t size() const { return patches.all.size(); }
  void sort() {}

  Patches patches;

 private:
  const std::vector<OrientedPoint>& points_;
  Eigen::Vector3d normal_;
  double sq_radius_;
};

Patches patches_around(
    const std::vector<OrientedPoint>& points, const Tree& tree, std::size_t center, double radius) {
  PatchCollector collector(points, center, radius);
  tree.findNeighbors(collector, points[center].position.data(), {});
  return collector.patches;
}

bool is_planar(const Eigen::Vector3d& variances) {
  constexpr double kMaxSurfaceVariation = 0.1;
  constexpr double kMinSqWidth = 0.04;  // of the narrow to the wide axis, squared
  return variances[0] < kMaxSurfaceVariation * variances.sum() &&
         variances[1] > kMinSqWidth * variances[2];
}

}  // namespace

std::optional<Crispness> measure_crispness(const OrientedCloud& cloud, double radius) {
  constexpr std::size_t kMaxPatches = 20000;
  const PointRange range{cloud.points};
  Tree tree(3, range);
  tree.buildIndex();
  const std::size_t step = 1 + cloud.points.size() / kMaxPatches;
  Crispness crispness;
  std::vector<double> thicknesses;
  for (std::size_t i = 0; i < cloud.points.size(); i += step) {
    const auto [all, same_side] = patches_around(cloud.points, tree, i, radius);
    if (all.size() >= kMinPatchPoints) {
      ++crispness.patches;
      crispness.mean_map_entropy += entropy(principal_variances(all));
    }
    if (same_side.size() >= kMinPatchPoints) {
      const Eigen::Vector3d variances = principal_variances(same_side);
      if (is_planar(variances)) {
        thicknesses.push_back(std::sqrt(variances[0]));
      }
    }
  }
  if (crispness.patches == 0) {
    return std::nullopt;
  }
  crispness.mean_map_entropy /= static_cast<double>(crispness.patches);
  if (!thicknesses.empty()) {
    crispness.plane_thickness = median(std::move(thicknesses));
  }
  return crispness;
}

}  // namespace nvm::eval
