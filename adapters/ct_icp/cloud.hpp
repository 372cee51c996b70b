// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <ct_icp/map.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "adapters/common/host_map.hpp"

/// Point clouds of CT-ICP in and out of a map.
namespace nvm::adapters {

/// The points of a cloud in the map frame [m]: as the cloud has them, or else its raw points moved
/// by the poses of the frame, interpolated where points have times, as the host's own map does.
/// `frame_poses` must not be empty.
inline std::vector<Eigen::Vector3d> world_points(
    const slam::PointCloud& cloud, const std::vector<slam::Pose>& frame_poses) {
  const slam::PointCloudPtr copy = cloud.DeepCopyPtr();
  copy->RegisterFieldsFromSchema();
  if (!copy->HasWorldPoints()) {
    if (copy->HasTimestamps() && frame_poses.size() >= 2) {
      copy->RawPointsToWorldPoints(
          slam::LinearContinuousTrajectory::Create(std::vector<slam::Pose>(frame_poses)));
    } else {
      copy->RawPointsToWorldPoints(frame_poses.front().pose);
    }
  }
  auto world = copy->WorldPointsProxy<Eigen::Vector3d>();
  std::vector<Eigen::Vector3d> points(copy->size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = world[i];
  }
  return points;
}

/// All points of both sides with their normals, map frame.
inline slam::PointCloudPtr to_cloud(const HostMap& map) {
  auto cloud = slam::PointCloud::DefaultXYZPtr<double>();
  cloud->resize(map.size());
  cloud->AddDefaultNormalsField();
  cloud->SetWorldPointsField(slam::PointCloud::Field{cloud->GetXYZField()});
  auto xyz = cloud->XYZ<double>();
  auto normals = cloud->NormalsProxy<Eigen::Vector3d>();
  std::size_t i = 0;
  map.for_each_point([&](const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
    xyz[i] = position;
    normals[i] = Eigen::Vector3d(normal.cast<double>());
    ++i;
  });
  return cloud;
}

}  // namespace nvm::adapters
