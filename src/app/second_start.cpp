// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/second_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "app/failure.hpp"
#include "app/say.hpp"

namespace nvm::app {

namespace {

/// As input.T_imu_lidar takes them.
std::vector<double> numbers_of(const Pose& pose) {
  const Eigen::Vector3d p = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

struct Setting {
  const char* key;
  std::string value;
};

std::vector<Setting> changed_settings(const lio::ImuSetup& from, const lio::ImuSetup& to) {
  std::vector<Setting> settings;
  for (const auto& [key, option] :
       {std::pair("imu.gyro_scale", &lio::ImuInputOptions::gyro_scale),
        std::pair("imu.accel_scale", &lio::ImuInputOptions::accel_scale),
        std::pair("imu.time_offset", &lio::ImuInputOptions::time_offset)}) {
    if (from.input.*option != to.input.*option) {
      settings.push_back({key, fmt::format("{:.4g}", to.input.*option)});
    }
  }
  if (!(from.T_imu_lidar.linear() == to.T_imu_lidar.linear())) {
    settings.push_back(
        {"input.T_imu_lidar",
         fmt::format("[{:.5g}]", fmt::join(numbers_of(to.T_imu_lidar), ", "))});
  }
  return settings;
}

/// Whether both are the same but for what the next seconds refine.
bool is_settled(const lio::ImuSetup& then, const lio::ImuSetup& now) {
  constexpr double kOffset = 1e-3;  // [s]
  constexpr double kTurn = 5e-3;    // [rad]
  const Eigen::Matrix3d turn = then.T_imu_lidar.linear().transpose() * now.T_imu_lidar.linear();
  return std::abs(now.input.time_offset - then.input.time_offset) <= kOffset &&
         so3_log(turn).norm() <= kTurn;
}

}  // namespace

SecondStart::SecondStart(const std::string& input, std::string file) : file_(std::move(file)) {
  std::error_code ignored;  // who opens the input says what is wrong with it
  is_pipe_ = std::filesystem::is_fifo(input, ignored);
  is_begun_ = is_pipe_ && file_.empty();
}

bool SecondStart::is_due(const lio::Pipeline& pipeline, double time) {
  constexpr double kToSettle = 5.0;   // what is found gets better and better [s]
  constexpr double kLongest = 300.0;  // of the run, that is thrown away [s]
  first_ = first_.value_or(time);
  const auto better =
      is_begun_ || time > *first_ + kLongest ? std::nullopt : pipeline.better_imu_setup();
  if (!better) {
    begin_.reset();
  } else if (!begin_ || !is_settled(then_, *better)) {
    begin_ = time;
    then_ = *better;
  }
  better_ = better.value_or(better_);
  return begin_ && time >= *begin_ + kToSettle;
}

void SecondStart::begin(RunOptions& options) {
  lio::ImuInputOptions& input = options.pipeline.inertial.imu_input;
  Pose& T_imu_lidar = options.pipeline.inertial.T_imu_lidar;
  std::string words;
  std::string lines;
  for (const auto& [key, value] : changed_settings({input, T_imu_lidar}, better_)) {
    words += fmt::format("{}{}={}", words.empty() ? "" : ", ", key, value);
    lines += fmt::format("{}={}\n", key, value);
  }
  const std::string note =
      "note: the run begins again, with " + words + ", so that it holds from the first scan on";
  is_begun_ = true;
  if (is_pipe_) {
    std::ofstream(file_) << lines;
    throw Failure(note, kExitAgain);
  }
  say(note);
  input = better_.input;
  if (!(better_.T_imu_lidar.linear() == T_imu_lidar.linear())) {
    options.input.T_imu_lidar = numbers_of(better_.T_imu_lidar);
  }
}

}  // namespace nvm::app
