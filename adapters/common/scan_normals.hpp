// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "adapters/common/point_fields.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/normal/normal_estimator.hpp"

namespace nvm::adapters {

/// What ScanNormals writes for `point`, seen from `p_sensor` [m]: its `normal`, or where that is
/// zero a sighting (nvm/map/sighting.hpp), which maps behind adapters match by the surfaces that
/// they know.
template <class Point>
Eigen::Vector3f normal_or_sighting(
    const Eigen::Vector3f& normal, const Point& point, const Eigen::Vector3d& p_sensor) {
  return is_unit_normal(normal) ? normal : sighting(point, p_sensor);
}

/// Writes normals into the points of a host, which carry them through its own code to the map. Keep
/// one per sensor.
class ScanNormals {
 public:
  /// Hosts keep every third or fourth return: with the radius that suits a whole scan half of the
  /// points have too few neighbours, and the floor under a spinning sensor is a set of lines. Both
  /// are tried again with twice the radius.
  static NormalOptions defaults() {
    NormalOptions options;
    options.widening = 2.0;
    return options;
  }
  /// Throws std::invalid_argument when the options are out of range.
  explicit ScanNormals(const NormalOptions& options = defaults()) : estimator_(options) {}

  /// Sets normal_x, normal_y, normal_z of each of `points` from its neighbours in `full_scan`, from
  /// which a host thins `points`. Both in the frame of the sensor, which is at `p_sensor` [m]. The
  /// normals look at the sensor; where the scan has no plane they are sightings, of half the
  /// length. Thin first: a filter that averages points averages the normals of a wall's two faces
  /// to nothing.
  template <class Points, class FullScan>
  NormalStats write(
      Points& points,
      const FullScan& full_scan,
      const Eigen::Vector3d& p_sensor = Eigen::Vector3d::Zero()) {
    const NormalResult& result = estimator_.estimate_at(points, full_scan, p_sensor);
    for (std::size_t i = 0; i < result.normals.size(); ++i) {
      set_normal(points[i], normal_or_sighting(result.normals[i], points[i], p_sensor));
    }
    return result.stats;
  }

 private:
  NormalEstimator estimator_;
};

/// Gives `to` the normal of `from`, rotated by `R_to_from`: what hosts forget when they transform
/// a point. A sighting stays one, a missing (zero) normal missing.
template <class From, class To>
void rotate_normal(const Eigen::Matrix3d& R_to_from, const From& from, To& to) {
  const Eigen::Vector3d rotated = R_to_from * normal_field(from).template cast<double>();
  set_normal(to, rotated.cast<float>());
}

}  // namespace nvm::adapters
