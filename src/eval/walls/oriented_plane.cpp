// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/oriented_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/median.hpp"
#include "eval/trajectory/error_statistics.hpp"

namespace nvm::eval {

namespace {

using Points = std::vector<Eigen::Vector3d>;

/// The total-least-squares plane of `points`, facing along `outward`; nothing when they lie along
/// a line, or in a ball.
std::optional<OrientedPlane> fit_plane(const Points& points, const Eigen::Vector3d& outward) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    scatter.noalias() += (p - mean) * (p - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  constexpr double kMinSqRatio = 4.0;  // at least twice as wide as thick
  if (!(eigen.eigenvalues()(1) > kMinSqRatio * std::max(eigen.eigenvalues()(0), 1e-12))) {
    return std::nullopt;
  }
  Eigen::Vector3d normal = eigen.eigenvectors().col(0);
  if (normal.dot(outward) < 0.0) {
    normal = -normal;
  }
  return OrientedPlane{normal, normal.dot(mean)};
}

Points points_near(const Points& points, const OrientedPlane& plane, double gate) {
  Points near;
  std::copy_if(
      points.begin(), points.end(), std::back_inserter(near), [&](const Eigen::Vector3d& p) {
        return std::abs(plane.distance(p)) <= gate;
      });
  return near;
}

std::vector<double> absolute_distances(const Points& points, const OrientedPlane& plane) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& p : points) {
    distances.push_back(std::abs(plane.distance(p)));
  }
  return distances;
}

}  // namespace

std::optional<FaceFit> fit_face(
    const Points& points, const OrientedPlane& start, const FaceFitOptions& options) {
  constexpr int kIterations = 8;
  constexpr double kMinGate = 0.005;
  constexpr double kDeviationPerMedian = 1.4826;  // of a normal distribution
  FaceFit fit;
  fit.plane = start;
  double gate = options.gate;
  for (int i = 0; i < kIterations; ++i) {
    fit.points = points_near(points, fit.plane, gate);
    if (fit.points.size() < options.min_points) {
      return std::nullopt;
    }
    const auto plane = fit_plane(fit.points, start.normal);
    if (!plane) {
      return std::nullopt;
    }
    fit.plane = *plane;
    const auto distances = absolute_distances(fit.points, fit.plane);
    fit.spread = summarize(distances)->rmse;
    gate = std::clamp(
        4.0 * kDeviationPerMedian * median(distances),
        std::min(kMinGate, options.gate),
        options.gate);
  }
  return fit;
}

}  // namespace nvm::eval
