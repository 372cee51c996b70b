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
#include "io/imu_file.hpp"
#include "io/imu_gap_monitor.hpp"
#include "io/left_out.hpp"
#include "io/ros_bag_check.hpp"
#include "io/ros_messages.hpp"
#include "io/scan_converter.hpp"

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

/// The factor that makes m/s^2 of accelerations of such lengths.
double accel_scale(std::vector<double> norms, AccelUnit unit) {
  constexpr double kLimit = 3.0;  // between 1 g and 9.8 m/s^2 on a logarithmic scale
  if (unit == AccelUnit::kAutomatic && !norms.empty()) {
    std::sort(norms.begin(), norms.end());
    unit = norms[norms.size() / 2] < kLimit ? AccelUnit::kStandardGravity
                                            : AccelUnit::kMetrePerSquareSecond;
  }
  return unit == AccelUnit::kStandardGravity ? kStandardGravity : 1.0;
}

PointTimeOptions point_time_options(const SequenceOptions& options) {
  PointTimeOptions times;
  times.field = options.point_time_field;
  times.unit = options.point_time_unit;
  times.stamp = options.stamp;
  times.is_raw = true;
  return times;
}

class RosBag : public SequenceReader {
 public:
  RosBag(std::string path, const SequenceOptions& options) : path_(std::move(path)) {
    check_ros_bag(path_);
    try {
      bag_.open(path_, rosbag::bagmode::Read);
      open(options);
    } catch (const std::exception& error) {
      fail(path_, error.what());
    }
  }

  const SequenceInfo& info() const override {
    info_.skipped_scans = bad_clouds_.count();
    info_.skipped_imu_samples = bad_imu_.count();
    info_.notes.resize(fixed_notes_);
    const auto notes = converter_.notes();
    info_.notes.insert(info_.notes.end(), notes.begin(), notes.end());
    for (const auto& note :
         {bad_clouds_.note(),
          bad_imu_.note(),
          clocks_.cloud.jump_note("clouds"),
          clocks_.imu.jump_note("IMU messages"),
          gaps_.summary()}) {
      if (note) {
        info_.notes.push_back(*note);
      }
    }
    return info_;
  }

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
    std::vector<CloudMessage> clouds = first_clouds(lidar);
    std::vector<MessageTime> cloud_times;
    for (const CloudMessage& cloud : clouds) {
      cloud_times.push_back({cloud.stamp, cloud.record_time});
    }
    clocks_ = choose_clocks(cloud_times, inspect_imu(imu, options.accel_unit), options.clock);
    info_.notes.insert(info_.notes.end(), clocks_.notes.begin(), clocks_.notes.end());
    learn(std::move(clouds), options);
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

  std::vector<MessageTime> inspect_imu(const std::string& topic, AccelUnit unit) {
    constexpr std::size_t kCount = 100;
    std::vector<double> norms;
    std::vector<MessageTime> times;
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (auto it = view.begin(); it != view.end() && times.size() < kCount; ++it) {
      const lio::ImuSample sample = read_imu(bytes_of(*it));
      norms.push_back(sample.accel.norm());
      times.push_back({sample.time, it->getTime().toSec()});
    }
    accel_scale_ = accel_scale(std::move(norms), unit);
    if (accel_scale_ != 1.0) {
      info_.notes.emplace_back("the IMU measures in g: accelerations are multiplied by 9.80665");
    }
    return times;
  }

  /// The first clouds, over which it is judged how they are dated, as any one may be bad.
  std::vector<CloudMessage> first_clouds(const std::string& topic) {
    constexpr std::size_t kCount = 20;
    std::vector<CloudMessage> clouds;
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (auto it = view.begin(); it != view.end() && clouds.size() < kCount; ++it) {
      try {
        clouds.push_back(read_cloud(*it));
      } catch (const std::exception&) {
        continue;  // advance() counts it
      }
      clouds.back().records.source = topic;
      clouds.back().record_time = it->getTime().toSec();
    }
    return clouds;
  }

