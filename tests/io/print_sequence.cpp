// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Prints what open_sequence reads from a path as JSON, for tests that make sequences in Python.

#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "io/sequence/sequence_reader.hpp"

namespace {

nlohmann::json read(const std::string& path) {
  const auto reader = nvm::io::open_sequence(path);
  nlohmann::json scans = nlohmann::json::array();
  nlohmann::json imu = nlohmann::json::array();
  while (const auto scan = reader->next_scan()) {
    nlohmann::json points = nlohmann::json::array();
    for (const auto& point : scan->points) {
      points.push_back({point.x, point.y, point.z, point.intensity, point.dt, point.ring});
    }
    scans.push_back({{"t_begin", scan->t_begin}, {"t_end", scan->t_end}, {"points", points}});
    for (const auto& sample : reader->imu_until(scan->t_end)) {
      imu.push_back(
          {sample.time,
           sample.gyro.x(),
           sample.gyro.y(),
           sample.gyro.z(),
           sample.accel.x(),
           sample.accel.y(),
           sample.accel.z()});
    }
  }
  const auto& info = reader->info();
  return {{"format", info.format}, {"notes", info.notes}, {"scans", scans}, {"imu", imu}};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::cout << read(argc > 1 ? argv[1] : ".").dump() << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}
