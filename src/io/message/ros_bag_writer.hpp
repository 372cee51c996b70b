// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/sensor_data.hpp"

namespace nvm::io {

/// The message type that takes the scans of a bag.
enum class CloudMessageType {
  kPointCloud2,   ///< sensor_msgs/PointCloud2: x y z intensity, t [ns from the stamp], ring
  kLivoxCustom,   ///< livox_ros_driver/CustomMsg
  kLivox2Custom,  ///< livox_ros_driver2/CustomMsg
};

/// Writes a ROS 1 bag with scans on /lidar and IMU samples on /imu, one message at a time. The file
/// appears under its name with commit(); without it, nothing is left. Only built where
/// rosbag_storage is (NVM_WITH_ROSBAG). Every member throws std::runtime_error, naming the file,
/// when it cannot be written.
class RosBagWriter {
 public:
  RosBagWriter(const std::string& path, CloudMessageType type);
  ~RosBagWriter();
  RosBagWriter(const RosBagWriter&) = delete;
  RosBagWriter& operator=(const RosBagWriter&) = delete;

  /// Adds a scan, dated t_begin and recorded at t_end. Livox messages keep the intensity as a whole
  /// number from 0 to 255 and the ring as one.
  void add_scan(const Scan& scan);
  void add_imu(const ImuSample& sample);

  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nvm::io
