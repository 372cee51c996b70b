// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/message_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/file/file.hpp"
#include "io/message/message_topics.hpp"
#include "io/message/ros_messages.hpp"
#include "io/scan/scan_stream.hpp"
#include "io/sequence/imu_file.hpp"
#include "io/sequence/imu_gap_monitor.hpp"
#include "io/sequence/left_out.hpp"
#include "io/sequence/sequence_options.hpp"

namespace nvm::io {
namespace {

class MessageSequence : public SequenceReader {
 public:
  MessageSequence(
      const std::string& path,
      std::unique_ptr<MessageSource> source,
      const SequenceOptions& options)
      : source_(std::move(source)) {
    try {
      open(options);
    } catch (const std::runtime_error& error) {
      const std::string problem = error.what();
      if (problem.rfind(path + ": ", 0) == 0) {
        throw;  // of a source that has named it
      }
      fail(path, problem);
    }
  }

  const SequenceInfo& info() const override {
    info_.skipped_scans = bad_clouds_.count();
    info_.skipped_imu_samples = bad_imu_.count();
    info_.notes.resize(fixed_notes_);
    const auto notes = scan_stream_.notes();
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

  std::optional<Scan> next_scan() override {
    while (scans_.empty() && advance()) {
    }
    if (scans_.empty()) {
      return std::nullopt;
    }
    Scan scan = std::move(scans_.front());
    scans_.pop_front();
    return scan;
  }

  std::vector<ImuSample> imu_until(double time) override {
    // With a limit to the scans read ahead: a topic that ended early must not fill the memory.
    constexpr std::size_t kMaxScansAhead = 20;
    while (info_.has_imu && previous_imu_ <= time && scans_.size() < kMaxScansAhead && advance()) {
    }
    const auto end = std::find_if(
        imu_.begin(), imu_.end(), [time](const auto& sample) { return sample.time > time; });
    std::vector<ImuSample> samples(imu_.begin(), end);
    imu_.erase(imu_.begin(), end);
    return samples;
  }

 private:
  void open(const SequenceOptions& options) {
    const std::vector<MessageTopic> topics = source_->topics();
    info_.notes = source_->problems();
    const std::string lidar =
        choose_topic("lidar", topics_of(topics, is_cloud), options.lidar_topic, info_.notes);
    const std::string imu =
        choose_topic("IMU", topics_of(topics, is_imu), options.imu_topic, info_.notes);
    if (lidar.empty()) {
      refuse_without_clouds(topics, info_.notes);
    }
    info_.format = source_->format();
    info_.recording = source_->recording();
    info_.scan_count = count_of(topics, lidar, is_cloud);
    info_.has_imu = count_of(topics, imu, is_imu) > 0;
    const std::vector<CloudMessage> clouds = first_clouds(lidar);
    std::vector<MessageTime> cloud_times;
    for (const CloudMessage& cloud : clouds) {
      cloud_times.push_back({cloud.stamp, cloud.record_time});
    }
    clocks_ = choose_clocks(cloud_times, inspect_imu(imu, options.accel_unit), options.clock);
    info_.notes.insert(info_.notes.end(), clocks_.notes.begin(), clocks_.notes.end());
    learn(clouds, options);
    source_->select({lidar, imu});
    fixed_notes_ = info_.notes.size();
  }

  std::vector<MessageTime> inspect_imu(const std::string& topic, AccelUnit unit) {
    constexpr std::size_t kCount = 100;
    std::vector<double> norms;
    std::vector<MessageTime> times;
    for (const RecordedMessage& message : source_->first(topic, kCount)) {
      try {
        const ImuSample sample = read_imu(bytes_of(message));
        norms.push_back(sample.accel.norm());
        times.push_back({sample.time, message.record_time});
      } catch (const std::runtime_error&) {
        continue;  // advance() counts it
      }
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
    for (const RecordedMessage& message : source_->first(topic, kCount)) {
      try {
        clouds.push_back(read_cloud(message));
      } catch (const std::runtime_error&) {
        continue;  // advance() counts it
      }
      clouds.back().records.source = topic;
    }
    return ScanStream::select(std::move(clouds));
  }

  void learn(std::vector<CloudMessage> clouds, const SequenceOptions& options) {
    PointTimeOptions times = message_time_options(options);
    if (clocks_.cloud.uses_record() && times.stamp == StampMeaning::kAutomatic) {
      times.stamp = StampMeaning::kEnd;  // a message is recorded when it is complete
    }
    for (CloudMessage& cloud : clouds) {
      cloud.stamp = clocks_.cloud.uses_record() ? cloud.record_time : cloud.stamp;
      cloud.record_time -= std::min(clocks_.imu.uses_record() ? 0.0 : clocks_.imu.offset(), 0.0);
    }
    scan_stream_ = ScanStream(times);
    scan_stream_.learn(clouds);
    info_.has_point_times = scan_stream_.converter().has_point_times();
    info_.origin = scan_stream_.converter().origin();
  }

  /// Reads one message; false at the end. A bad one is counted and left out.
  bool advance() {
    const std::optional<RecordedMessage> message = source_->next();
    if (!message) {
      return false;
    }
    const bool is_imu_message = is_imu(message->type);
    try {
      if (is_imu_message) {
        take_imu(*message);
      } else if (is_cloud(message->type)) {
        take_cloud(*message);
      }
    } catch (const std::runtime_error& error) {
      (is_imu_message ? bad_imu_ : bad_clouds_)
          .add(
              fmt::format("{} at {:.6f} s {}", message->topic, message->record_time, error.what()));
    }
    return true;
  }

  void take_cloud(const RecordedMessage& message) {
    const CloudMessage cloud = read_cloud(message);
    scan_stream_.check(cloud);
    const auto stamp = clocks_.cloud.date({cloud.stamp, message.record_time});
    if (!stamp) {
      refuse_time(cloud.stamp);
    }
    Scan scan = scan_stream_.convert(cloud.records, *stamp);
    if (scan.t_begin <= previous_scan_) {
      refuse_time(cloud.stamp);
    }
    previous_scan_ = scan.t_begin;
    scans_.push_back(std::move(scan));
  }

  void take_imu(const RecordedMessage& message) {
    ImuSample sample = read_imu(bytes_of(message));
    sample.accel *= accel_scale_;
    if (const auto problem = problem_of(sample)) {
      throw std::runtime_error(*problem);
    }
    const auto time = clocks_.imu.date({sample.time, message.record_time});
    if (!time || *time <= previous_imu_) {
      refuse_time(sample.time);
    }
    sample.time = previous_imu_ = *time;
    gaps_.add(sample.time);
    imu_.push_back(sample);
  }

  [[noreturn]] static void refuse_time(double stamp) {
    throw std::runtime_error(
        fmt::format("(stamp {:.6f} s) repeats, is late or jumps in time", stamp));
  }

  std::unique_ptr<MessageSource> source_;
  mutable SequenceInfo info_;
  std::size_t fixed_notes_ = 0;  ///< the notes before those that change while reading
  ScanStream scan_stream_;
  Clocks clocks_;
  LeftOut bad_clouds_{"clouds are"};
  LeftOut bad_imu_{"IMU messages are"};
  double accel_scale_ = 1.0;
  std::deque<Scan> scans_;     ///< read, not handed out
  std::deque<ImuSample> imu_;  ///< read, not handed out
  double previous_scan_ = -std::numeric_limits<double>::infinity();
  double previous_imu_ = -std::numeric_limits<double>::infinity();
  ImuGapMonitor gaps_;
};

}  // namespace

std::unique_ptr<SequenceReader> read_messages(
    const std::string& path,
    std::unique_ptr<MessageSource> source,
    const SequenceOptions& options) {
  return std::make_unique<MessageSequence>(path, std::move(source), options);
}

}  // namespace nvm::io
