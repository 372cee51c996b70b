// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string_view>

#include "io/point_records.hpp"
#include "io/scan_converter.hpp"
#include "lio/sensor_data.hpp"

namespace nvm::io {

// Readers of messages as ROS 1 serialises them. They throw std::runtime_error when the message is
// truncated or contradicts itself, and allocate no more than a fixed multiple of its size.

/// sensor_msgs/PointCloud2 of any layout. Fields of unknown type are left out.
CloudMessage read_point_cloud2(std::string_view bytes);

/// CustomMsg of livox_ros_driver and livox_ros_driver2: offset_time [ns from the stamp], x, y, z,
/// reflectivity, tag, line.
CloudMessage read_livox_custom(std::string_view bytes);

/// sensor_msgs/Imu; the acceleration as it stands in the message.
lio::ImuSample read_imu(std::string_view bytes);

/// Fields of the points of a CustomMsg, without points.
PointRecords livox_records();

}  // namespace nvm::io
