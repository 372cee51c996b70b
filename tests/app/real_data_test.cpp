// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "eval/trajectory/alignment.hpp"
#include "eval/trajectory/association.hpp"
#include "eval/trajectory/error_statistics.hpp"
#include "eval/trajectory/trajectory_error.hpp"
#include "io/result/map_cloud.hpp"
#include "io/sequence/trajectory_io.hpp"
#include "io/temporary_folder.hpp"
#include "support/real_data.hpp"

namespace nvm::app {
namespace {

class RealDataTest : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    if (test::real_data().empty()) {
      GTEST_SKIP() << "no real scans: set NVM_DATA to their folder";
    }
  }

  static std::string data(const std::string& name) { return test::real_data() + "/" + name; }

  // Runs the program, whose results go to the folder "out", and tells its exit status.
  int nvm(const std::string& arguments) const {
    const std::string command =
        std::string(NVM_PROGRAM) + " " + arguments + " --out " + path("out") + " >/dev/null";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  std::size_t back_points() const {
    const io::MapCloud map = io::read_map_cloud(path("out/map.ply"));
    return map.sides.size() -
           static_cast<std::size_t>(std::count(map.sides.begin(), map.sides.end(), 0));
  }
};

TEST_F(RealDataTest, RunFollowsAHandHeldLidarWithHalfASecondBetweenScans) {
  const std::string sequence = data("hilti_uzh_run2");
  ASSERT_EQ(nvm("run " + sequence), 0);
  const Trajectory trajectory = io::read_tum(path("out/trajectory.tum"));
  EXPECT_EQ(trajectory.size(), 111U);
  const auto pairs =
      eval::associate(trajectory, io::read_tum(sequence + "/poses_slam.tum"), 1.0).pairs;
  const eval::Alignment alignment = eval::align(pairs, eval::AlignmentKind::kSe3);
  const auto error = eval::summarize(eval::position_errors(pairs, alignment));
  ASSERT_TRUE(error);
  EXPECT_EQ(pairs.size(), 111U);
  EXPECT_LT(error->rmse, 0.05);
  EXPECT_GT(back_points(), 1000U);
}

TEST_F(RealDataTest, MapFromGivenPosesHasTwoSides) {
  const std::string sequence = data("hilti_uzh_run2");
  ASSERT_EQ(nvm("map " + sequence + " --poses " + sequence + "/poses_slam.tum"), 0);
  EXPECT_GT(back_points(), 500U);
}

TEST_F(RealDataTest, ALidarAtRestStaysThere) {
  ASSERT_EQ(nvm("run " + data("norlab_stationary")), 0);
  const Trajectory trajectory = io::read_tum(path("out/trajectory.tum"));
  EXPECT_EQ(trajectory.size(), 14U);
  for (const StampedPose& pose : trajectory) {
    EXPECT_LT(pose.pose.translation().norm(), 0.03) << pose.time;
  }
}

TEST_F(RealDataTest, ScansOfAllSensorsGoThrough) {
  // They are of different places: most do not fit the map.
  ASSERT_EQ(nvm("run " + data("single_scans") + " --set input.scan_rate=10"), 3);
  EXPECT_TRUE(std::filesystem::exists(path("out/map.ply")));
}

}  // namespace
}  // namespace nvm::app
