// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/simulation.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "config/schema.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"
#include "sim/scene_file.hpp"

namespace nvm::sim {
namespace {

namespace fs = std::filesystem;

/// The bytes of every file below `folder`.
std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      std::ifstream stream(entry.path(), std::ios::binary);
      files[fs::relative(entry.path(), folder).string()] =
          std::string(std::istreambuf_iterator<char>(stream), {});
    }
  }
  return files;
}

class Simulation : public test::TemporaryFolder {
 protected:
  /// A short walk with everything that draws random numbers switched on.
  SimulationOptions options() const {
    SimulationOptions result = options_for("mid360");
    result.duration = 2.0;
    result.lidar.mixed_pixels = 0.5;
    result.lidar.outliers = 0.01;
    result.lidar.dropouts = 0.01;
    return result;
  }

  Scene scene_ = load_scene("wall5");
};

TEST_F(Simulation, WritesTheSameBytesForAnyNumberOfThreads) {
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    simulate(scene_, options(), path(std::to_string(threads)));
  }
  const auto one = contents(path("1"));
  EXPECT_EQ(one.size(), 20U + 5U);
  EXPECT_TRUE(one == contents(path("4")));
}

TEST_F(Simulation, DiffersBySeed) {
  SimulationOptions other = options();
  other.seed = 2;
  simulate(scene_, options(), path("a"));
  simulate(scene_, other, path("b"));
  const auto a = contents(path("a"));
  const auto b = contents(path("b"));
  EXPECT_NE(a.at("imu.csv"), b.at("imu.csv"));
  EXPECT_NE(a.at("scans/000003.bin"), b.at("scans/000003.bin"));
  EXPECT_NE(a.at("groundtruth.tum"), b.at("groundtruth.tum"));
}

TEST_F(Simulation, IsReadBackAsItWasSimulated) {
  const SimulationSummary summary = simulate(scene_, options(), path("sequence"));
  const auto reader = io::open_sequence(path("sequence"));
  EXPECT_EQ(reader->info().scan_count, 20U);
  EXPECT_TRUE(reader->info().has_imu);
  EXPECT_TRUE(reader->info().has_point_times);
  EXPECT_NEAR(reader->info().T_imu_lidar.translation().z(), 0.0441, 1e-12);
  EXPECT_EQ(reader->imu_until(10.0).size(), summary.imu_samples);
  std::size_t points = 0;
  std::size_t scans = 0;
  while (const auto scan = reader->next_scan()) {
    EXPECT_NEAR(scan->t_begin, 0.1 * static_cast<double>(scans), 1e-9);
    points += scan->points.size();
    ++scans;
  }
  EXPECT_EQ(scans, summary.scans);
  EXPECT_EQ(points, summary.points);
}

TEST_F(Simulation, LeavesNothingWhenItFails) {
  Scene blocked = scene_;
  blocked.boxes.push_back(scene_.boxes.front());
  blocked.boxes.back().T_world_box.translation() =
      blocked.route.waypoints.front() + Eigen::Vector3d(0.5, 0.0, 1.3);
  blocked.boxes.back().half_size.setConstant(0.3);
  blocked.boxes.back().name = "crate";
  const std::string error =
      test::runtime_error_of([&] { simulate(blocked, options(), path("sequence")); });
  EXPECT_NE(error.find("\"crate\""), std::string::npos) << error;
  EXPECT_TRUE(contents(path("")).empty());
}

TEST_F(Simulation, NeverWritesIntoAFolderThatExists) {
  write("sequence/precious.txt", "data");
  const std::string error =
      test::runtime_error_of([&] { simulate(scene_, options(), path("sequence")); });
  EXPECT_NE(error.find("exists"), std::string::npos) << error;
  EXPECT_EQ(contents(path("")).size(), 1U);
}

TEST_F(Simulation, RefusesUnknownSensorsAndOptions) {
  EXPECT_THROW(options_for("vlp15"), std::invalid_argument);
  SimulationOptions changed = options();
  config::Schema schema;
  bind(schema, changed);
  EXPECT_THROW(schema.set("lidar.outliers=1.5"), std::invalid_argument);
  EXPECT_THROW(schema.set("lidar.outlier=0.5"), std::invalid_argument);
  schema.set("imu.gyro.noise_density=0.5");
  EXPECT_EQ(changed.imu.gyro.noise_density, 0.5);
}

}  // namespace
}  // namespace nvm::sim
