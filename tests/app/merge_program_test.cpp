// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// nvm merge, with the program as a user has it.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/result/map_cloud.hpp"
#include "io/result/map_origin.hpp"
#include "io/result/session_file.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/sighting.hpp"
#include "program_fixture.hpp"
#include "support/sanitizers.hpp"

namespace nvm::app {
namespace {

namespace fs = std::filesystem;

using test::Outcome;
using test::text_of;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// The folders a and b, as of two runs in one room: b's map begins a metre further along x.
class MergeProgramTest : public test::ProgramFixture {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    write_results("a", Eigen::Vector3d::Zero());
    write_results("b", Eigen::Vector3d::UnitX());
  }

  /// What a run leaves whose map begins at `begin` in the room.
  void write_results(const std::string& name, const Eigen::Vector3d& begin) {
    fs::create_directories(path(name));
    MapOptions options;
    options.columns.intensity = name == "b";
    VoxelMap map(options);
    io::SessionWriter writer(path(name + "/session.nvms"));
    for (const double y : {-1.0, -0.5, 0.0, 0.5}) {
      io::Keyframe keyframe;
      keyframe.T_map_lidar.translation() = Eigen::Vector3d(0.5, y, 0.0) - begin;
      Pose T_room_lidar = keyframe.T_map_lidar;
      T_room_lidar.pretranslate(begin);
      const test::RoomScan scan = room_.scan(T_room_lidar, 3000, 0.003, random_);
      std::vector<PointValues> values(scan.points.size());
      for (PointValues& of_point : values) {
        of_point.intensity = 7.0F;
      }
      map.insert(scan.points, scan.normals, keyframe.T_map_lidar, values);
      keyframe.points = scan.points;
      keyframe.normals = scan.normals;
      writer.add(keyframe);
    }
    save_map(map, path(name + "/map.nvm"));
    writer.finish(io::stamp_of(path(name + "/map.nvm")));
  }

  /// Another map in the folder `name`, with keyframes that belong to it.
  void replace_map(const std::string& name, const VoxelMap& map, bool has_keyframes = true) {
    save_map(map, path(name + "/map.nvm"));
    io::SessionWriter writer(path(name + "/session.nvms"));
    if (has_keyframes) {
      writer.add({});
    }
    writer.finish(io::stamp_of(path(name + "/map.nvm")));
  }

  std::string merge(const std::string& more = "--guess 1,0,0,0") const {
    return "merge " + path("a") + " " + path("b") + " --out " + path("all.nvm") + " " + more;
  }

  void expect_refusal(const std::string& arguments, const std::string& message) const {
    expect_failure(arguments, message);
    EXPECT_THAT(names_in(""), Not(Contains(HasSubstr("all"))));
  }

