// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// Runs that begin again with what they have found out of the IMU.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "io/sequence/trajectory_io.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "program_fixture.hpp"

namespace nvm::app {
namespace {

using test::Outcome;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class SecondStartTest : public test::ProgramFixture {
 protected:
  /// A walk of 14 s whose IMU is late by `late` [s].
  void simulate(const std::string& late) const {
    const Outcome outcome =
        nvm("simulate wall5 --sensor vlp16 --duration 14 --seed 3 --set imu.clock_offset=" + late +
            " --out " + path("walk"));
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
  }

  /// How far those of a run lie from the true ones, without any alignment but of the first [m].
  double difference_from_truth(const std::string& out) const {
    const Trajectory truth = io::read_tum(path("walk/groundtruth.tum"));
    const Trajectory estimate = io::read_tum(path(out + "/trajectory.tum"));
    const Pose T_truth_map =
        *pose_at(truth, estimate.front().time) * estimate.front().pose.inverse();
    double farthest = 0.0;
    for (const StampedPose& stamped : estimate) {
      const Pose moved = T_truth_map * stamped.pose;
      const Pose expected = *pose_at(truth, stamped.time);
      farthest = std::max(farthest, (moved.translation() - expected.translation()).norm());
    }
    return farthest;
  }

  Outcome run_walk(const std::string& out, const std::string& more = "") const {
    return nvm("run " + path("walk") + " --out " + path(out) + " " + more);
  }

  /// The farthest that the pose of a frame lies from the same in another run [m].
  double difference(const std::string& out, const std::string& other) const {
    const Trajectory a = io::read_tum(path(out + "/trajectory.tum"));
    const Trajectory b = io::read_tum(path(other + "/trajectory.tum"));
    EXPECT_EQ(a.size(), b.size());
    double farthest = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      EXPECT_EQ(a[i].time, b[i].time);
      const double apart = (a[i].pose.translation() - b[i].pose.translation()).norm();
      farthest = std::max(farthest, apart);
    }
    return farthest;
  }
};

TEST_F(SecondStartTest, HasWhatWasFoundHoldFromTheFirstScanOn) {
  simulate("0.06");
  const Outcome found = run_walk("found");
  EXPECT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(found.errors, ContainsRegex("clock is (5[89]|60)"));
  EXPECT_THAT(
      found.errors, ContainsRegex("the run begins again, with imu.time_offset=-0.0(5[789]|6)"));
  const Outcome told = run_walk("told", "--set imu.time_offset=-0.06");
  EXPECT_THAT(told.errors, Not(HasSubstr("begins again")));
  EXPECT_LT(difference("found", "told"), 0.003);  // 19 mm without a second start
  EXPECT_THAT(names_in("found"), ::testing::SizeIs(names_in("told").size()));
  const auto timing = nlohmann::json::parse(test::text_of(path("found/timing.json")));
  EXPECT_EQ(timing["scans"], 140);
}

// By the run's own figures: turned by half a degree the wall at 7 m is off by 6 cm.
TEST_F(SecondStartTest, MendsAnExtrinsicThatIsTurned) {
  simulate("0");
  const std::string turned =
      "--set input.T_imu_lidar=[0.02,-0.01,0.09,0.0,0.0523360,0.0,0.9986295]";  // 6 degrees
  const Outcome found = run_walk("found", turned);
  EXPECT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(found.errors, HasSubstr("the LiDAR is turned by "));
  EXPECT_THAT(found.errors, HasSubstr("the run begins again, with input.T_imu_lidar=["));
  const Outcome kept = run_walk("kept", turned + " --set imu.learn_rotation=false");
  EXPECT_THAT(kept.errors, HasSubstr("the LiDAR is turned by "));
  EXPECT_THAT(kept.errors, Not(HasSubstr("begins again")));
  EXPECT_LT(difference_from_truth("found"), 0.2 * difference_from_truth("kept"));
}

TEST_F(SecondStartTest, IsNotForWhatIsNotToBeLearned) {
  simulate("0.06");
  const Outcome outcome = run_walk("out", "--set imu.learn_time_offset=false");
  EXPECT_THAT(outcome.errors, Not(HasSubstr("begins again")));
}

TEST_F(SecondStartTest, IsNotForAnImuThatIsNearlyInTime) {
  simulate("0.002");
  EXPECT_THAT(run_walk("out").errors, Not(HasSubstr("begins again")));
}

}  // namespace
}  // namespace nvm::app
