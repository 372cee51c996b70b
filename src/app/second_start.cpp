// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/second_start.hpp"

#include <fmt/format.h>

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

struct Setting {
  const char* key;
  double value;
};

std::vector<Setting> changed_settings(
    const lio::ImuInputOptions& from, const lio::ImuInputOptions& to) {
  std::vector<Setting> settings;
  for (const auto& [key, option] :
       {std::pair("imu.gyro_scale", &lio::ImuInputOptions::gyro_scale),
        std::pair("imu.accel_scale", &lio::ImuInputOptions::accel_scale),
        std::pair("imu.time_offset", &lio::ImuInputOptions::time_offset)}) {
    if (from.*option != to.*option) {
      settings.push_back({key, to.*option});
    }
  }
  return settings;
}

}  // namespace

SecondStart::SecondStart(const std::string& input, std::string file) : file_(std::move(file)) {
  std::error_code ignored;  // who opens the input says what is wrong with it
  is_pipe_ = std::filesystem::is_fifo(input, ignored);
  is_begun_ = is_pipe_ && file_.empty();
}

bool SecondStart::is_due(const lio::Pipeline& pipeline, double time) {
  constexpr double kToSettle = 5.0;   // clocks are told better and better [s]
  constexpr double kSettled = 1e-3;   // [s]
  constexpr double kLongest = 300.0;  // of the run, that is thrown away [s]
  first_ = first_.value_or(time);
  const auto better =
      is_begun_ || time > *first_ + kLongest ? std::nullopt : pipeline.better_imu_input();
  if (!better) {
    begin_.reset();
  } else if (!begin_ || std::abs(better->time_offset - offset_then_) > kSettled) {
    begin_ = time;
    offset_then_ = better->time_offset;
  }
  better_ = better.value_or(better_);
  return begin_ && time >= *begin_ + kToSettle;
}

void SecondStart::begin(lio::ImuInputOptions& imu) {
  std::string words;
  std::string lines;
  for (const auto& [key, value] : changed_settings(imu, better_)) {
    words += fmt::format("{}{}={:.4g}", words.empty() ? "" : ", ", key, value);
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
  imu = better_;
}

}  // namespace nvm::app