  const test::Room room_;
  std::mt19937_64 random_ = test::rng();
};

TEST_F(MergeProgramTest, LeavesOneMapInTheFirstRunsFrame) {
  const Outcome outcome = nvm(merge("--guess 0.8,0.2,0,0"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("b: at 1.00"));
  const VoxelMap all = load_map(path("all.nvm"));
  const std::size_t of_first = load_map(path("a/map.nvm")).size();
  EXPECT_GT(all.size(), of_first);
  std::size_t of_second = 0;
  all.for_each_point([&](const MapPoint& p) { of_second += p.values.intensity == 7.0F ? 1U : 0U; });
  EXPECT_GE(of_second, all.size() - of_first) << "what only one of the maps carries is kept";
  EXPECT_THAT(
      names_in(""), UnorderedElementsAre("a", "b", "all.nvm", "all.ply", "output", "errors"));
}

TEST_F(MergeProgramTest, KeepsTheFirstRunsOriginAndTakesGuessesInItsFrame) {
  const Eigen::Vector3d origin(465100.0, 5531200.0, 300.0);
  io::write_origin(path("a/map.nvm"), origin);
  const Outcome outcome = nvm(merge("--guess 465101,5531200,300,0"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("b: at 46510"));
  EXPECT_EQ(io::read_origin(path("all.nvm")), origin);
  for (const Eigen::Vector3d& point : io::read_map_cloud(path("all.ply")).positions) {
    EXPECT_LT((point - origin).cwiseAbs().maxCoeff(), 4.1);
  }
}

TEST_F(MergeProgramTest, TwoOriginsInOneGridTellHowRunsLie) {
  io::write_origin(path("a/map.nvm"), {465100.0, 5531200.0, 300.0});
  io::write_origin(path("b/map.nvm"), {465101.0, 5531200.0, 300.0});
  const Outcome outcome = nvm(merge(""));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("b: at 46510"));
  EXPECT_EQ(io::read_origin(path("all.nvm")), io::read_origin(path("a/map.nvm")));
}

TEST_F(MergeProgramTest, AnOriginBesideTheMergedMapIsNotTakenForItsOwn) {
  io::write_origin(path("map.nvm"), {465100.0, 5531200.0, 300.0});
  ASSERT_EQ(nvm(merge()).status, 0);
  EXPECT_TRUE(io::read_origin(path("all.nvm")).isZero(0.0));
  EXPECT_FALSE(io::read_origin(path("map.nvm")).isZero(0.0));
}

TEST_F(MergeProgramTest, RefusesDamagedSessionsInOneLineWithWhatHelps) {
  const std::string bytes = text_of(path("b/session.nvms"));
  const std::string again = "; copy the results again, or run nvm run again";
  write("b/session.nvms", bytes.substr(0, bytes.size() / 2));
  expect_refusal(merge(), "was not finished" + again);
  std::string changed = bytes;
  changed[bytes.size() / 2] = static_cast<char>(changed[bytes.size() / 2] ^ 1);
  write("b/session.nvms", changed);
  expect_refusal(merge(), "session.nvms: is corrupt: a checksum is wrong" + again);
  const std::string map = text_of(path("b/map.nvm"));
  write("b/map.nvm", map.substr(0, 2));
  expect_refusal(merge(), "map.nvm: is too short for an nvm map" + again);
  fs::remove(path("b/session.nvms"));
  expect_refusal(merge(), "session.nvms: is missing");
  fs::remove_all(path("b"));
  expect_refusal(merge(), "is no folder: give those that nvm run had as --out");
}

TEST_F(MergeProgramTest, RefusesKeyframesOfAnotherMap) {
  write_results("c", Eigen::Vector3d::UnitY());
  fs::copy_file(path("c/map.nvm"), path("b/map.nvm"), fs::copy_options::overwrite_existing);
  expect_refusal(
      merge(), "b/session.nvms: belongs to another map than the map.nvm beside it; copy");
}

TEST_F(MergeProgramTest, RefusesARunThatComesTwiceByWhateverName) {
  fs::create_directory_symlink(path("a"), path("link"));
  fs::copy(path("a"), path("copy"));
  for (const std::string& name : {path("a"), path("./b/../a/"), path("link"), path("copy")}) {
    expect_refusal(
        "merge " + path("a") + " " + path("b") + " " + name + " --out " + path("all.nvm"),
        name + ": has the same map as " + path("a") + ": give each run once");
  }
}

TEST_F(MergeProgramTest, RefusesMapsWithoutNormalsAndRunsWithoutKeyframes) {
  const std::vector<Eigen::Vector3f> points{{1.0F, 2.0F, 3.0F}, {1.0F, 2.5F, 3.0F}};
  std::vector<Eigen::Vector3f> sightings;
  for (const Eigen::Vector3f& point : points) {
    sightings.push_back(sighting(point, Eigen::Vector3d::Zero()));
  }
  std::vector<VoxelMap> maps(3);
  maps[1].insert(points, sightings, Pose::Identity());
  maps[2].insert_unsided(points);
  for (const VoxelMap& map : maps) {
    replace_map("b", map);
    expect_refusal(merge(), "b/map.nvm: has no points with normals: run nvm run with map.type=nvm");
  }
  replace_map("b", load_map(path("a/map.nvm")), false);
  fs::remove_all(path("a"));
  write_results("a", Eigen::Vector3d::UnitY());
  expect_refusal(merge(), "b/session.nvms: has no keyframes");
}

TEST_F(MergeProgramTest, RefusesToReplaceAnInput) {
  const std::string before = text_of(path("b/map.nvm"));
  fs::create_directory_symlink(path("b"), path("link"));
  for (const std::string& out : {path("b/map.nvm"), path("link/map.nvm")}) {
    expect_refusal(
        "merge " + path("a") + " " + path("b") + " --guess 1,0,0,0 --out " + out,
        out + ": is the map of " + path("b") + ": give --out another name");
  }
  EXPECT_EQ(text_of(path("b/map.nvm")), before);
  EXPECT_THAT(names_in("b"), UnorderedElementsAre("map.nvm", "session.nvms"));
}

TEST_F(MergeProgramTest, FindsBeforeItReadsThatNothingCanBeWritten) {
  fs::remove(path("b/map.nvm"));  // which would be said otherwise
  const std::string merge_to = "merge " + path("a") + " " + path("b") + " --out ";
  expect_refusal(merge_to + path("none/all.nvm"), "/none; make it first");
  fs::create_directory(path("folder.nvm"));
  expect_refusal(merge_to + path("folder.nvm"), "is a folder; give another name");
  write("map_origin.txt", "nowhere\n");
  expect_refusal(merge_to + path("all.nvm"), "map_origin.txt:1: must be");
}

TEST_F(MergeProgramTest, WritesAllOrNothing) {
  NVM_SKIP_UNDER_SANITIZERS();
  write("all.nvm", "old map");
  write("all.ply", "old points");
  const std::string limit = "ulimit -f 150; ";  // of 512 bytes: more than the .nvm, not the .ply
  const Outcome outcome = nvm(merge(), limit);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("File too large"));
  EXPECT_EQ(text_of(path("all.nvm")), "old map");
  EXPECT_EQ(text_of(path("all.ply")), "old points");
  EXPECT_THAT(
      names_in(""), UnorderedElementsAre("a", "b", "all.nvm", "all.ply", "output", "errors"));
}

TEST_F(MergeProgramTest, RefusesArgumentsThatDoNotGoTogether) {
  expect_refusal("merge " + path("a") + " --out " + path("all.nvm"), "two runs");
  expect_refusal("merge " + path("a") + " " + path("b") + " --out " + path("all.pcd"), ".nvm file");
  expect_refusal(merge("--guess 1,2,x,4"), "'x' must be a number");
  expect_refusal(merge("--guess 1,2,3"), "4 numbers");
  expect_refusal(merge("--guess 1,2,3,90"), "radians");
  expect_refusal(merge("--guess 0,0,0,0 --guess 0,0,0,0"), "--guess was given 2 times");
}

TEST_F(MergeProgramTest, TakesArgumentsInAnyOrder) {
  const std::string out = " --out " + path("all.nvm");
  const Outcome outcome =
      nvm("merge --guess -1,0,0,0 " + path("b") + out + " " + path("a") + " --threads 2");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("a: at -1.00"));
}

