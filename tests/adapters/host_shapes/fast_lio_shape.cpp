// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What an odometry in the shape of FAST_LIO, with its default settings, makes of a sequence with
// its own map of bare points and with nvm's, as folders that nvm evaluate reads: nvm_fast_lio_shape
// SEQUENCE OWN_OUT NVM_OUT
#include <exception>
#include <filesystem>
#include <iostream>

#include "adapters/host_shapes/host_run.hpp"
#include "io/result/map_cloud.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace {

void write(const nvm::test::HostOutput& output, const std::string& folder) {
  nvm::io::MapCloud cloud;
  for (const nvm::eval::OrientedPoint& point : output.cloud.points) {
    cloud.positions.push_back(point.position);
    cloud.normals.push_back(point.normal.cast<float>());
  }
  std::filesystem::create_directories(folder);
  nvm::io::write_map_cloud(folder + "/map.ply", cloud);
  nvm::io::write_tum(folder + "/trajectory.tum", output.trajectory);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace nvm::test;
  if (argc != 4) {
    std::cerr << "usage: " << argv[0] << " SEQUENCE OWN_OUT NVM_OUT\n";
    return 2;
  }
  try {
    const HostShape shape = shape_of(HostFamily::kFastLio);
    write(drive_host(argv[1], shape, HostMapKind::kOwn), argv[2]);
    write(drive_host(argv[1], shape, HostMapKind::kPatchB), argv[3]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
