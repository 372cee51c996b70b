// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "adapters/common/point_fields.hpp"
#include "nvm/core/executor.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/normal/normal_estimator.hpp"

/// Point clouds of PCL in and out of nvm. docs/adapters/pcl.md
namespace nvm::adapters {

/// The normal fields of a cloud as the range of normals that nvm takes. Refers to the cloud.
template <class PointT>
class NormalFields {
 public:
  explicit NormalFields(const ::pcl::PointCloud<PointT>& cloud) : cloud_(cloud) {
    static_assert(has_normal_fields_v<PointT>, "nvm: this point type has no normal_x, _y, _z");
  }
  std::size_t size() const { return cloud_.size(); }
  Eigen::Vector3f operator[](std::size_t i) const { return normal_field(cloud_[i]); }

 private:
  const ::pcl::PointCloud<PointT>& cloud_;
};

/// VoxelMap::insert of a cloud with normals, which must look at the sensor.
template <class PointT>
InsertStats insert(
    VoxelMap& map,
    const ::pcl::PointCloud<PointT>& cloud,
    const Pose& T_map_scan = Pose::Identity()) {
  return map.insert(cloud, NormalFields<PointT>(cloud), T_map_scan);
}

/// A normal as PCL has it: NaN where there is none. nvm does not compute the curvature: NaN.
template <class PointT>
void set_pcl_normal(PointT& point, const NormalResult& result, std::size_t i) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const bool valid = result.status[i] == NormalStatus::kValid;
  set_normal(point, valid ? result.normals[i] : Eigen::Vector3f::Constant(kNan));
  point.curvature = kNan;
}

/// The normals of a scan, index by index, looking at `viewpoint` [m, frame of the cloud].
template <class PointT, class Executor = SerialExecutor>
::pcl::PointCloud<::pcl::Normal> normals_of(
    const ::pcl::PointCloud<PointT>& cloud,
    const Eigen::Vector3d& viewpoint = Eigen::Vector3d::Zero(),
    const NormalOptions& options = {},
    const Executor& executor = {}) {
  const NormalResult result = estimate_normals(cloud, viewpoint, options, executor);
  ::pcl::PointCloud<::pcl::Normal> normals;
  normals.header = cloud.header;
  normals.resize(cloud.size());
  normals.width = cloud.width;
  normals.height = cloud.height;
  normals.is_dense = result.stats.valid == cloud.size();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    set_pcl_normal(normals[i], result, i);
  }
  return normals;
}

/// All points of both sides, map frame, with their normals when PointT has room for them.
template <class PointT>
::pcl::PointCloud<PointT> to_cloud(const VoxelMap& map) {
  ::pcl::PointCloud<PointT> cloud;
  cloud.reserve(map.size());
  map.for_each_point([&](const MapPoint& point) {
    cloud.push_back(make_point<PointT>(point.position, point.normal));
  });
  return cloud;
}

}  // namespace nvm::adapters
