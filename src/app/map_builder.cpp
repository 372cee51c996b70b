// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/map_builder.hpp"

#include <limits>
#include <optional>

#include "eval/trajectory/gaps.hpp"
#include "lio/state/motion_along.hpp"

namespace nvm::app {

MapBuilder::MapBuilder(
    const lio::PipelineOptions& options, const Trajectory& T_map_body, double max_gap)
    : returns_(options.inertial.returns),
      trajectory_(T_map_body),
      max_gap_(max_gap),
      executor_(options.threads),
      preparer_(
          options.inertial.normals,
          options.inertial.max_plane_offset,
          options.inertial.keypoints,
          executor_),
      map_(lio::make_map(options.map_type, options.map)) {
  returns_.max_count = std::numeric_limits<std::size_t>::max();  // a map is not in a hurry
  returns_.validate();
  end_.T_body_lidar = options.inertial.T_imu_lidar;
}

bool MapBuilder::add(const Scan& scan) {
  const std::optional<Pose> end = pose_at(trajectory_, scan.t_end);
  if (!end) {
    return false;
  }
  if (eval::gap_around(trajectory_, scan.t_end) > max_gap_) {
    in_gaps_.push_back(scan.t_end);
    return false;
  }
  end_.time = scan.t_end;
  end_.T_world_body = *end;
  lio::motion_along(trajectory_, scan.t_begin, scan.t_end, segments_);
  deskew(scan, segments_, end_, returns_, scan_.scan);
  preparer_.prepare(scan_);
  inserted_.add(scan_.scan.size(), preparer_.insert(end_.T_world_lidar(), scan_, *map_));
  placed_.push_back({scan.t_end, *end});
  return true;
}

}  // namespace nvm::app
