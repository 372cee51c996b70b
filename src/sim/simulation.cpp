// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/sequence/nvm_sequence_writer.hpp"
#include "nvm/core/executor_tbb.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "sim/clearance.hpp"
#include "sim/sequence_json.hpp"

namespace nvm::sim {
namespace {

constexpr std::size_t kScansAtOnce = 32;    ///< that are held in memory
constexpr double kGroundTruthRate = 100.0;  ///< [Hz]

/// True poses at kGroundTruthRate and at the end of each scan.
Trajectory true_trajectory(const Motion& motion, std::size_t scans, double scan_rate) {
  std::vector<double> times;
  for (std::size_t i = 0; static_cast<double>(i) / kGroundTruthRate <= motion.duration(); ++i) {
    times.push_back(static_cast<double>(i) / kGroundTruthRate);
  }
  for (std::size_t i = 1; i <= scans; ++i) {
    times.push_back(static_cast<double>(i) / scan_rate);
  }
  std::sort(times.begin(), times.end());
  constexpr double kSameTime = 1e-9;
  const auto last =
      std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < kSameTime; });
  Trajectory trajectory;
  for (auto time = times.begin(); time != last; ++time) {
    trajectory.push_back({*time, motion.pose(*time)});
  }
  return trajectory;
}

double length_of(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].pose.translation() - trajectory[i - 1].pose.translation()).norm();
  }
  return length;
}

/// Adds the scans in order, computing some of them at once.
void write_scans(
    const Lidar& lidar,
    std::size_t scans,
    const std::function<void()>& check,
    io::NvmSequenceWriter& writer,
    SurfaceHits& hits) {
  for (std::size_t first = 0; first < scans; first += kScansAtOnce) {
    std::vector<SimulatedScan> batch(std::min(kScansAtOnce, scans - first));
    TbbExecutor().for_blocks(batch.size(), 1, [&](std::size_t begin, std::size_t) {
      batch[begin] = lidar.scan(first + begin);
    });
    for (const SimulatedScan& simulated : batch) {
      writer.add_scan(simulated.scan);
      hits.count(simulated);
    }
    check();
  }
}

}  // namespace

SimulationSummary simulate(
    const Scene& scene,
    const SimulationOptions& options,
    const std::string& folder,
    const std::function<void()>& check) {
  const SensorModel& sensor = find_sensor(options.sensor);
  const Motion motion(scene.route, options.motion, options.seed, options.duration);
  const RayCaster rays(scene);
  check_clearance(scene, rays, motion, options.motion.clearance);
  const Lidar lidar(sensor, options.lidar, {scene, rays, motion}, options.seed);

  io::NvmSequenceWriter writer(folder);
  SequenceFacts facts;
  // A scan counts when it ends in time; the small addend forgives the rounding of the product.
  facts.scans =
      static_cast<std::size_t>(std::floor(motion.duration() * options.lidar.scan_rate + 1e-6));
  SurfaceHits hits(scene);
  write_scans(lidar, facts.scans, check, writer, hits);
  const auto imu = simulate_imu(motion, options.imu, options.seed);
  writer.write_imu(imu);
  const Trajectory truth = true_trajectory(motion, facts.scans, options.lidar.scan_rate);
  writer.write_groundtruth(truth);
  facts.points = hits.points();
  facts.imu_samples = imu.size();
  facts.T_imu_lidar = lidar.extrinsic();
  writer.write_text("meta.json", meta_json(scene, options, facts));
  writer.write_text("scene.json", scene_json(scene, hits));
  writer.commit();
  return {facts.scans, facts.points, imu.size(), motion.duration(), length_of(truth)};
}

}  // namespace nvm::sim