TEST_F(MergeProgramTest, RefusesAWrongGuessAndSaysWhatHelps) {
  expect_refusal(merge("--guess 30,0,0,0"), "b: does not overlap: ");
  expect_refusal(merge("--guess 30,0,0,0"), "with --guess, which maps that are not level need");
}

class SessionOfARunTest : public test::ProgramFixture {};

TEST_F(SessionOfARunTest, BelongsToItsMap) {
  ASSERT_EQ(nvm(run("")).status, 0);
  io::SessionReader session(path("out/session.nvms"));
  while (session.next()) {
  }
  EXPECT_TRUE(session.map() == io::stamp_of(path("out/map.nvm")));
}

TEST_F(SessionOfARunTest, IsLeftByRunsWithAMapFileOfTheirOwnAlone) {
  ASSERT_EQ(nvm(run("--set map.type=kdtree")).status, 0);
  EXPECT_THAT(names_in("out"), Not(Contains("session.nvms")));
  ASSERT_EQ(nvm(map("poses.tum")).status, 0);
  fs::rename(path("out"), path("prior"));
  const std::string in_prior = "--start 0,0,0,0 --map " + path("prior/map.nvm");
  ASSERT_EQ(nvm(run(in_prior)).status, 0);
  EXPECT_THAT(names_in("out"), Not(Contains("session.nvms")));
  ASSERT_EQ(nvm(run(in_prior + " --extend")).status, 0);
  EXPECT_THAT(names_in("out"), Contains("session.nvms"));
}

}  // namespace
}  // namespace nvm::app
