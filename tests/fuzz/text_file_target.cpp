// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Trajectories, times and IMU readings of any text are refused, or read in order of time.
#include <limits>
#include <vector>

#include "fuzz_target.hpp"
#include "io/sequence/imu_file.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace {

void read_trajectory(const std::string& path) {
  const nvm::Trajectory trajectory = nvm::io::read_tum(path);
  double previous = -std::numeric_limits<double>::infinity();
  for (const nvm::StampedPose& pose : trajectory) {
    nvm::fuzz::require(pose.time > previous, "poses are in order of time");
    nvm::fuzz::require(pose.pose.matrix().allFinite(), "poses are finite");
    previous = pose.time;
  }
}

void read_imu(const std::string& path) {
  nvm::io::ImuFile file(path);
  double previous = -std::numeric_limits<double>::infinity();
  for (const auto& sample : file.until(std::numeric_limits<double>::infinity())) {
    nvm::fuzz::require(sample.time > previous, "readings are in order of time");
    nvm::fuzz::require(!nvm::io::problem_of(sample), "readings are such as an IMU may give");
    previous = sample.time;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nvm::fuzz::Input input(data, size);
  const int kind = input.below(4);
  const std::string path = nvm::fuzz::folder().write("fuzzed.txt", input.rest());
  nvm::fuzz::accepts([&] {
    switch (kind) {
      case 0:
        return read_trajectory(path);
      case 1:
        return read_imu(path);
      case 2:
        return void(nvm::io::read_kitti_poses(path, {0.0, 1.0, 2.0}));
      default:
        return void(nvm::io::read_times(path));
    }
  });
  return 0;
}
