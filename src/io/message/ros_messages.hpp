// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <string_view>

#include "common/sensor_data.hpp"
#include "io/cloud/point_records.hpp"
#include "io/message/message_source.hpp"
#include "io/scan/scan_converter.hpp"

namespace nvm::io {

// Readers of messages as ROS 1 serialises them. They throw std::runtime_error when the message is
// truncated or contradicts itself, and allocate no more than a fixed multiple of its size.

/// sensor_msgs/PointCloud2 of any layout. Fields of unknown type are left out.
CloudMessage read_point_cloud2(std::string_view bytes);

/// CustomMsg of livox_ros_driver and livox_ros_driver2: offset_time [ns from the stamp], x, y, z,
/// reflectivity, tag, line.
CloudMessage read_livox_custom(std::string_view bytes);

/// sensor_msgs/Imu; the acceleration as it stands in the message.
ImuSample read_imu(std::string_view bytes);

/// The bytes of a message. Throws std::runtime_error when they could not be read.
const std::string& bytes_of(const RecordedMessage& message);

/// A message of a type for which is_cloud() holds.
CloudMessage read_cloud(const RecordedMessage& message);

/// Fields of the points of a CustomMsg, without points.
PointRecords livox_records();

}  // namespace nvm::io
