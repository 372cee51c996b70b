// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "messages.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "nvm/map/sighting.hpp"

namespace nvm_ros {

namespace {

using nvm::Pose;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// ros::Time throws for times that it cannot hold.
ros::Time stamp_of(double time) {
  constexpr double kMax = 4294967295.0;
  return ros::Time(std::clamp(time, 0.0, kMax));
}

geometry_msgs::Pose pose_message(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  geometry_msgs::Pose message;
  message.position.x = pose.translation().x();
  message.position.y = pose.translation().y();
  message.position.z = pose.translation().z();
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  message.orientation.w = q.w();
  return message;
}

geometry_msgs::Vector3 vector_message(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

template <class Array>
void write_row_major(const Matrix6& matrix, Array& array) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(array.data()) = matrix;
}

/// Covariance of the base's pose: its place is off as well when the body is turned.
Matrix6 base_covariance(const nvm::lio::FrameResult& frame, const Pose& T_body_base) {
  Matrix6 to_base = Matrix6::Identity();
  to_base.topRightCorner<3, 3>() =
      -nvm::skew(frame.T_map_body.linear() * T_body_base.translation());
  return to_base * frame.pose_covariance * to_base.transpose();
}

/// Whether a cloud has the fields that not all have.
struct CloudFields {
  bool intensity = false;
  bool side = false;
};

/// An unorganised cloud of float32 fields, and one byte at the end for the side.
sensor_msgs::PointCloud2 empty_cloud(
    const std::string& frame, double time, const CloudFields& fields) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = frame;
  cloud.header.stamp = stamp_of(time);
  cloud.height = 1;
  cloud.is_dense = true;
  const auto add_field = [&](const char* name, std::uint8_t type, std::uint32_t size) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = type;
    field.count = 1;
    cloud.point_step += size;
    cloud.fields.push_back(field);
  };
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z"}) {
    add_field(name, sensor_msgs::PointField::FLOAT32, sizeof(float));
  }
  if (fields.intensity) {
    add_field("intensity", sensor_msgs::PointField::FLOAT32, sizeof(float));
  }
  if (fields.side) {
    add_field("side", sensor_msgs::PointField::UINT8, sizeof(std::uint8_t));
  }
  return cloud;
}

void resize(std::size_t size, sensor_msgs::PointCloud2& cloud) {
  cloud.width = static_cast<std::uint32_t>(size);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(size * cloud.point_step);
}

/// Appends the bytes of one field after another.
class PointWriter {
 public:
  explicit PointWriter(std::uint8_t* out) : out_(out) {}

  void write(const Eigen::Vector3f& vector) { write_bytes(vector.data(), 3 * sizeof(float)); }

  template <class Number>
  void write(Number number) {
    write_bytes(&number, sizeof(number));
  }

 private:
  void write_bytes(const void* bytes, std::size_t size) {
    std::memcpy(out_, bytes, size);
    out_ += size;
  }

  std::uint8_t* out_;
};

}  // namespace

nav_msgs::Odometry odometry_message(
    const nvm::lio::FrameResult& frame, const Frames& frames, const std::string& odom) {
  nav_msgs::Odometry message;
  message.header.frame_id = odom;
  message.header.stamp = stamp_of(frame.time);
  message.child_frame_id = frames.base;
  message.pose.pose = pose_message(frame.T_map_body * frames.T_body_base);
  write_row_major(base_covariance(frame, frames.T_body_base), message.pose.covariance);
  const Eigen::Matrix3d R_base_body = frames.T_body_base.linear().transpose();
  const Eigen::Vector3d v_body = frame.T_map_body.linear().transpose() * frame.velocity;
  const Eigen::Vector3d turning = frame.angular_rate.cross(frames.T_body_base.translation());
  message.twist.twist.linear = vector_message(R_base_body * (v_body + turning));
  message.twist.twist.angular = vector_message(R_base_body * frame.angular_rate);
  Matrix6 to_base = Matrix6::Zero();
  to_base.topLeftCorner<3, 3>() = R_base_body * frame.T_map_body.linear().transpose();
  to_base.bottomRightCorner<3, 3>() = R_base_body;
  write_row_major(to_base * frame.twist_covariance * to_base.transpose(), message.twist.covariance);
  return message;
}

geometry_msgs::TransformStamped transform_message(const nav_msgs::Odometry& odometry) {
  geometry_msgs::TransformStamped message;
  message.header = odometry.header;
  message.child_frame_id = odometry.child_frame_id;
  message.transform.translation.x = odometry.pose.pose.position.x;
  message.transform.translation.y = odometry.pose.pose.position.y;
  message.transform.translation.z = odometry.pose.pose.position.z;
  message.transform.rotation = odometry.pose.pose.orientation;
  return message;
}

nav_msgs::Path path_message(
    const nvm::Trajectory& T_odom_base, const std::string& odom, std::size_t max_count) {
  nav_msgs::Path path;
  path.header.frame_id = odom;
  if (T_odom_base.empty()) {
    return path;
  }
  path.header.stamp = stamp_of(T_odom_base.back().time);
  const std::size_t step = (T_odom_base.size() + max_count - 1) / max_count;
  for (std::size_t i = (T_odom_base.size() - 1) % step; i < T_odom_base.size(); i += step) {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = odom;
    pose.header.stamp = stamp_of(T_odom_base[i].time);
    pose.pose = pose_message(T_odom_base[i].pose);
    path.poses.push_back(pose);
  }
  return path;
}

sensor_msgs::PointCloud2 frame_message(
    const nvm::lio::Pipeline& pipeline, double time, const Frames& frames) {
  const Eigen::Affine3f T_base_lidar =
      Eigen::Affine3d(frames.T_body_base.inverse() * frames.T_body_lidar).cast<float>();
  const std::vector<Eigen::Vector3f>& points = pipeline.scan().points;
  sensor_msgs::PointCloud2 cloud = empty_cloud(frames.base, time, {true, false});
  resize(points.size(), cloud);
  for (std::size_t i = 0; i < points.size(); ++i) {
    PointWriter out(&cloud.data[i * cloud.point_step]);
    out.write(Eigen::Vector3f(T_base_lidar * points[i]));
    out.write(Eigen::Vector3f(T_base_lidar.linear() * nvm::plane_normal(pipeline.normals()[i])));
    out.write(pipeline.scan().values[i].intensity);
  }
  return cloud;
}

sensor_msgs::PointCloud2 map_message(
    const std::vector<nvm::MapPoint>& points,
    bool has_intensity,
    double time,
    const std::string& odom) {
  sensor_msgs::PointCloud2 cloud = empty_cloud(odom, time, {has_intensity, true});
  resize(points.size(), cloud);
  for (std::size_t i = 0; i < points.size(); ++i) {
    PointWriter out(&cloud.data[i * cloud.point_step]);
    out.write(Eigen::Vector3f(points[i].position.cast<float>()));
    out.write(points[i].normal);
    if (has_intensity) {
      out.write(points[i].values.intensity);
    }
    out.write(static_cast<std::uint8_t>(points[i].side));
  }
  return cloud;
}

}  // namespace nvm_ros
