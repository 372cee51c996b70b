// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// A node in FAST_LIO's setting: ROS messages, PCL's clouds and voxel filter, OpenMP, and the names
// of std and Eigen in scope before the map's header.
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

using namespace std;    // NOLINT: as the host does
using namespace Eigen;  // NOLINT

using PointType = pcl::PointXYZINormal;
using PointCloudXYZI = pcl::PointCloud<PointType>;
using PointVector = vector<PointType, Eigen::aligned_allocator<PointType>>;

#include <ikd-Tree/ikd_Tree.h>

#include "adapters/common/scan_normals.hpp"

/// What of the host's state a map needs: the pose of the IMU and of the LiDAR on it.
struct NodeState {
  Quaterniond rot = Quaterniond::Identity();
  Vector3d pos = Vector3d::Zero();
  Quaterniond offset_R_L_I = Quaterniond::Identity();
  Vector3d offset_T_L_I = Vector3d::Zero();

  Vector3d lidar_position() const { return pos + rot * offset_T_L_I; }
  Vector3d to_world(const Vector3d& p_body) const {
    return rot * (offset_R_L_I * p_body + offset_T_L_I) + pos;
  }
  Vector3d to_body(const Vector3d& p_world) const {
    return offset_R_L_I.inverse() * (rot.inverse() * (p_world - pos) - offset_T_L_I);
  }
};

/// How far the host has been patched, in the words of docs/adapters/ikd_tree.md.
enum class Patch { kA, kViewDirection, kB };

class FastLioNode {
 public:
  explicit FastLioNode(Patch patch);

  /// One scan, through all calls of the host to its map.
  void process(const sensor_msgs::PointCloud2::ConstPtr& message, const NodeState& state);
  /// The whole map, as the host publishes it.
  sensor_msgs::PointCloud2 map_message();

  const PointCloudXYZI& scan_world() const { return feats_down_world_; }
  const vector<PointVector>& nearest_points() const { return nearest_points_; }

 private:
  void point_body_to_world(const PointType* from, PointType* to) const;
  bool initialize_map();
  void match();
  void map_incremental();

  Patch patch_;
  NodeState state_;
  KD_TREE<PointType> ikdtree_;
  nvm::adapters::ScanNormals scan_normals_;
  pcl::VoxelGrid<PointType> down_size_filter_;
  PointCloudXYZI::Ptr feats_undistort_{new PointCloudXYZI()};
  PointCloudXYZI feats_down_body_, feats_down_world_;
  vector<PointVector> nearest_points_;
};
