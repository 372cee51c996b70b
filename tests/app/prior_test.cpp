// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Runs in a prior map, with the program as a user has it.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "io/sequence/trajectory_io.hpp"
#include "nvm/map/serialization.hpp"
#include "program_fixture.hpp"

namespace nvm::app {
namespace {

using test::Outcome;
using test::text_of;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class PriorTest : public test::ProgramFixture {
 protected:
  void SetUp() override {
    ProgramFixture::SetUp();
    ASSERT_EQ(nvm(map("poses.tum")).status, 0);
    std::filesystem::rename(path("out"), path("prior"));
  }

  std::string in_prior(const std::string& more) const {
    return run("--map " + path("prior/map.nvm") + " " + more);
  }
};

TEST_F(PriorTest, LocalisesAndLeavesThePriorMapAlone) {
  const std::string before = text_of(path("prior/map.nvm"));
  const Outcome outcome = nvm(in_prior("--start 0.2,-0.1,0,0.1"));
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(text_of(path("prior/map.nvm")), before);
  EXPECT_THAT(names_in("out"), Not(Contains("map.nvm")));
  const Trajectory trajectory = io::read_tum(path("out/trajectory.tum"));
  ASSERT_EQ(trajectory.size(), truth_.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const auto error = trajectory[i].pose.translation() - truth_[i].pose.translation();
    EXPECT_LT(error.norm(), 0.03);
  }
}

TEST_F(PriorTest, TakesTheInputAfterTheStart) {
  const std::string start = "run --start -0.1,0,0,0 " + path("") + for_sparse_scans();
  const Outcome outcome = nvm(start + " --map " + path("prior/map.nvm") + " --out " + path("out"));
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

TEST_F(PriorTest, ExtendsACopy) {
  const std::string before = text_of(path("prior/map.nvm"));
  EXPECT_EQ(nvm(in_prior("--start 0,0,0,0 --extend")).status, 0);
  EXPECT_EQ(text_of(path("prior/map.nvm")), before);
  EXPECT_GE(load_map(path("out/map.nvm")).size(), load_map(path("prior/map.nvm")).size());
}

TEST_F(PriorTest, AnImageOfTheMapIsAsGoodAsTheMap) {
  ASSERT_EQ(nvm(in_prior("--start 0,0,0,0 --extend")).status, 0);
  std::filesystem::rename(path("out"), path("expected"));
  const std::string image = path("prior/map.image");
  ASSERT_EQ(nvm("export " + path("prior/map.nvm") + " --out " + image).status, 0);
  const std::string before = text_of(image);
  write("prior/cut.image", before.substr(0, before.size() - 1));
  expect_failure(run("--map " + path("prior/cut.image") + " --start 0,0,0,0"), "truncated");
  ASSERT_EQ(nvm(run("--map " + image + " --start 0,0,0,0 --extend")).status, 0);
  for (const std::string name : {"map.nvm", "trajectory.tum"}) {
    EXPECT_EQ(text_of(path("out/" + name)), text_of(path("expected/" + name))) << name;
  }
  EXPECT_EQ(text_of(image), before);
  EXPECT_EQ(nvm("info " + image).output, nvm("info " + path("prior/map.nvm")).output);
}

TEST_F(PriorTest, TheMapsOwnOptionsCountAndThatIsSaid) {
  const Outcome outcome = nvm(in_prior("--start 0,0,0,0 --extend --set map.voxel_size=0.5"));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.errors, HasSubstr("keeps its own options: voxel_size 0.3 (not 0.5)"));
  EXPECT_EQ(load_map(path("out/map.nvm")).options().voxel_size, 0.3);
}

TEST_F(PriorTest, SaysInOneLineThatTheStartIsWrong) {
  const Outcome outcome = nvm(in_prior("--start 50,0,0,0"));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.errors, HasSubstr("warning: the start that was given is wrong"));
}

TEST_F(PriorTest, TakesTheFolderOfARun) {
  EXPECT_EQ(nvm("info " + path("prior")).output, nvm("info " + path("prior/map.nvm")).output);
  EXPECT_EQ(nvm("export " + path("prior") + " --out " + path("prior/export.ply")).status, 0);
  const Outcome outcome = nvm(run("--map " + path("prior") + " --start 0,0,0,0"));
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

TEST_F(PriorTest, RefusesWhatIsNoPriorMapInOneLine) {
  const std::string bytes = text_of(path("prior/map.nvm"));
  write("prior/map.nvm", bytes.substr(0, bytes.size() / 2));
  expect_failure(in_prior("--start 0,0,0,0"), "truncated");
  write("prior/map.nvm", "nothing of the kind, but long enough to be one");
  expect_failure(in_prior("--start 0,0,0,0"), "is not an nvm map");
  std::filesystem::remove(path("prior/map.nvm"));
  expect_failure(in_prior("--start 0,0,0,0"), "cannot be opened");
}

TEST_F(PriorTest, RefusesArgumentsThatDoNotGoTogether) {
  expect_failure(run("--extend"), "--map");
  expect_failure(in_prior("--start 1,2,3"), "4 numbers");
  expect_failure(in_prior("--start 1,2,3,90"), "radians");
  expect_failure(in_prior("--start 0,0,0,0,0,0,2"), "unit quaternion");
  expect_failure(in_prior("--start 0,0,0,0 --set map.type=kdtree"), "map.type=nvm");
}

TEST_F(PriorTest, RefusesToReplaceThePriorMap) {
  std::filesystem::create_directory(path("out"));
  std::filesystem::rename(path("prior/map.nvm"), path("out/map.nvm"));
  const Outcome outcome = nvm(run("--map " + path("out/map.nvm") + " --start 0,0,0,0"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("would be replaced"));
  EXPECT_GT(load_map(path("out/map.nvm")).size(), 0U);
}

}  // namespace
}  // namespace nvm::app
