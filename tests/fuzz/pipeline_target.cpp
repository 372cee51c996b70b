// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Scans and IMU readings of a walk through a room, some of them spoilt in any way, in any order, to
// any pipeline: what it believes is a pose.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "fuzz_target.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "lio/room_recording.hpp"

namespace {

using nvm::ImuSample;
using nvm::Scan;
using nvm::fuzz::Input;
using nvm::fuzz::require;
using nvm::lio::FrameResult;
using nvm::lio::Pipeline;
using nvm::lio::PipelineType;

constexpr int kMaxScans = 40;

/// A number that is far from any other.
double take_odd_number(Input& input) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 14> kOdd = {
      0.0,
      kInf,
      -kInf,
      std::numeric_limits<double>::quiet_NaN(),
      1e300,
      -1e300,
      1e-300,
      1e9,
      -1e9,
      1.7e9,
      500.0,
      -30.0,
      1e18,
      4e4};
  return kOdd[static_cast<std::size_t>(input.below(static_cast<int>(kOdd.size())))];
}

nvm::lio::PipelineOptions take_options(Input& input) {
  constexpr std::array<PipelineType, 4> kTypes = {
      PipelineType::kFastLio,
      PipelineType::kCtLio,
      PipelineType::kCtLioContinuous,
      PipelineType::kLidarOnly};
  nvm::lio::PipelineOptions options;
  options.type = kTypes[static_cast<std::size_t>(input.below(4))];
  const int bits = input.take<std::uint8_t>();
  options.coupling = (bits & 1) != 0 ? nvm::lio::Coupling::kLoose : nvm::lio::Coupling::kTight;
  options.map.capacity = (bits & 2) != 0 ? 100 : 20'000;
  options.map.voxel_size = (bits & 4) != 0 ? 1.0 : 0.3;
  options.inertial.initializer.moving_start_after = (bits & 8) != 0 ? -1.0 : 0.3;
  options.inertial.initializer.still_duration = 0.2;
  options.inertial.max_imu_gap = (bits & 16) != 0 ? 0.6 : 0.0;
  options.inertial.keypoints.max_count = 300;
  options.inertial.imu_input.time_offset = (bits & 32) != 0 ? 0.1 : 0.0;
  return options;
}

void check(const FrameResult& frame) {
  require(
      std::isfinite(frame.residual_rms) && std::isfinite(frame.inlier_share), "counts are numbers");
  if (nvm::lio::is_believed(frame.status)) {
    require(std::isfinite(frame.time), "a pose has a time");
    require(nvm::is_rigid(frame.T_map_body), "what is believed is a pose");
    require(nvm::is_rigid(frame.T_map_lidar), "and so is that of the LiDAR");
    require(frame.pose_covariance.allFinite(), "how sure it is are numbers");
    require(frame.velocity.allFinite() && frame.angular_rate.allFinite(), "a motion is of numbers");
  }
}

/// Feeds a recording to a pipeline, spoilt as an input says.
class Player {
 public:
  explicit Player(Input& input)
      : input_(input), options_(take_options(input)), pipeline_(nvm::lio::make_pipeline(options_)) {
    recording_.points_per_scan = 900;
    recording_.imu_step = 0.01;
    recording_.motion.start = input.below(2) == 0 ? 0.5 : -10.0;
  }

  void play() {
    for (int count = 0; count < kMaxScans && !input_.empty(); ++count) {
      step(input_.take<std::uint8_t>());
    }
    for (const std::string& finding : pipeline_->findings()) {
      require(!finding.empty(), "a finding says something");
    }
    require(pipeline_->map().points().size() < 1'000'000, "the map keeps within its capacity");
  }

 private:
  void step(int what) {
    std::vector<ImuSample> readings = recording_.imu(index_);
    Scan scan = recording_.scan(index_);
    if ((what & 1) != 0) {
      spoil(readings);
    }
    if ((what & 2) != 0) {
      spoil(scan);
    }
    if ((what & 4) != 0) {
      shift_ += input_.below(2) == 0 ? take_odd_number(input_) : 0.01 * input_.below(100);
    }
    for (ImuSample& reading : readings) {
      reading.time += (what & 8) != 0 ? 0.0 : shift_;
      pipeline_->add_imu(reading);
    }
    scan.t_begin += shift_;
    scan.t_end += shift_;
    check(pipeline_->process(scan));
    index_ += (what & 16) != 0 ? input_.below(20) : 1;
  }

  void spoil(std::vector<ImuSample>& readings) {
    const int kind = input_.below(4);
    const auto begin = static_cast<std::size_t>(input_.below(8));
    const auto end = std::min(begin + static_cast<std::size_t>(input_.below(8)), readings.size());
    const int axis = input_.below(7);
    const double value = take_odd_number(input_);
    for (std::size_t i = begin; i < end; ++i) {
      (axis == 6  ? readings[i].time
       : axis < 3 ? readings[i].gyro[axis]
                  : readings[i].accel[axis - 3]) = value;
    }
    if (kind == 1) {
      std::reverse(readings.begin(), readings.end());
    } else if (kind == 2) {
      readings.clear();
    }
  }

  void spoil(Scan& scan) {
    const std::size_t size = scan.points.size();
    const auto every = static_cast<std::size_t>(input_.below(60)) + 1;
    const double value = take_odd_number(input_);
    switch (input_.below(8)) {
      case 0:
        scan.points.clear();
        return;
      case 1:
        scan.points.resize(std::min(size, every));
        return;
      case 2:
        scan.t_begin = value;
        return;
      case 3:
        scan.t_end = value;
        return;
      case 4:
        std::reverse(scan.points.begin(), scan.points.end());
        return;
      default:
        break;
    }
    const int field = input_.below(4);
    for (std::size_t i = 0; i < size; i += every) {
      float* const fields[] = {
          &scan.points[i].x, &scan.points[i].y, &scan.points[i].z, &scan.points[i].dt};
      *fields[field] = static_cast<float>(value);
    }
  }

  Input& input_;
  nvm::lio::PipelineOptions options_;
  std::unique_ptr<Pipeline> pipeline_;
  nvm::test::RoomRecording recording_;
  double shift_ = 0.0;  ///< of the clock [s]
  int index_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Player(input).play();
  return 0;
}
