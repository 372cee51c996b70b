// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/ros_bag_writer.hpp"

#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/file/file.hpp"
#include "io/file/pending_path.hpp"
#include "io/message/ros_messages.hpp"

namespace nvm::io {
namespace {

/// A CustomMsg of one of the Livox drivers; its points lie in `points` as they are serialised.
struct LivoxMessage {
  explicit LivoxMessage(const std::string& package)
      : type(package + "/CustomMsg"),
        definition(
            "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\n"
            "uint8[3] rsvd\nCustomPoint[] points\n" +
            std::string(80, '=') +
            "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n" +
            std::string(80, '=') + "\nMSG: " + package +
            "/CustomPoint\nuint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\n"
            "uint8 reflectivity\nuint8 tag\nuint8 line\n") {}

  std::string type;
  std::string definition;
  std_msgs::Header header;
  PointRecords points = livox_records();
};

}  // namespace
}  // namespace nvm::io

namespace ros::message_traits {  // what rosbag asks of a message type

using nvm::io::LivoxMessage;

template <>
struct MD5Sum<LivoxMessage> {
  static const char* value(const LivoxMessage&) { return "e4d6829bdfe657cb6c21a746c86b21a6"; }
};

template <>
struct DataType<LivoxMessage> {
  static const char* value(const LivoxMessage& message) { return message.type.c_str(); }
};

template <>
struct Definition<LivoxMessage> {
  static const char* value(const LivoxMessage& message) { return message.definition.c_str(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<nvm::io::LivoxMessage> {
  template <class Stream>
  static void write(Stream& stream, const nvm::io::LivoxMessage& message) {
    const auto size = static_cast<std::uint32_t>(message.points.size);
    stream.next(message.header);
    stream.next(static_cast<std::uint64_t>(message.header.stamp.toNSec()));
    stream.next(size);              // point_num
    stream.next(std::uint32_t{0});  // lidar_id, rsvd
    stream.next(size);
    const std::string& bytes = message.points.bytes;
    std::memcpy(
        stream.advance(static_cast<std::uint32_t>(bytes.size())), bytes.data(), bytes.size());
  }

  // NOLINTNEXTLINE(readability-identifier-naming): the name that ROS asks for
  static std::uint32_t serializedLength(const nvm::io::LivoxMessage& message) {
    constexpr std::uint32_t kFixed = 8 + 4 + 4 + 4;
    return serializationLength(message.header) + kFixed +
           static_cast<std::uint32_t>(message.points.bytes.size());
  }
};

}  // namespace ros::serialization

namespace nvm::io {
namespace {

std::uint32_t nanoseconds(float seconds) {
  return static_cast<std::uint32_t>(std::lround(1e9 * std::max(seconds, 0.0F)));
}

std_msgs::Header header_at(double time, const char* frame) {
  std_msgs::Header header;
  header.stamp = ros::Time(time);
  header.frame_id = frame;
  return header;
}

LivoxMessage livox_message(const Scan& scan, const char* package) {
  LivoxMessage message(package);
  message.header = header_at(scan.t_begin, "lidar");
  message.points.size = scan.points.size();
  for (const TimedPoint& point : scan.points) {
    std::string& bytes = message.points.bytes;
    append_bytes(nanoseconds(point.dt), bytes);
    for (const float coordinate : {point.x, point.y, point.z}) {
      append_bytes(coordinate, bytes);
    }
    append_bytes(static_cast<std::uint8_t>(std::clamp(point.intensity, 0.0F, 255.0F)), bytes);
    append_bytes(std::uint8_t{0}, bytes);  // tag
    append_bytes(static_cast<std::uint8_t>(std::min<int>(point.ring, 255)), bytes);
  }
  return message;
}

sensor_msgs::PointCloud2 cloud_message(const Scan& scan) {
  std::string bytes;
  for (const TimedPoint& point : scan.points) {
    for (const float value : {point.x, point.y, point.z, point.intensity}) {
      append_bytes(value, bytes);
    }
    append_bytes(nanoseconds(point.dt), bytes);
    append_bytes(point.ring, bytes);
  }
  sensor_msgs::PointCloud2 message;
  message.header = header_at(scan.t_begin, "lidar");
  message.height = 1;
  message.width = static_cast<std::uint32_t>(scan.points.size());
  const auto add_field = [&](const char* name, std::uint8_t datatype, std::uint32_t size) {
    sensor_msgs::PointField& field = message.fields.emplace_back();
    field.name = name;
    field.offset = message.point_step;
    field.datatype = datatype;
    field.count = 1;
    message.point_step += size;
  };
  for (const char* name : {"x", "y", "z", "intensity"}) {
    add_field(name, sensor_msgs::PointField::FLOAT32, 4);
  }
  add_field("t", sensor_msgs::PointField::UINT32, 4);
  add_field("ring", sensor_msgs::PointField::UINT16, 2);
  message.row_step = message.point_step * message.width;
  message.data.assign(bytes.begin(), bytes.end());
  message.is_dense = 1;
  return message;
}

sensor_msgs::Imu imu_message(const ImuSample& sample) {
  sensor_msgs::Imu message;
  message.header = header_at(sample.time, "imu");
  message.orientation_covariance[0] = -1.0;  // no orientation
  message.angular_velocity.x = sample.gyro.x();
  message.angular_velocity.y = sample.gyro.y();
  message.angular_velocity.z = sample.gyro.z();
  message.linear_acceleration.x = sample.accel.x();
  message.linear_acceleration.y = sample.accel.y();
  message.linear_acceleration.z = sample.accel.z();
  return message;
}

}  // namespace

struct RosBagWriter::Impl {
  PendingPath pending;
  CloudMessageType type;
  rosbag::Bag bag;

  /// Does what may throw, and names the file when it does.
  template <class Action>
  void attempt(const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      fail(pending.path(), error.what());
    }
  }

  template <class Message>
  void write(const char* topic, double time, const Message& message) {
    bag.write(topic, std::max(ros::Time(time), ros::TIME_MIN), message);
  }
};

RosBagWriter::RosBagWriter(const std::string& path, CloudMessageType type)
    : impl_(new Impl{PendingPath(path, PendingPath::Kind::kFile), type, {}}) {
  impl_->attempt([&] { impl_->bag.open(impl_->pending.temporary(), rosbag::bagmode::Write); });
}

RosBagWriter::~RosBagWriter() = default;

void RosBagWriter::add_scan(const Scan& scan) {
  impl_->attempt([&] {
    if (impl_->type == CloudMessageType::kPointCloud2) {
      impl_->write("/lidar", scan.t_end, cloud_message(scan));
    } else {
      const bool is_first = impl_->type == CloudMessageType::kLivoxCustom;
      const char* package = is_first ? "livox_ros_driver" : "livox_ros_driver2";
      impl_->write("/lidar", scan.t_end, livox_message(scan, package));
    }
  });
}

void RosBagWriter::add_imu(const ImuSample& sample) {
  impl_->attempt([&] { impl_->write("/imu", sample.time, imu_message(sample)); });
}

void RosBagWriter::commit() {
  impl_->attempt([&] { impl_->bag.close(); });
  impl_->pending.commit();
}

}  // namespace nvm::io
