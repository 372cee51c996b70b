// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "io/cloud/point_records.hpp"
#include "io/result/map_cloud.hpp"
#include "io/sequence/trajectory_io.hpp"
#include "program_fixture.hpp"

namespace nvm::app {
namespace {

using test::Outcome;
using test::text_of;
using ::testing::HasSubstr;

class ProgramTest : public test::ProgramFixture {};

TEST_F(ProgramTest, RunWritesTrajectoriesMapAndTimes) {
  const Outcome outcome = nvm(run(""));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("Map update"));
  EXPECT_THAT(
      names_in("out"),
      ::testing::UnorderedElementsAre(
          "trajectory.tum",
          "trajectory_kitti.txt",
          "frames.csv",
          "map.ply",
          "map.nvm",
          "session.nvms",
          "timing.json"));

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
  const std::string frames = text_of(path("out/frames.csv"));
  EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'), 1 + kScans);
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

// The documentations among the comments of a configuration: what comes before "Allowed:".
std::vector<std::string> documentations(const std::string& yaml) {
  std::vector<std::string> found;
  std::string comment;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (line.compare(begin, 2, "# ") == 0) {
      comment += (comment.empty() ? "" : " ") + line.substr(begin + 2);
    } else {
      if (const std::size_t end = comment.find(" Allowed:"); end != std::string::npos) {
        found.push_back(comment.substr(0, end));
      }
      comment.clear();
    }
  }
  return found;
}

TEST_F(ProgramTest, PrintedOptionsAreExplainedInWholePhrases) {
  std::string run = nvm("run --print-config").output;
  const std::size_t map = run.find("# The map.\n");
  run.erase(map, run.find("# Normals of a scan.\n") - map);  // which nvm::MapOptions explains
  for (const std::string& yaml : {run, nvm("simulate --print-options").output}) {
    const std::vector<std::string> texts = documentations(yaml);
    EXPECT_GT(texts.size(), 25U);
    for (const std::string& text : texts) {
      const std::string phrase = text.substr(0, text.find(" ["));
      EXPECT_GE(std::count(phrase.begin(), phrase.end(), ' '), 3) << text;
      EXPECT_THAT(phrase, ::testing::MatchesRegex("[A-Z][^:]*|With coupling: [a-z].*")) << text;
    }
  }
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
  EXPECT_EQ(io::read_points(path("map/map.ply")).find({"intensity"}), nullptr) << "scans have none";
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

TEST_F(ProgramTest, MapLeavesOutScansInGapsOfThePoses) {
  const std::string map = "map " + path("") + " --out " + path("map") +
                          " --set normals.min_radius=0.4 --set normals.max_radius=0.6 --poses ";
  Trajectory holed = truth_;
  holed.erase(holed.begin() + 2);
  for (const double far : {100.0, 101.0, 102.0}) {  // of steps as between the others
    holed.push_back({truth_.back().time + far, truth_.back().pose});
  }
  io::write_tum(path("holed.tum"), holed);
  const Outcome outcome = nvm(map + path("holed.tum") + " --max-gap 0.15");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("4 of 5 scans placed"));
  EXPECT_THAT(outcome.errors, HasSubstr("warning: 1 scans are left out, the first at "));
  EXPECT_THAT(nvm(map + path("holed.tum") + " --max-gap 10").output, HasSubstr("5 of 5 scans"));
}

TEST_F(ProgramTest, SaysWhatItCanDo) {
  const Outcome help = nvm("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"run", "map", "info", "export", "simulate", "evaluate"}) {
    EXPECT_THAT(help.output, HasSubstr(command));
  }
  EXPECT_EQ(nvm("").output, help.output);
  EXPECT_EQ(nvm("").status, 0);
  EXPECT_THAT(nvm("--version").output, HasSubstr("nvm 0."));
}

TEST_F(ProgramTest, WrongArgumentsGiveOneLine) {
  expect_failure("fly", "no command fly (see");
  expect_failure("rnu", "did you mean run?");
  expect_failure("exprot a", "did you mean export?");
  expect_failure("--versoin", "no option --versoin; did you mean --version? (see nvm --help)");
  expect_failure("run a --outt=b", "no option --outt; did you mean --out? (see nvm run --help)");
  expect_failure(
      "evaluate a --alin none", "nvm evaluate has no option --alin; did you mean --align?");
  expect_failure("run a --voxels 3", "nvm run has no option --voxels (see");
  expect_failure("run a b --out c", "nvm run has no use for the argument b");
  expect_failure("run", "INPUT and --out");
  expect_failure("map " + path(""), "--poses");
  expect_failure("info", "MAP is required");
  expect_failure(run("--fast"), "--fast");
  expect_failure(run("--config nowhere.yaml"), "nowhere.yaml");
  expect_failure("simulate wall6 --out " + path("out"), "no scene \"wall6\"");
  for (const std::string duration : {"-1", "nan", "inf", "1e7", "long"}) {
    expect_failure("simulate wall5 --duration " + duration + " --out " + path("out"), "--duration");
  }
}

}  // namespace
}  // namespace nvm::app
