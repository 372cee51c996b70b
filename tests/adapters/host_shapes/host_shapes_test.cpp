// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <string>

#include "adapters/host_shapes/host_run.hpp"
#include "io/temporary_folder.hpp"
#include "sim/scene_file.hpp"
#include "sim/simulation.hpp"

namespace nvm::test {
namespace {

/// Writes a walk around a partition of 5 cm, with an IMU twice as noisy as the simulator's.
void simulate_partition(const std::string& sensor, const std::string& folder) {
  sim::SimulationOptions options = sim::options_for(sensor);
  options.imu.gyro.noise_density *= 2.0;
  options.imu.accelerometer.noise_density *= 2.0;
  sim::simulate(
      sim::load_scene(NVM_SOURCE_DIR "/tests/adapters/host_shapes/partition.yaml"),
      options,
      folder);
}

/// The most that patch B may err, as a share of what the host's own map does.
struct Shares {
  double poses, walls;
};

Shares shares_of(HostFamily family) {
  return family == HostFamily::kCtLio ? Shares{0.85, 0.6} : Shares{0.3, 0.15};
}

/// Better than the host's own map in poses and in walls, and not many times as large: a host adds
/// each point whose search finds nothing, and what is beside an edge finds nothing.
void expect_gain(const HostRun& own, const HostRun& nvm, const Shares& shares) {
  EXPECT_LE(nvm.ate_mm, shares.poses * own.ate_mm);
  EXPECT_EQ(nvm.walls, own.walls);
  EXPECT_LE(nvm.wall_mm, shares.walls * own.wall_mm);
  EXPECT_LT(nvm.map_points, 10 * own.map_points);
}

class HostShapes : public TemporaryFolder, public testing::WithParamInterface<const char*> {};

TEST_P(HostShapes, GainByPatchB) {
  const std::string sequence = path("sequence");
  simulate_partition(GetParam(), sequence);
  for (const HostFamily family :
       {HostFamily::kFastLio, HostFamily::kFasterLio, HostFamily::kCtLio}) {
    const HostShape shape = shape_of(family);
    const HostRun own = run_host(sequence, shape, HostMapKind::kOwn);
    const HostRun nvm = run_host(sequence, shape, HostMapKind::kPatchB);
    SCOPED_TRACE(std::string(name(family)) + ", own: " + describe(own) + "; nvm: " + describe(nvm));
    EXPECT_LT(own.ate_mm, 100.0) << "the host-shaped odometry itself has failed";
    expect_gain(own, nvm, shares_of(family));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sensors, HostShapes, testing::Values("mid360", "vlp16"), [](const auto& sensor) {
      return std::string(sensor.param);
    });

}  // namespace
}  // namespace nvm::test
