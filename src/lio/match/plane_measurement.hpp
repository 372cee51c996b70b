// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/executor.hpp"
#include "lio/map/lio_map.hpp"
#include "lio/scan/deskew.hpp"
#include "lio/state/error_state_filter.hpp"
#include "nvm/registration/plane.hpp"
#include "nvm/registration/sighting_options.hpp"

namespace nvm::lio {

/// How a point of the scan measures the state: its distance to a plane through its neighbours in
/// the map, and how much that distance errs.
struct MeasurementOptions {
  /// Neighbours that a plane is fitted to at most, and at least: 3 to kMaxNeighbors.
  std::size_t neighbors = 8;
  std::size_t min_neighbors = 5;
  /// Neighbours lie at most this far from the point [m], positive.
  double max_neighbor_distance = 0.6;
  /// A point farther from its plane belongs to something else [m], positive.
  double max_plane_distance = 0.3;
  /// Neighbours that deviate more from their plane (one standard deviation) are none [m], positive.
  double max_plane_deviation = 0.05;
  /// A plane whose normal is farther from the point's own [rad] belongs to another surface, or goes
  /// through a line of points that one ring of the LiDAR has drawn.
  double max_normal_angle = 0.5;
  /// Planes less planar than this (a2D of spec §4) are lines, 0 to 1.
  double min_planarity = 0.2;
  /// Instead of these two for keypoints with a sighting for a normal.
  SightingOptions sighting;
  /// Standard deviations of a point: along the beam [m], after it has been moved onto the plane of
  /// its neighbourhood, and across it as an angle [rad].
  double range_deviation = 0.005;
  double beam_deviation = 5e-4;
  /// Normalised residuals beyond this pull less than their square (Huber), positive.
  double huber = 2.0;
  /// Residuals that share map points err together: how many count as one, at least 1.
  double correlation = 2.0;
  /// Residuals that an update needs, at least 6.
  std::size_t min_residuals = 50;
  /// Directions of the pose with a smaller share of the information are left to the IMU, 0 to 1
  /// (see remove_unobserved).
  double min_observability = 3e-3;

  void validate() const;
};

/// A keypoint and the plane it was associated with.
struct PlaneResidual {
  Eigen::Vector3d p_lidar;       ///< scan frame, deskewed with the predicted state [m]
  Eigen::Vector3f n_lidar;       ///< unit normal or sighting, scan frame
  float age = 0.0F;              ///< before the scan's end [s]
  Eigen::Vector3f beam;          ///< unit, from the LiDAR to the point, scan frame
  float range = 0.0F;            ///< [m]
  Eigen::Vector3d plane_normal;  ///< map frame
  double plane_offset = 0.0;     ///< plane_normal . x for x on the plane [m]
  double plane_variance = 0.0;   ///< of the plane at the point [m^2]
  double planarity = 0.0;        ///< a2D of spec §4
  double distance = 0.0;         ///< of the point from the plane [m], at the last state evaluated
  bool valid = false;
};

/// How well the scan fits the map at the last state evaluated.
struct FitSummary {
  std::size_t keypoints = 0;    ///< without sightings that found no plane: those say nothing
  std::size_t residuals = 0;    ///< keypoints that found a plane
  double inlier_share = 0.0;    ///< of the keypoints: residuals within three standard deviations
  double residual_share = 0.0;  ///< the same, of the residuals
  double rms = 0.0;             ///< of the inliers' distances [m]
};

/// The point-to-plane measurement of a scan against a map.
///
/// The residual of a point p (scan frame, `age` tau before the scan's end) is
///   z = n . (T_world_body q - tau (v - v0)) - d,   q = T_body_lidar p + tau (b - b0) x
///   (T_body_lidar p)
/// with v0, b0 the velocity and gyro bias that deskewed the scan: the scan measures those too,
/// because a wrong velocity shears it. Memory is kept from scan to scan; results do not depend on
/// the number of threads.
class PlaneMeasurement {
 public:
  PlaneMeasurement(const MeasurementOptions& options, const Executor& executor);

  /// Takes the keypoints `chosen` of a scan that was deskewed with `predicted`.
  void start(
      const DeskewedScan& scan,
      const std::vector<Eigen::Vector3f>& normals,
      const std::vector<std::uint32_t>& chosen,
      const NavState& predicted);

  /// Finds each point's plane in `map`, at `state`.
  void associate(const LioMap& map, const NavState& state);

  /// The information of all residuals at `state`; false when they are fewer than min_residuals.
  bool linearize(const NavState& state, Information& out);

  const std::vector<PlaneResidual>& residuals() const { return residuals_; }
  FitSummary summary() const;
  double mean_range() const { return mean_range_; }  ///< of the keypoints [m]

 private:
  void associate_one(
      const LioMap& map,
      const NavState& state,
      LioMap::QueryContext& context,
      PlaneResidual& r) const;
  bool belongs(const Plane& plane, const Eigen::Vector3f& n_map) const;
  void add_block(const NavState& state, std::size_t begin, std::size_t end, Information& out);
  Eigen::Vector3d world_point(const NavState& state, const PlaneResidual& r) const;
  double variance(const NavState& state, const PlaneResidual& r) const;

  MeasurementOptions options_;
  Executor executor_;
  NavState predicted_;
  double mean_range_ = 0.0;
  std::vector<LioMap::QueryContext> contexts_;  // one per block
  std::vector<PlaneResidual> residuals_;
  std::vector<Information> block_information_;
  NavState evaluated_;
};

}  // namespace nvm::lio
