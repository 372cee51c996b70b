// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/ros_hosts/fast_lio_node.hpp"

#include <omp.h>
#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>

namespace {

constexpr float kFilterSize = 0.2F;
constexpr int kMatches = 5;

PointType copy_position(const Vector3d& position, const PointType& from, PointType to) {
  to.x = static_cast<float>(position.x());
  to.y = static_cast<float>(position.y());
  to.z = static_cast<float>(position.z());
  to.intensity = from.intensity;
  return to;
}

Vector3d position_of(const PointType& point) { return point.getVector3fMap().cast<double>(); }

}  // namespace

FastLioNode::FastLioNode(Patch patch) : patch_(patch) {
  down_size_filter_.setLeafSize(kFilterSize, kFilterSize, kFilterSize);
}

// Positions and intensities only: what the buffer held of normals stays, unless patch B rotates.
void FastLioNode::point_body_to_world(const PointType* from, PointType* to) const {
  *to = copy_position(state_.to_world(position_of(*from)), *from, *to);
  if (patch_ == Patch::kB) {
    nvm::adapters::rotate_normal((state_.rot * state_.offset_R_L_I).toRotationMatrix(), *from, *to);
  }
}

bool FastLioNode::initialize_map() {
  if (ikdtree_.Root_Node != nullptr) {
    return false;
  }
  if (feats_down_body_.size() > 5) {
    ikdtree_.set_downsample_param(kFilterSize);
    for (size_t i = 0; i < feats_down_body_.size(); i++) {
      point_body_to_world(&feats_down_body_[i], &feats_down_world_[i]);
    }
    ikdtree_.Build(feats_down_world_.points);
  }
  return true;
}

void FastLioNode::match() {
  nearest_points_.resize(feats_down_body_.size());
  const int size = static_cast<int>(feats_down_body_.size());
  omp_set_num_threads(2);
#pragma omp parallel for
  for (int i = 0; i < size; i++) {
    const auto at = static_cast<size_t>(i);
    point_body_to_world(&feats_down_body_[at], &feats_down_world_[at]);
    vector<float> sq_distances(kMatches);
    ikdtree_.Nearest_Search(feats_down_world_[at], kMatches, nearest_points_[at], sq_distances);
  }
}

void FastLioNode::map_incremental() {
  PointVector to_add, no_need_downsample;
  for (size_t i = 0; i < feats_down_world_.size(); i++) {
    (nearest_points_[i].empty() ? no_need_downsample : to_add).push_back(feats_down_world_[i]);
  }
  int added = ikdtree_.Add_Points(to_add, true);
  added += ikdtree_.Add_Points(no_need_downsample, false);
  ROS_DEBUG("%d points added at %f", added, ros::Time(1.0).toSec());
}

void FastLioNode::process(
    const sensor_msgs::PointCloud2::ConstPtr& message, const NodeState& state) {
  state_ = state;
  pcl::fromROSMsg(*message, *feats_undistort_);
  if (patch_ != Patch::kA) {
    const Vector3d lidar = state_.lidar_position();
    ikdtree_.set_view_point(lidar(0), lidar(1), lidar(2));
  }
  PointVector removed;
  ikdtree_.acquire_removed_points(removed);
  vector<BoxPointType> far_away{{{500.0F, -1000.0F, -1000.0F}, {1000.0F, 1000.0F, 1000.0F}}};
  ikdtree_.Delete_Point_Boxes(far_away);
  down_size_filter_.setInputCloud(feats_undistort_);
  down_size_filter_.filter(feats_down_body_);
  if (patch_ == Patch::kB) {
    scan_normals_.write(feats_down_body_.points, feats_undistort_->points);
  }
  feats_down_world_.resize(feats_down_body_.size());
  if (initialize_map()) {
    return;
  }
  match();
  map_incremental();
}

sensor_msgs::PointCloud2 FastLioNode::map_message() {
  PointVector().swap(ikdtree_.PCL_Storage);
  ikdtree_.flatten(ikdtree_.Root_Node, ikdtree_.PCL_Storage, NOT_RECORD);
  PointCloudXYZI cloud;
  cloud.points = ikdtree_.PCL_Storage;
  cloud.width = static_cast<uint32_t>(ikdtree_.validnum());
  cloud.height = 1;
  sensor_msgs::PointCloud2 message;
  pcl::toROSMsg(cloud, message);
  message.header.frame_id = "camera_init";
  return message;
}
