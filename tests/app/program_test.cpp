// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "io/map_cloud.hpp"
#include "io/temporary_folder.hpp"
#include "io/trajectory_io.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::app {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int status = -1;
  std::string output;
  std::string errors;
};

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// A folder with scans of a room, and the program to run on it.
class ProgramTest : public test::TemporaryFolder {
 protected:
  static constexpr int kScans = 5;

  void SetUp() override {
    TemporaryFolder::SetUp();
    auto rng = test::rng();
    const test::Room room;
    std::string times;
    for (int k = 0; k < kScans; ++k) {
      Pose T_map_scan = Pose::Identity();
      T_map_scan.translation() << 0.1 * k, 0.0, 0.0;
      truth_.push_back({100.0 + k, T_map_scan});
      const std::string name = "scan" + std::to_string(k) + ".pcd";
      write("scans/" + name, pcd(room.scan(T_map_scan, 3000, 0.003, rng).points));
      times += name + " " + std::to_string(truth_.back().time) + "\n";
    }
    write("timestamps.txt", times);
    io::write_tum(path("poses.tum"), truth_);
    io::write_kitti_poses(path("poses.txt"), truth_);
  }

  static std::string pcd(const std::vector<Eigen::Vector3f>& points) {
    std::ostringstream file;
    file << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
         << points.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << points.size()
         << "\nDATA ascii\n";
    for (const Eigen::Vector3f& point : points) {
      file << point.transpose() << "\n";
    }
    return file.str();
  }

  Outcome nvm(const std::string& arguments) const {
    const std::string command =
        std::string(NVM_PROGRAM) + " " + arguments + " >" + path("output") + " 2>" + path("errors");
    Outcome outcome;
    outcome.status = std::system(command.c_str());
    outcome.output = text_of(path("output"));
    outcome.errors = text_of(path("errors"));
    return outcome;
  }

  // Scans of the test are sparse.
  std::string run(const std::string& more) const {
    return "run " + path("") + " --out " + path("out") +
           " --set normals.min_radius=0.4 --set normals.max_radius=0.6 " + more;
  }

  std::vector<std::string> names_in(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder))) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  // The program says what is wrong in one line, and leaves nothing in the folder.
  void expect_failure(const std::string& arguments, const std::string& message) const {
    const Outcome outcome = nvm(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.errors, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    if (std::filesystem::exists(path("out"))) {
      EXPECT_THAT(names_in("out"), ::testing::IsEmpty());
    }
  }

  Trajectory truth_;
};

TEST_F(ProgramTest, RunWritesTrajectoriesMapAndTimes) {
  const Outcome outcome = nvm(run(""));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("Map update"));
  EXPECT_THAT(
      names_in("out"),
      ::testing::UnorderedElementsAre(
          "trajectory.tum", "trajectory_kitti.txt", "map.ply", "map.nvm", "timing.json"));

  const Trajectory trajectory = io::read_tum(path("out/trajectory.tum"));
  ASSERT_EQ(trajectory.size(), truth_.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_EQ(trajectory[i].time, truth_[i].time);
    EXPECT_TRUE(trajectory[i].pose.isApprox(truth_[i].pose, 0.02)) << i;
  }
  const io::MapCloud map = io::read_map_cloud(path("out/map.ply"));
  EXPECT_GT(map.positions.size(), 1000U);
  EXPECT_EQ(map.normals.size(), map.positions.size());
  EXPECT_EQ(map.sides.size(), map.positions.size());
  const auto timing = nlohmann::json::parse(text_of(path("out/timing.json")));
  EXPECT_EQ(timing["scans"], kScans);
  EXPECT_EQ(timing["frames"].size(), static_cast<std::size_t>(kScans));
  EXPECT_GT(timing["cpu"]["total_ms"]["mean"], 0.0);
}

