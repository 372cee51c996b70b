// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/host_shapes/host_run.hpp"

#include <cmath>
#include <ctime>
#include <sstream>

#include "eval/report/evaluation.hpp"
#include "io/sequence/nvm_sequence_reader.hpp"

namespace nvm::test {
namespace {

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Every tenth point of the last scan, with the direction to the sensor for a normal.
void add_scan(const HostOdometry& host, eval::OrientedCloud& cloud) {
  constexpr std::size_t kEvery = 10;
  const Pose T_map_lidar = host.T_map_lidar();
  for (std::size_t i = 0; i < host.scan().size(); i += kEvery) {
    const Eigen::Vector3d point = T_map_lidar * host.scan().points[i].cast<double>();
    cloud.points.push_back({point, (T_map_lidar.translation() - point).normalized()});
  }
}

void evaluate(
    const Trajectory& trajectory,
    eval::OrientedCloud cloud,
    const std::string& folder,
    HostRun& run) {
  const eval::Truth truth = eval::read_truth(folder);
  const eval::Association association = eval::associate(trajectory, truth.trajectory);
  const eval::Alignment alignment = eval::align(association.pairs, eval::AlignmentKind::kSe3);
  const std::vector<double> errors = eval::position_errors(association.pairs, alignment);
  double sq_sum = 0.0;
  for (const double error : errors) {
    sq_sum += error * error;
  }
  run.ate_mm = 1e3 * std::sqrt(sq_sum / static_cast<double>(errors.size()));
  const auto walls = eval::evaluate_walls(
      eval::transformed(std::move(cloud), alignment.T_world_map), truth.walls, {});
  const eval::WallSummary summary = eval::summarize(walls);
  run.walls = summary.measured;
  run.wall_mm = summary.absolute_error ? 1e3 * summary.absolute_error->mean : 0.0;
}

}  // namespace

HostOutput drive_host(const std::string& folder, const HostShape& shape, HostMapKind kind) {
  const auto sequence = io::open_nvm_sequence(folder);
  HostOdometry host(shape, kind, sequence->info().T_imu_lidar);
  constexpr double kAhead = 0.01;  // the reading after the scan's end [s]
  HostOutput output;
  std::size_t scans = 0;
  while (const std::optional<Scan> scan = sequence->next_scan()) {
    for (const ImuSample& sample : sequence->imu_until(scan->t_end + kAhead)) {
      host.add_imu(sample);
    }
    const double begin = cpu_ms();
    const std::optional<Pose> pose = host.process(*scan);
    output.cpu_ms += cpu_ms() - begin;
    ++scans;
    if (pose) {
      output.trajectory.push_back({scan->t_end, *pose});
      add_scan(host, output.cloud);
    }
  }
  output.cpu_ms /= static_cast<double>(scans);
  output.map_points = host.map().size();
  return output;
}

HostRun run_host(const std::string& folder, const HostShape& shape, HostMapKind kind) {
  HostOutput output = drive_host(folder, shape, kind);
  HostRun run;
  run.cpu_ms = output.cpu_ms;
  run.map_points = output.map_points;
  evaluate(output.trajectory, std::move(output.cloud), folder, run);
  return run;
}

std::string describe(const HostRun& run) {
  std::ostringstream text;
  text.precision(3);
  text << "ATE " << run.ate_mm << " mm, walls " << run.wall_mm << " mm (" << run.walls << "), "
       << run.map_points << " points, " << run.cpu_ms << " ms per scan";
  return text.str();
}

}  // namespace nvm::test
