// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What the program leaves behind, and its exit status, when a run does not go as it should.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/result/map_cloud.hpp"
#include "io/sequence/trajectory_io.hpp"
#include "program_fixture.hpp"
#include "support/sanitizers.hpp"

namespace nvm::app {
namespace {

using test::Outcome;
using test::text_of;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

class ResultsTest : public test::ProgramFixture {
 protected:
  void expect_whole_results() const {
    EXPECT_THAT(
        names_in("out"),
        UnorderedElementsAre(
            "trajectory.tum",
            "trajectory_kitti.txt",
            "frames.csv",
            "map.ply",
            "map.nvm",
            "session.nvms",
            "timing.json"));
    EXPECT_EQ(nvm("info " + path("out/map.nvm")).status, 0);
  }

  static constexpr int kLong = 500;

  static std::string long_name(int k) { return "long" + std::to_string(k) + ".pcd"; }

  // So many scans that a signal comes in the middle of them.
  void make_long() const {
    std::string times;
    for (int k = 0; k < kLong; ++k) {
      std::filesystem::create_hard_link(path("scans/scan0.pcd"), path("scans/" + long_name(k)));
      times += long_name(k) + " " + std::to_string(200 + k) + "\n";
    }
    write("timestamps.txt", times);
  }

  // Runs the program and sends it `signal` as soon as the shell's `condition` holds.
  Outcome nvm_until(
      const std::string& condition, const std::string& arguments, const std::string& signal) const {
    return nvm(
        arguments,
        "(while ! " + condition + "; do sleep 0.05; done; kill -" + signal + " $(cat " +
            path("pid") + ")) & exec env --default-signal=INT sh -c 'echo $$ >" + path("pid") +
            "; exec \"$0\" \"$@\"' ");
  }

  Outcome run_until(const std::string& signal) const {
    const std::string frames = path("out") + "/nvm-results.part-*/frames.csv";
    return nvm_until("grep -qs tracking " + frames, run(""), signal);
  }
};

TEST_F(ResultsTest, ABadScanIsLeftOutAndNamed) {
  write("scans/scan3.pcd", "nothing of the kind");
  const Outcome outcome = nvm(run(""));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.errors, HasSubstr("scan3.pcd"));
  EXPECT_EQ(io::read_tum(path("out/trajectory.tum")).size(), 4U);
  expect_whole_results();
}

TEST_F(ResultsTest, ADiskThatGetsFullKeepsWholeLinesOfWhatCameBefore) {
  make_long();
  const Outcome outcome = nvm(run(""), "ulimit -f 4; ");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("cannot be written: File too large"));
  const std::size_t poses = io::read_tum(path("out/trajectory.tum")).size();
  EXPECT_GE(poses, 5U);
  EXPECT_LT(poses, 100U);
  for (const std::string name : {"trajectory_kitti.txt", "frames.csv"}) {
    EXPECT_EQ(text_of(path("out/" + name)).back(), '\n') << name;
  }
  EXPECT_THAT(names_in("out"), Not(Contains("map.ply")));
}

TEST_F(ResultsTest, AFullDiskAtTheMapKeepsTheTrajectory) {
  ASSERT_EQ(nvm(run("")).status, 0);
  const std::string limit = "ulimit -f 20; ";  // of 512 bytes: more than the map has
  const Outcome outcome = nvm(run(""), limit);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("map.ply: cannot be written: File too large"));
  EXPECT_THAT(
      names_in("out"),
      UnorderedElementsAre("trajectory.tum", "trajectory_kitti.txt", "frames.csv", "timing.json"));
  EXPECT_EQ(io::read_tum(path("out/trajectory.tum")).size(), truth_.size());
}

TEST_F(ResultsTest, AFullDiskFromTheBeginLeavesTheOldResults) {
  NVM_SKIP_UNDER_SANITIZERS();
  ASSERT_EQ(nvm(run("")).status, 0);
  const Outcome outcome = nvm(run(""), "ulimit -f 0; ");
  EXPECT_EQ(outcome.status, 1);
  expect_whole_results();
}