TEST_F(ProgramTest, EachKindOfMapRuns) {
  for (const std::string type : {"nvm", "voxel", "facing", "reject", "kdtree"}) {
    const Outcome outcome = nvm(run("--set map.type=" + type));
    EXPECT_EQ(outcome.status, 0) << type << ": " << outcome.errors;
    EXPECT_EQ(io::read_tum(path("out/trajectory.tum")).size(), truth_.size());
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(ProgramTest, PrintedConfigurationReadsBack) {
  const Outcome printed = nvm("run --print-config --set map.voxel_size=0.25");
  ASSERT_EQ(printed.status, 0);
  EXPECT_THAT(printed.output, HasSubstr("voxel_size: 0.25"));
  const std::string file = write("config.yaml", printed.output);
  const Outcome again = nvm("run --print-config --config " + file);
  EXPECT_EQ(again.output, printed.output);
}

TEST_F(ProgramTest, BadInputGivesOneLineAndLeavesNothing) {
  expect_failure(run("--set map.voxel_sise=0.2"), "map.voxel_size");
  expect_failure(run("--set map.voxel_size=0"), "map.voxel_size");
  expect_failure(run("--set normals.min_radius=2"), "min_radius");
  expect_failure(run("--set pipeline=fast_lio"), "pipeline=lidar_only");
  expect_failure(run("--set input.T_imu_lidar=[1,2,3]"), "input.T_imu_lidar");
  expect_failure("run " + path("nowhere") + " --out " + path("out"), "nowhere");
  expect_failure("info " + path("poses.tum"), "is not an nvm map");
  expect_failure("info " + path("nowhere.nvm"), "nowhere.nvm");
  expect_failure("run " + path("") + " --out " + path("poses.tum"), "poses.tum");

  const std::string scan = text_of(path("scans/scan3.pcd"));
  write("scans/scan3.pcd", scan.substr(0, scan.size() / 2));
  expect_failure(run(""), "scan3.pcd");
}

TEST_F(ProgramTest, BlindScansAreAnError) {
  for (int k = 0; k < kScans; ++k) {
    write("scans/scan" + std::to_string(k) + ".pcd", pcd({Eigen::Vector3f(1.0F, 0.0F, 0.0F)}));
  }
  expect_failure(run(""), "no scan got a pose");
}

TEST_F(ProgramTest, MapFromPosesInfoAndExport) {
  for (const std::string poses : {"poses.tum", "poses.txt"}) {
    const Outcome outcome =
        nvm("map " + path("") + " --poses " + path(poses) + " --out " + path("map") +
            " --set normals.min_radius=0.4 --set normals.max_radius=0.6");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("5 of 5 scans"));
    EXPECT_EQ(io::read_tum(path("map/trajectory.tum")).size(), 5U);
  }
  const io::MapCloud written = io::read_map_cloud(path("map/map.ply"));
  const std::size_t points = written.positions.size();
  EXPECT_THAT(nvm("info " + path("map/map.nvm")).output, HasSubstr(std::to_string(points)));
  for (const std::string name : {"again.ply", "again.pcd"}) {
    ASSERT_EQ(nvm("export " + path("map/map.nvm") + " --out " + path(name)).status, 0);
    const io::MapCloud cloud = io::read_map_cloud(path(name));
    EXPECT_EQ(cloud.positions.size(), points);
    EXPECT_EQ(cloud.sides, written.sides);
  }
  expect_failure("export " + path("map/map.nvm") + " --out " + path("map.obj"), "map.obj");
  EXPECT_FALSE(std::filesystem::exists(path("map.obj")));
}

TEST_F(ProgramTest, MapNeedsPosesAtTheTimesOfScans) {
  Trajectory late = truth_;
  for (StampedPose& pose : late) {
    pose.time += 1000.0;
  }
  io::write_tum(path("late.tum"), late);
  const std::string map = "map " + path("") + " --out " + path("out") + " --poses ";
  expect_failure(map + path("late.tum"), "late.tum");
  expect_failure(map + path("timestamps.txt"), "timestamps.txt");
}

TEST_F(ProgramTest, SaysWhatItCanDo) {
  const Outcome help = nvm("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"run", "map", "info", "export", "simulate", "evaluate"}) {
    EXPECT_THAT(help.output, HasSubstr(command));
  }
  EXPECT_THAT(nvm("--version").output, HasSubstr("nvm 0."));
}

TEST_F(ProgramTest, WrongArgumentsGiveOneLine) {
  expect_failure("", "a command is required");
  expect_failure("fly", "fly");
  expect_failure("run", "INPUT and --out");
  expect_failure("map " + path(""), "--poses");
  expect_failure("info", "MAP is required");
  expect_failure(run("--fast"), "--fast");
  expect_failure(run("--config nowhere.yaml"), "nowhere.yaml");
  expect_failure("simulate wall6 --out " + path("out"), "no scene \"wall6\"");
  expect_failure("simulate wall5 --duration -1 --out " + path("out"), "--duration");
}

}  // namespace
}  // namespace nvm::app
