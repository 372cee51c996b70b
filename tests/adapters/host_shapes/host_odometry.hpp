// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adapters/common/scan_normals.hpp"
#include "adapters/host_shapes/host_map.hpp"
#include "lio/imu/imu_buffer.hpp"
#include "lio/imu/imu_initializer.hpp"
#include "lio/scan/deskew.hpp"
#include "lio/state/error_state_filter.hpp"

namespace nvm::test {

/// What differs between the families, and their defaults: FAST_LIO's.
struct HostShape {
  HostFamily family = HostFamily::kFastLio;
  double filter_size = 0.5;       ///< of the scan and of the map [m]
  std::size_t keep_every = 3;     ///< of the returns (point_filter_num)
  std::size_t min_neighbors = 5;  ///< for a plane
  int neighbors = 5;
  double max_from_plane = 0.1;  ///< of a plane's points [m]
};

HostShape shape_of(HostFamily family);

/// An odometry in the shape of a host: its order of calls, filters, thresholds and weights, on an
/// IMU filter of ours. It has no plane projection and no merging, and one pose per scan.
///
/// FAST_LIO and faster-lio: centroids of cubes, planes through five neighbours, residuals of equal
/// weight in an iterated filter, at most four evaluations; a point goes into the map unless one of
/// its neighbours is nearer to the centre of its cube. ct-lio: the first point of small cubes,
/// planes through twenty, weights by planarity, and a pose that the filter takes loosely; all
/// points go into the map.
class HostOdometry {
 public:
  HostOdometry(const HostShape& shape, HostMapKind kind, const Pose& T_imu_lidar);

  void add_imu(const ImuSample& sample) { imu_.add(sample); }
  /// T_map_body at the scan's end; nothing until the filter and the map have been made.
  std::optional<Pose> process(const Scan& scan);
  /// The last scan, deskewed to its end, LiDAR frame.
  const lio::DeskewedScan& scan() const { return scan_; }
  Pose T_map_lidar() const { return filter_->state().T_world_lidar(); }
  const HostShapeMap& map() const { return *map_; }

 private:
  struct Residual {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the plane, map frame
    double offset = 0.0;
    double weight = 0.0;  ///< 0: none
  };

  /// Where the host puts a point of a scan.
  enum class Place { kNone, kCrowded, kAlone };

  bool initialize(double until);
  void predict(const Scan& scan);
  void thin();
  HostPoint to_map(const HostPoint& point, const lio::NavState& state) const;
  bool linearize(const lio::NavState& state, bool associate, lio::Information& out);
  void associate(const lio::NavState& state);
  Residual residual_of(
      const HostPoint& point, const HostPoint& placed, const HostPoints& near) const;
  void update();
  void update_loosely();
  void extend_map();
  Place place(const HostPoint& placed, const HostPoints& near) const;

  HostShape shape_;
  Pose T_imu_lidar_;
  std::unique_ptr<HostShapeMap> map_;
  bool is_built_ = false;
  adapters::ScanNormals normals_;
  HostMapKind kind_;
  lio::ImuBuffer imu_;
  lio::ImuInitializer initializer_{lio::InitializerOptions{}};
  std::optional<lio::ErrorStateFilter> filter_;
  double initialized_until_ = -1e300;
  lio::DeskewedScan scan_;
  HostPoints frame_;      ///< what may go into the map, LiDAR frame
  HostPoints keypoints_;  ///< what is matched: all of them but in ct-lio
  std::vector<HostPoints> nearest_;
  std::vector<Residual> residuals_;
};

}  // namespace nvm::test