TEST_F(ResultsTest, ASignalFinishesTheFilesOfTheScansUntilThen) {
  make_long();
  for (const auto& [signal, status] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    const Outcome outcome = run_until(signal);
    EXPECT_EQ(outcome.status, status) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("interrupted"));
    expect_whole_results();
    const std::size_t poses = io::read_tum(path("out/trajectory.tum")).size();
    EXPECT_GE(poses, 1U);
    EXPECT_LT(poses, static_cast<std::size_t>(kLong));
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(ResultsTest, ASignalLeavesNothingOfASimulationNorOfAKilledOneBefore) {
  const std::string simulate =
      "simulate wall10 --set lidar.scan_rate=100 --out " + path("sequences/wall");
  const std::string list =
      "ls " + path("sequences") + "/wall.part-*/scans/*0.bin 2>" + path("null") + " | grep ";
  nvm_until(list + "-q bin", simulate, "KILL");
  ASSERT_EQ(names_in("sequences").size(), 1U);
  const std::string left = names_in("sequences")[0];
  const Outcome outcome = nvm_until(list + "-qv " + left, simulate, "INT");
  EXPECT_EQ(outcome.status, 130) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr(left + ": was left"));
  EXPECT_THAT(outcome.errors, HasSubstr("interrupted: nothing is left"));
  EXPECT_THAT(names_in("sequences"), ::testing::IsEmpty());
}

TEST_F(ResultsTest, ASignalBeforeAnythingIsWrittenSaysSo) {
  ASSERT_EQ(::mkfifo(path("fifo.tum").c_str(), 0600), 0);  // which nobody writes to
  const std::string evaluate =
      "evaluate " + path("poses.tum") + " --truth " + path("fifo.tum") + " --out " + path("out");
  for (const std::string& arguments : {evaluate, map("fifo.tum")}) {
    const Outcome outcome = nvm_until("sleep 0.3", arguments, "INT");
    EXPECT_EQ(outcome.status, 130) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("interrupted; nothing was written"));
    EXPECT_FALSE(std::filesystem::exists(path("out")));
  }
}

TEST_F(ResultsTest, WhatAKilledRunLeftIsNamedAndRemovedByTheNext) {
  const std::string times = text_of(path("timestamps.txt"));
  make_long();
  run_until("KILL");
  ASSERT_EQ(names_in("out").size(), 1U);
  const std::string left = names_in("out")[0];
  EXPECT_THAT(left, StartsWith("nvm-results.part-"));
  EXPECT_GE(io::read_tum(path("out/" + left + "/trajectory.tum")).size(), 1U);

  for (int k = 0; k < kLong; ++k) {
    std::filesystem::remove(path("scans/" + long_name(k)));
  }
  write("timestamps.txt", times);
  const Outcome outcome = nvm(run(""));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.errors, HasSubstr(left));
  expect_whole_results();
}

TEST_F(ResultsTest, AMapWithoutPointsIsAnErrorThatNamesTheCause) {
  const std::string run_without = "run " + path("") + " --out " + path("out");
  expect_failure(run_without + " --set lidar.min_range=50", "initializing");
  expect_failure(map("poses.tum", "--set lidar.min_range=50"), "lidar.min_range");
}

TEST_F(ResultsTest, ARunThatIsMostlyUnusableHasResultsAndStatus3) {
  for (int k = 2; k < kScans; ++k) {  // three of five scans are of another place
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 3000; ++i) {
      const float angle = 0.1F * static_cast<float>(i);
      points.emplace_back(
          9.0F * std::cos(angle), 9.0F * std::sin(angle), 0.001F * static_cast<float>(i + 300 * k));
    }
    write("scans/scan" + std::to_string(k) + ".pcd", pcd(points));
  }
  const Outcome outcome = nvm(run(""));
  EXPECT_EQ(outcome.status, 3) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("most of the run is unusable: of 5 scans"));
  EXPECT_THAT(outcome.errors, HasSubstr("to 4.0 s"));
  expect_whole_results();
}

TEST_F(ResultsTest, AnotherRunsFilesAreNotLeftBesideNewOnes) {
  ASSERT_EQ(nvm(run("")).status, 0);
  write("out/notes.txt", "mine");
  ASSERT_EQ(nvm(map("poses.tum")).status, 0);
  EXPECT_THAT(
      names_in("out"), UnorderedElementsAre("trajectory.tum", "map.ply", "map.nvm", "notes.txt"));
}