  void learn(std::vector<CloudMessage> clouds, const SequenceOptions& options) {
    PointTimeOptions times = point_time_options(options);
    if (clocks_.cloud.uses_record() && times.stamp == StampMeaning::kAutomatic) {
      times.stamp = StampMeaning::kEnd;  // a message is recorded when it is complete
    }
    for (CloudMessage& cloud : clouds) {
      cloud.stamp = clocks_.cloud.uses_record() ? cloud.record_time : cloud.stamp;
      cloud.record_time -= std::min(clocks_.imu.uses_record() ? 0.0 : clocks_.imu.offset(), 0.0);
    }
    converter_ = ScanConverter(times);
    converter_.learn(clouds);
    info_.has_point_times = converter_.has_point_times();
  }

  static CloudMessage read_cloud(const rosbag::MessageInstance& message) {
    const std::string bytes = bytes_of(message);
    return is_livox(message.getDataType()) ? read_livox_custom(bytes) : read_point_cloud2(bytes);
  }

  /// Reads one message; false at the end. A bad one is counted and left out.
  bool advance() {
    if (next_ == view_.end()) {
      return false;
    }
    const rosbag::MessageInstance message = *next_;
    const bool is_imu_message = is_imu(message.getDataType());
    try {
      is_imu_message ? take_imu(message) : take_cloud(message);
    } catch (const std::exception& error) {
      (is_imu_message ? bad_imu_ : bad_clouds_)
          .add(fmt::format(
              "{} at {:.6f} s {}", message.getTopic(), message.getTime().toSec(), error.what()));
    }
    ++next_;
    return true;
  }

  void take_cloud(const rosbag::MessageInstance& message) {
    const CloudMessage cloud = read_cloud(message);
    const auto stamp = clocks_.cloud.date({cloud.stamp, message.getTime().toSec()});
    lio::Scan scan = converter_.convert(cloud.records, stamp.value_or(cloud.stamp));
    if (!stamp || scan.t_begin <= previous_scan_) {
      throw std::runtime_error(
          fmt::format("(stamp {:.6f} s) repeats, is late or jumps in time", cloud.stamp));
    }
    previous_scan_ = scan.t_begin;
    scans_.push_back(std::move(scan));
  }

  void take_imu(const rosbag::MessageInstance& message) {
    lio::ImuSample sample = read_imu(bytes_of(message));
    sample.accel *= accel_scale_;
    if (const auto problem = problem_of(sample)) {
      throw std::runtime_error(*problem);
    }
    const auto time = clocks_.imu.date({sample.time, message.getTime().toSec()});
    if (!time || *time <= previous_imu_) {
      throw std::runtime_error(
          fmt::format("(stamp {:.6f} s) repeats, is late or jumps in time", sample.time));
    }
    sample.time = previous_imu_ = *time;
    gaps_.add(sample.time);
    imu_.push_back(sample);
  }

  std::string path_;
  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator next_;
  mutable SequenceInfo info_;
  std::size_t fixed_notes_ = 0;  ///< the notes before those that change while reading
  ScanConverter converter_;
  Clocks clocks_;
  LeftOut bad_clouds_{"clouds are"};
  LeftOut bad_imu_{"IMU messages are"};
  double accel_scale_ = 1.0;
  std::deque<lio::Scan> scans_;     ///< read, not handed out
  std::deque<lio::ImuSample> imu_;  ///< read, not handed out
  double previous_scan_ = -std::numeric_limits<double>::infinity();
  double previous_imu_ = -std::numeric_limits<double>::infinity();
  ImuGapMonitor gaps_;
};

}  // namespace

std::unique_ptr<SequenceReader> open_ros_bag(
    const std::string& path, const SequenceOptions& options) {
  return std::make_unique<RosBag>(path, options);
}

}  // namespace nvm::io
