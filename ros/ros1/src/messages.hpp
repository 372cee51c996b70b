// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "frames.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "nvm/map/map_point.hpp"

namespace nvm_ros {

/// Pose and velocity of the base at the scan's end with their covariances: pose in `odom` as
/// (position, rotation about the frame's axes), velocity in the base's frame.
nav_msgs::Odometry odometry_message(
    const nvm::lio::FrameResult& frame, const Frames& frames, const std::string& odom);

geometry_msgs::TransformStamped transform_message(const nav_msgs::Odometry& odometry);

/// At most `max_count` of the poses, evenly, the last one among them.
nav_msgs::Path path_message(
    const nvm::Trajectory& T_odom_base, const std::string& odom, std::size_t max_count);

/// The pipeline's last scan, deskewed, in the base's frame: x y z, normal_x normal_y normal_z (zero
/// where there is no plane), intensity as the sensor gives it.
sensor_msgs::PointCloud2 frame_message(
    const nvm::lio::Pipeline& pipeline, double time, const Frames& frames);

/// x y z, normal_x normal_y normal_z, intensity where the map keeps it, side.
sensor_msgs::PointCloud2 map_message(
    const std::vector<nvm::MapPoint>& points,
    bool has_intensity,
    double time,
    const std::string& odom);

}  // namespace nvm_ros