TEST_F(ResultsTest, PosesInUtmGetALocalOriginThatIsPutBack) {
  ASSERT_EQ(nvm(map("poses.tum")).status, 0);
  const io::MapCloud local = io::read_map_cloud(path("out/map.ply"));
  const Eigen::Vector3d utm(465123.4, 5531234.5, 312.0);
  Trajectory poses = truth_;
  for (StampedPose& pose : poses) {
    pose.pose.translation() += utm;
  }
  io::write_tum(path("utm.tum"), poses);
  const Outcome outcome = nvm(map("utm.tum"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("counts from 465100 5531200 300 m"));
  const Trajectory placed = io::read_tum(path("out/trajectory.tum"));
  EXPECT_LT((placed[2].pose.translation() - poses[2].pose.translation()).norm(), 1e-6);

  ASSERT_EQ(nvm("export " + path("out/map.nvm") + " --out " + path("again.ply")).status, 0);
  for (const std::string name : {"out/map.ply", "again.ply"}) {
    const io::MapCloud cloud = io::read_map_cloud(path(name));
    // Voxels lie elsewhere on the walls, so that points are others; the room is the same.
    EXPECT_NEAR(
        static_cast<double>(cloud.positions.size()),
        static_cast<double>(local.positions.size()),
        0.1 * static_cast<double>(local.positions.size()));
    Eigen::Vector3d min = cloud.positions[0];
    Eigen::Vector3d local_min = local.positions[0];
    for (const Eigen::Vector3d& position : cloud.positions) {
      min = min.cwiseMin(position);
    }
    for (const Eigen::Vector3d& position : local.positions) {
      local_min = local_min.cwiseMin(position);
    }
    EXPECT_LT((min - utm - local_min).norm(), 0.05) << name;
  }
  EXPECT_THAT(nvm("info " + path("out/map.nvm")).output, HasSubstr(" 5531"));
}

// A folder may hold the origin of another map, and an image the place of an older one.
TEST_F(ResultsTest, AnImageHasTheOriginOfItsMapWhereverItIsPut) {
  ASSERT_EQ(nvm(map("poses.tum")).status, 0);
  const std::string local = nvm("info " + path("out/map.nvm")).output;
  std::filesystem::create_directory(path("images"));
  write("images/map_origin.txt", "100 200 300\n");
  const std::string image = path("images/room.image");
  ASSERT_EQ(nvm("export " + path("out/map.nvm") + " --out " + image).status, 0);
  EXPECT_EQ(nvm("info " + image).output, local);
  write("out/map_origin.txt", "1000 0 0\n");
  const std::string moved = nvm("info " + path("out/map.nvm")).output;
  ASSERT_NE(moved, local);
  ASSERT_EQ(nvm("export " + path("out/map.nvm") + " --out " + image).status, 0);
  EXPECT_EQ(nvm("info " + image).output, moved);
  std::filesystem::remove(path("out/map_origin.txt"));
  ASSERT_EQ(nvm("export " + path("out/map.nvm") + " --out " + image).status, 0);
  EXPECT_EQ(nvm("info " + image).output, local);
}

TEST_F(ResultsTest, ScansAndResultsLieApart) {
  const Outcome outcome = nvm("run " + path("scans") + " --out " + path("scans"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("is where the scans are"));
  EXPECT_EQ(nvm("run " + path("") + " --out " + path("scans")).status, 1);
  EXPECT_THAT(names_in("scans"), Not(Contains("map.ply")));
}

TEST_F(ResultsTest, MemoryThatRunsOutIsNamedWithWhatItIsFor) {
  NVM_SKIP_UNDER_SANITIZERS();
  const Outcome outcome = nvm(run("--set map.capacity=60000000"), "ulimit -v 2000000; ");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("making a map of map.capacity=60000000 voxels"));
  EXPECT_THAT(outcome.errors, Not(HasSubstr("bad_alloc")));
}

TEST_F(ResultsTest, EvaluateScoresABareTrajectoryAndSaysWhatWasJudged) {
  write("truth.tum", text_of(path("poses.tum")));
  const std::string ends = " --align none --out " + path("report");
  const Outcome outcome =
      nvm("evaluate " + path("poses.tum") + " --truth " + path("truth.tum") + ends);
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(
      outcome.output, StartsWith("poses: ATE RMSE 0.00 mm over 5 poses and 4.0 of 4.0 s\n"));
  const Outcome shifted =
      nvm("evaluate " + path("poses.tum") + " --truth " + path("truth.tum") +
          " --time-offset 1700000000" + ends);
  EXPECT_EQ(shifted.status, 1);
  EXPECT_THAT(shifted.errors, HasSubstr("from 1700000100.000 to 1700000104.000 s (UNIX time)"));
  EXPECT_THAT(shifted.errors, HasSubstr("--time-offset=-1700000000.000"));
}

}  // namespace
}  // namespace nvm::app
