// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "app/doing.hpp"
#include "config/schema.hpp"
#include "nvm/map/storage/map_capacity.hpp"

namespace nvm::app {

namespace {

void bind_input(config::Schema& schema, RunOptions& options) {
  io::SequenceOptions& input = options.input;
  schema.add("lidar_topic", input.lidar_topic, "Of a bag; empty: the first with point clouds");
  schema.add("imu_topic", input.imu_topic, "Of a bag; empty: the first with IMU messages");
  schema.add_choice<io::AccelUnit>(
      "accel_unit",
      input.accel_unit,
      {{"auto", io::AccelUnit::kAutomatic},
       {"m/s2", io::AccelUnit::kMetrePerSquareSecond},
       {"g", io::AccelUnit::kStandardGravity}},
      "Of a bag's IMU");
  schema.add_choice<io::TimeUnit>(
      "point_time_unit",
      input.point_time_unit,
      {{"auto", io::TimeUnit::kAutomatic},
       {"s", io::TimeUnit::kSecond},
       {"ms", io::TimeUnit::kMillisecond},
       {"us", io::TimeUnit::kMicrosecond},
       {"ns", io::TimeUnit::kNanosecond},
       {"sweep", io::TimeUnit::kSweep}},
      "Of the points' time field; sweep: 0 to 1 from begin to end");
  schema.add(
      "point_time_field",
      input.point_time_field,
      "Its name; azimuth: raw scans of a spinning sensor; none: no times; empty: automatic");
  schema.add_choice<io::StampMeaning>(
      "stamp",
      input.stamp,
      {{"auto", io::StampMeaning::kAutomatic},
       {"begin", io::StampMeaning::kBegin},
       {"end", io::StampMeaning::kEnd}},
      "What a scan's stamp dates: the begin or the end of its sweep");
  schema.add_choice<io::ClockChoice>(
      "clock",
      input.clock,
      {{"auto", io::ClockChoice::kAutomatic},
       {"header", io::ClockChoice::kHeader},
       {"record", io::ClockChoice::kRecord}},
      "Of a bag's messages: the times in their headers or those of recording");
  schema.add(
      "bin_fields", input.bin_fields, {0.0, 6.0}, "Numbers a point in .bin files; 0: as they look");
  schema.add("scan_rate", input.scan_rate, {0.01, 1000.0}, "Of files without any time [Hz]");
  schema.add(
      "T_imu_lidar", options.T_imu_lidar, "x y z [m] qx qy qz qw; empty: as the sequence tells");
}

}  // namespace

void add_run_options(CLI::App& command, RunOptionArguments& arguments) {
  command.add_option("--config", arguments.file, "YAML file of options")->check(CLI::ExistingFile);
  command.add_option("--set", arguments.overrides, "An option, as in map.voxel_size=0.2")
      ->type_name("KEY=VALUE");
  command.add_flag(
      "--print-config", arguments.prints_options, "Print all options as YAML, and do nothing else");
}

std::optional<RunOptions> read_run_options(const RunOptionArguments& arguments) {
  RunOptions options;
  config::Schema schema;
  lio::bind(schema, options.pipeline);
  bind_input(schema.section("input", "How to read the sequence"), options);
  if (!arguments.file.empty()) {
    schema.read_file(arguments.file);
  }
  for (const std::string& assignment : arguments.overrides) {
    schema.set(assignment);
  }
  if (arguments.prints_options) {
    fmt::print("{}", schema.to_yaml());
    return std::nullopt;
  }
  return options;
}

std::unique_ptr<io::SequenceReader> open_input(
    const std::string& input, const io::SequenceOptions& options) {
  return doing("opening " + input, [&] { return io::open_sequence(input, options); });
}

std::string making_map(const MapOptions& options) {
  constexpr double kBytesPerMegabyte = 1e6;
  return fmt::format(
      "making a map of map.capacity={} voxels, for which it needs {:.0f} MB",
      options.capacity,
      static_cast<double>(detail::map_capacity(options).bytes()) / kBytesPerMegabyte);
}

Pose lidar_extrinsic(const RunOptions& options, const io::SequenceInfo& info) {
  const std::vector<double>& numbers = options.T_imu_lidar;
  if (numbers.empty()) {
    if (info.has_imu && !info.has_T_imu_lidar) {
      fmt::print(
          stderr,
          "nvm: note: the sequence does not tell T_imu_lidar: the identity is assumed; "
          "input.T_imu_lidar sets it\n");
    }
    return info.T_imu_lidar;
  }
  constexpr double kMaxLengthError = 0.01;
  if (numbers.size() == 7) {
    const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
    if (std::abs(q.norm() - 1.0) <= kMaxLengthError) {
      Pose pose = Pose::Identity();
      pose.linear() = q.normalized().toRotationMatrix();
      pose.translation() << numbers[0], numbers[1], numbers[2];
      return pose;
    }
  }
  throw std::invalid_argument(
      "input.T_imu_lidar must be seven numbers x y z qx qy qz qw with a unit quaternion");
}

}  // namespace nvm::app
