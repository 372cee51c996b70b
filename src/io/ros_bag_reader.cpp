// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/ros_bag_reader.hpp"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/query.h>
#include <rosbag/view.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/file.hpp"
#include "io/imu_gap_monitor.hpp"
#include "io/ros_bag_check.hpp"
#include "io/ros_messages.hpp"

namespace nvm::io {
namespace {

constexpr double kStandardGravity = 9.80665;
constexpr char kImuType[] = "sensor_msgs/Imu";
constexpr char kCloudType[] = "sensor_msgs/PointCloud2";
constexpr char kLivoxType[] = "livox_ros_driver/CustomMsg";
constexpr char kLivox2Type[] = "livox_ros_driver2/CustomMsg";

bool is_livox(const std::string& type) { return type == kLivoxType || type == kLivox2Type; }
bool is_cloud(const std::string& type) { return type == kCloudType || is_livox(type); }
bool is_imu(const std::string& type) { return type == kImuType; }

/// A message as it is serialised.
std::string bytes_of(const rosbag::MessageInstance& message) {
  constexpr std::uint32_t kMaxSize = 1U << 28;  // rosbag believes any size that a damaged file says
  if (message.size() > kMaxSize) {
    throw std::runtime_error("is corrupt: a message says that it has more than 256 MiB");
  }
  std::string bytes(message.size(), '\0');
  ros::serialization::OStream stream(
      reinterpret_cast<std::uint8_t*>(bytes.data()), static_cast<std::uint32_t>(bytes.size()));
  message.write(stream);
  return bytes;
}

/// The topics of the bag with messages of an accepted type, in order of appearance.
std::vector<std::string> topics_of(const rosbag::Bag& bag, bool (*accepts)(const std::string&)) {
  std::vector<std::pair<std::uint32_t, std::string>> found;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    const auto is_same = [&](const auto& entry) { return entry.second == connection->topic; };
    if (accepts(connection->datatype) && std::none_of(found.begin(), found.end(), is_same)) {
      found.emplace_back(connection->id, connection->topic);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> topics;
  topics.reserve(found.size());
  for (auto& [id, topic] : found) {
    topics.push_back(std::move(topic));
  }
  return topics;
}

/// The factor that makes m/s^2 of the accelerations of the view.
double accel_scale(rosbag::View& view, AccelUnit unit) {
  constexpr std::size_t kSampleCount = 100;
  constexpr double kLimit = 3.0;  // between 1 g and 9.8 m/s^2 on a logarithmic scale
  std::vector<double> norms;
  for (auto it = view.begin(); it != view.end() && norms.size() < kSampleCount; ++it) {
    norms.push_back(read_imu(bytes_of(*it)).accel.norm());
  }
  if (unit == AccelUnit::kAutomatic && !norms.empty()) {
    std::sort(norms.begin(), norms.end());
    unit = norms[norms.size() / 2] < kLimit ? AccelUnit::kStandardGravity
                                            : AccelUnit::kMetrePerSquareSecond;
  }
  return unit == AccelUnit::kStandardGravity ? kStandardGravity : 1.0;
}

class RosBag : public SequenceReader {
 public:
  RosBag(std::string path, const SequenceOptions& options)
      : path_(std::move(path)),
        cloud_converter_(options.point_time_unit),
        gaps_(options.max_imu_gap) {
    check_ros_bag(path_);
    try {
      bag_.open(path_, rosbag::bagmode::Read);
      open(options);
    } catch (const std::exception& error) {
      fail(path_, error.what());
    }
  }

  const SequenceInfo& info() const override { return info_; }

  std::optional<lio::Scan> next_scan() override {
    while (scans_.empty() && advance()) {
    }
    if (scans_.empty()) {
      return std::nullopt;
    }
    lio::Scan scan = std::move(scans_.front());
    scans_.pop_front();
    return scan;
  }

  std::vector<lio::ImuSample> imu_until(double time) override {
    // With a limit to the scans read ahead: a topic that ended early must not fill the memory.
    constexpr std::size_t kMaxScansAhead = 20;
    while (info_.has_imu && previous_imu_ <= time && scans_.size() < kMaxScansAhead && advance()) {
    }
    const auto end = std::find_if(
        imu_.begin(), imu_.end(), [time](const auto& sample) { return sample.time > time; });
    std::vector<lio::ImuSample> samples(imu_.begin(), end);
    imu_.erase(imu_.begin(), end);
    return samples;
  }

 private:
  void open(const SequenceOptions& options) {
    const std::string lidar = choose_topic("lidar", topics_of(bag_, is_cloud), options.lidar_topic);
    const std::string imu = choose_topic("IMU", topics_of(bag_, is_imu), options.imu_topic);
    if (lidar.empty()) {
      throw std::runtime_error("has no topic with PointCloud2 or CustomMsg messages");
    }
    info_.format = "ROS 1 bag";
    info_.scan_count = rosbag::View(bag_, rosbag::TopicQuery(lidar)).size();
    info_.has_imu = !imu.empty();
    info_.notes.emplace_back("a bag does not tell T_imu_lidar: the identity is assumed");
    if (info_.has_imu) {
      rosbag::View samples(bag_, rosbag::TopicQuery(imu));
      accel_scale_ = accel_scale(samples, options.accel_unit);
    }
    if (accel_scale_ != 1.0) {
      info_.notes.emplace_back("the IMU measures in g: accelerations are multiplied by 9.80665");
    }
    inspect_first_cloud(lidar);
    view_.addQuery(bag_, rosbag::TopicQuery(std::vector<std::string>{lidar, imu}));
    next_ = view_.begin();
    fixed_notes_ = info_.notes.size();
  }

  /// The wanted topic, or the first one; empty when there is none.
  std::string choose_topic(
      const char* kind, const std::vector<std::string>& topics, const std::string& wanted) {
    const std::string list = fmt::format("{}", fmt::join(topics, ", "));
    if (!wanted.empty() && std::find(topics.begin(), topics.end(), wanted) == topics.end()) {
      throw std::runtime_error(
          fmt::format("has no {} topic '{}'; there are: {}", kind, wanted, list));
    }
    if (wanted.empty() && topics.size() > 1) {
      info_.notes.push_back(
          fmt::format("{} topic {} is read, out of {}", kind, topics.front(), list));
    }
    return !wanted.empty() || topics.empty() ? wanted : topics.front();
  }

  void inspect_first_cloud(const std::string& topic) {
    rosbag::View clouds(bag_, rosbag::TopicQuery(topic));
    if (clouds.size() > 0) {
      info_.has_point_times = find_time_field(read_cloud(*clouds.begin()).records) != nullptr;
    }
  }

  static CloudMessage read_cloud(const rosbag::MessageInstance& message) {
    const std::string bytes = bytes_of(message);
    return is_livox(message.getDataType()) ? read_livox_custom(bytes) : read_point_cloud2(bytes);
  }

  /// Reads one message; false at the end.
  bool advance() {
    if (next_ == view_.end()) {
      return false;
    }
    try {
      const rosbag::MessageInstance message = *next_;
      if (is_imu(message.getDataType())) {
        take_imu(read_imu(bytes_of(message)));
      } else {
        take_cloud(message);
      }
      ++next_;
    } catch (const std::exception& error) {
      fail(path_, error.what());
    }
    return true;
  }

  void take_cloud(const rosbag::MessageInstance& message) {
    ScanConverter& converter =
        is_livox(message.getDataType()) ? livox_converter_ : cloud_converter_;
    const CloudMessage cloud = read_cloud(message);
    lio::Scan scan = converter.convert(cloud.records, cloud.stamp);
    if (scan.t_begin <= previous_scan_) {
      throw std::runtime_error(fmt::format(
          "topic {}: the scan at {:.6f} s is not after the one before",
          message.getTopic(),
          scan.t_begin));
    }
    previous_scan_ = scan.t_begin;
    scans_.push_back(std::move(scan));
  }

  void take_imu(lio::ImuSample sample) {
    sample.accel *= accel_scale_;
    if (sample.time > previous_imu_ && sample.gyro.allFinite() && sample.accel.allFinite()) {
      previous_imu_ = sample.time;
      gaps_.add(sample.time);
      imu_.push_back(sample);
    } else {
      ++bad_imu_count_;
    }
    info_.notes.resize(fixed_notes_);
    if (bad_imu_count_ > 0) {
      info_.notes.push_back(fmt::format(
          "{} IMU messages that repeat or go back in time, or are not finite, are left out",
          bad_imu_count_));
    }
    if (const auto gaps = gaps_.summary()) {
      info_.notes.push_back(*gaps);
    }
  }

  std::string path_;
  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator next_;
  SequenceInfo info_;
  std::size_t fixed_notes_ = 0;  ///< the notes before those that change while reading
  ScanConverter cloud_converter_;
  ScanConverter livox_converter_{TimeUnit::kNanosecond};
  double accel_scale_ = 1.0;
  std::deque<lio::Scan> scans_;     ///< read, not handed out
  std::deque<lio::ImuSample> imu_;  ///< read, not handed out
  double previous_scan_ = -std::numeric_limits<double>::infinity();
  double previous_imu_ = -std::numeric_limits<double>::infinity();
  std::size_t bad_imu_count_ = 0;
  ImuGapMonitor gaps_;
};

}  // namespace

std::unique_ptr<SequenceReader> open_ros_bag(
    const std::string& path, const SequenceOptions& options) {
  return std::make_unique<RosBag>(path, options);
}

}  // namespace nvm::io
