// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>

#include "adapters/small_gicp/map_traits.hpp"

namespace nvm::adapters {

/// Where a NormalConsistentPlaneFactor takes the normal of a source point from.
enum class SourceNormal {
  kPoint,          ///< the source cloud's normals, which look at the sensor
  kViewDirection,  ///< the direction to the sensor at the origin of the source frame
  kNone,           ///< both sides: as small_gicp's PointToPlaneICPFactor
};

struct PlaneFactorSetting {
  SourceNormal source_normal = SourceNormal::kPoint;
};

/// A point-to-plane factor of small_gicp, for Registration<NormalConsistentPlaneFactor, Reduction>:
/// each source point is matched to the nearest map point on its own side. Source points whose
/// normal is not a unit vector, and map points without normals, make no factor.
class NormalConsistentPlaneFactor {
 public:
  using Setting = PlaneFactorSetting;

  explicit NormalConsistentPlaneFactor(const Setting& setting = {}) : setting_(setting) {}

  /// H = J^T J, b = J^T r and e = r^2 / 2 of r = n . (q - T p), for a step (rotation, translation)
  /// applied at the source: T exp(step). False, without writing, when there is no match.
  template <class Target, class Source, class Tree, class Rejector>
  bool linearize(
      const Target& target,
      const Source& source,
      const Tree& tree,
      const Eigen::Isometry3d& T_target_source,
      std::size_t source_index,
      const Rejector& rejector,
      Eigen::Matrix<double, 6, 6>* H,
      Eigen::Matrix<double, 6, 1>* b,
      double* e) {
    namespace traits = small_gicp::traits;
    source_index_ = source_index;
    target_index_ = kNone;
    const Eigen::Vector4d p_source = traits::point(source, source_index);
    const Eigen::Vector4d p_target = T_target_source * p_source;
    const Eigen::Vector3d normal = T_target_source.linear() * source_normal(source, source_index);
    std::size_t nearest = 0;
    double sq_distance = 0.0;
    const bool lacks_normal = setting_.source_normal != SourceNormal::kNone && normal.isZero();
    if (lacks_normal ||
        traits::Traits<Tree>::gated_nearest_neighbor_search(
            tree, p_target, normal, &nearest, &sq_distance) == 0 ||
        rejector(target, source, T_target_source, nearest, source_index, sq_distance)) {
      return false;
    }
    const Eigen::Vector3d n = traits::normal(target, nearest).template head<3>();
    if (n.isZero()) {
      return false;
    }
    target_index_ = nearest;
    const Eigen::Vector3d n_source = T_target_source.linear().transpose() * n;
    Eigen::Matrix<double, 1, 6> J;
    J << p_source.head<3>().cross(n_source).transpose(), n_source.transpose();
    J = -J;
    const double r = n.dot((traits::point(target, nearest) - p_target).template head<3>());
    *H = J.transpose() * J;
    *b = J.transpose() * r;
    *e = 0.5 * r * r;
    return true;
  }

  /// r^2 / 2 for the match of the last linearize(); 0 without one.
  template <class Target, class Source>
  double error(
      const Target& target, const Source& source, const Eigen::Isometry3d& T_target_source) const {
    namespace traits = small_gicp::traits;
    if (!inlier()) {
      return 0.0;
    }
    const Eigen::Vector4d p_target = T_target_source * traits::point(source, source_index_);
    const double r =
        traits::normal(target, target_index_).dot(traits::point(target, target_index_) - p_target);
    return 0.5 * r * r;
  }

  bool inlier() const noexcept { return target_index_ != kNone; }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// In the source frame; zero when there is none.
  template <class Source>
  Eigen::Vector3d source_normal(const Source& source, std::size_t i) const {
    namespace traits = small_gicp::traits;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    if (setting_.source_normal == SourceNormal::kPoint) {
      normal = traits::normal(source, i).template head<3>();
    } else if (setting_.source_normal == SourceNormal::kViewDirection) {
      normal = -traits::point(source, i).template head<3>();
    }
    const double length = normal.norm();
    return length > 0.0 && length < 1e12 ? Eigen::Vector3d(normal / length)
                                         : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

  Setting setting_;
  std::size_t target_index_ = kNone;
  std::size_t source_index_ = kNone;
};

/// A CorrespondenceRejector for small_gicp's own factors. It only discards: a point whose nearest
/// neighbour is on the wrong side gets no match, where NormalConsistentPlaneFactor finds the
/// nearest on the right one.
struct NormalRejector {
  double max_dist_sq = 1.0;  ///< [m^2]
  double min_dot = 0.0;      ///< cosine of the largest angle between the normals

  template <class Target, class Source>
  bool operator()(
      const Target& target,
      const Source& source,
      const Eigen::Isometry3d& T_target_source,
      std::size_t target_index,
      std::size_t source_index,
      double sq_dist) const {
    const Eigen::Vector3d n_source =
        small_gicp::traits::normal(source, source_index).template head<3>();
    const Eigen::Vector3d n_target =
        small_gicp::traits::normal(target, target_index).template head<3>();
    return !(sq_dist <= max_dist_sq) ||
           !(n_target.dot(T_target_source.linear() * n_source) > min_dot);
  }
};

}  // namespace nvm::adapters
