// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// As much of CT-ICP's and SlamCore's headers as an adapter sees: the same names and signatures, as
// of include/ct_icp/map.h in commit 0d91fc9 and what it includes.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace slam {

struct SE3 {
  Eigen::Quaterniond quat = Eigen::Quaterniond::Identity();
  Eigen::Vector3d tr = Eigen::Vector3d::Zero();
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return quat * point + tr; }
};

struct Pose {
  SE3 pose;
  double dest_timestamp = -1.0;
  const Eigen::Vector3d& TrConstRef() const { return pose.tr; }
};

class LinearContinuousTrajectory {
 public:
  static LinearContinuousTrajectory Create(std::vector<Pose>&& poses) {
    LinearContinuousTrajectory trajectory;
    trajectory.poses_ = std::move(poses);
    return trajectory;
  }
  /// Of two poses, without rotation: enough for a test.
  Pose InterpolatePose(double timestamp) const {
    const Pose& begin = poses_.front();
    const Pose& end = poses_.back();
    const double alpha =
        (timestamp - begin.dest_timestamp) / (end.dest_timestamp - begin.dest_timestamp);
    Pose pose;
    pose.pose.tr = (1.0 - alpha) * begin.pose.tr + alpha * end.pose.tr;
    return pose;
  }

 private:
  std::vector<Pose> poses_;
};

struct WPoint3D {
  Eigen::Vector3d world_point;
};

struct Neighborhood {
  std::vector<Eigen::Vector3d> points;
};

class PointCloud;
using PointCloudPtr = std::shared_ptr<PointCloud>;

class PointCloud {
 public:
  struct Field {
    int item_index = 0;
  };
  using Column = std::vector<Eigen::Vector3d>;

  template <class Scalar>
  static PointCloudPtr DefaultXYZPtr() {
    return std::make_shared<PointCloud>();
  }
  PointCloudPtr DeepCopyPtr() const { return std::make_shared<PointCloud>(*this); }
  void RegisterFieldsFromSchema() { is_registered_ = true; }
  std::size_t size() const { return raw.size(); }
  void resize(std::size_t size) { raw.resize(size); }
  const Field& GetXYZField() { return field_; }
  void SetWorldPointsField(Field&&) { world = raw; }
  void AddDefaultNormalsField() { normals.resize(raw.size()); }
  bool HasWorldPoints() const { return is_registered_ && !world.empty(); }
  bool HasTimestamps() const { return is_registered_ && !timestamps.empty(); }
  void RawPointsToWorldPoints(const LinearContinuousTrajectory& trajectory) {
    world.clear();
    for (std::size_t i = 0; i < raw.size(); ++i) {
      world.push_back(trajectory.InterpolatePose(timestamps[i]).pose * raw[i]);
    }
  }
  void RawPointsToWorldPoints(const SE3& pose) {
    world.clear();
    for (const Eigen::Vector3d& point : raw) {
      world.push_back(pose * point);
    }
  }
  template <class Scalar>
  Column& XYZ() {
    return raw;
  }
  template <class Vector>
  Column& WorldPointsProxy() {
    return world;
  }
  template <class Vector>
  Column& NormalsProxy() {
    return normals;
  }

  Column raw, world, normals;
  std::vector<double> timestamps;

 private:
  Field field_;
  bool is_registered_ = false;
};

class IMap {
 public:
  virtual ~IMap() = 0;
  virtual void ClearMap() = 0;
  virtual void InsertPointCloud(const slam::PointCloud&, std::vector<size_t>&) = 0;
  virtual void RemoveElementsFarFromLocation(const Eigen::Vector3d& location, double distance) = 0;
  virtual void ComputeNeighborhoodInPlace(
      const Eigen::Vector3d& query, int max_num_neighbors, Neighborhood& neighborhood) const = 0;
  virtual std::vector<Neighborhood> ComputeNeighborhoods(
      const std::vector<Eigen::Vector3d>& queries, int max_num_neighbors) const = 0;
};
inline IMap::~IMap() = default;

}  // namespace slam

namespace ct_icp {

class ISlamMap : public slam::IMap {
 public:
  virtual void InsertPointCloud(
      const slam::PointCloud&, const std::vector<slam::Pose>&, std::vector<size_t>&) = 0;
  using slam::IMap::InsertPointCloud;
  virtual size_t NumPoints() const = 0;
  virtual slam::PointCloudPtr MapAsPointCloud() const = 0;
  virtual void UpdateTrajectory(const std::vector<slam::Pose>&) {}
  virtual void UpdateTrajectory(const slam::LinearContinuousTrajectory&) {}
  virtual slam::Neighborhood RadiusSearch(
      const Eigen::Vector3d& query,
      double radius,
      int max_num_neighbors = -1,
      bool nearest_neighbors = true,
      Eigen::Vector3d* sensor_location = nullptr) const = 0;
  virtual void RadiusSearchInPlace(
      const Eigen::Vector3d& query,
      slam::Neighborhood& neighborhood,
      double radius,
      int max_num_neighbors = -1,
      bool nearest_neighbors = true,
      Eigen::Vector3d* sensor_location = nullptr) const = 0;
  using slam::IMap::ComputeNeighborhoods;
  virtual std::vector<slam::Neighborhood> ComputeNeighborhoods(
      const std::vector<Eigen::Vector3d>& queries,
      const std::vector<double> radiuses,
      int max_num_neighbors,
      bool nearest_neighbors,
      Eigen::Vector3d* sensor_location) const = 0;
};

struct IMapOptions {
  virtual ~IMapOptions() = 0;
  virtual std::string GetType() const { return "INVALID_MAP"; }
  virtual std::shared_ptr<ct_icp::ISlamMap> MakeMapFromOptions() const {
    throw std::runtime_error("not implemented");
  }
};
inline IMapOptions::~IMapOptions() = default;

}  // namespace ct_icp
