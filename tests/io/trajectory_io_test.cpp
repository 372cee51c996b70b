// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/trajectory_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/damage.hpp"
#include "io/file/file.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::HasSubstr;

class TrajectoryFiles : public test::TemporaryFolder {
 protected:
  std::string tum_error_of(const std::string& text) const {
    const std::string file = write("bad.tum", text);
    return runtime_error_of([&] { read_tum(file); });
  }
  std::string kitti_error_of(const std::string& text) const {
    const std::string file = write("bad.txt", text);
    return runtime_error_of([&] { read_kitti_poses(file, {0.0, 1.0}); });
  }
};

Trajectory random_trajectory(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Trajectory trajectory;
  for (int i = 0; i < 50; ++i) {
    StampedPose stamped;
    stamped.time = 1.7e9 + 0.1 * i;
    stamped.pose.linear() =
        so3_exp(3.0 * Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)));
    stamped.pose.translation() << 100.0 * uniform(rng), uniform(rng), uniform(rng);
    trajectory.push_back(stamped);
  }
  return trajectory;
}

void expect_near(const Trajectory& a, const Trajectory& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].time, b[i].time, 1e-6);
    EXPECT_TRUE(a[i].pose.isApprox(b[i].pose, tolerance));
    EXPECT_TRUE(is_rigid(a[i].pose, 1e-12));
  }
}

TEST_F(TrajectoryFiles, TumReadsBack) {
  auto rng = test::rng();
  const Trajectory trajectory = random_trajectory(rng);
  write_tum(path("a.tum"), trajectory);
  expect_near(read_tum(path("a.tum")), trajectory, 1e-9);
}

TEST_F(TrajectoryFiles, KittiReadsBack) {
  auto rng = test::rng();
  const Trajectory trajectory = random_trajectory(rng);
  std::vector<double> times;
  for (const StampedPose& stamped : trajectory) {
    times.push_back(stamped.time);
  }
  write_kitti_poses(path("a.txt"), trajectory);
  expect_near(read_kitti_poses(path("a.txt"), times), trajectory, 1e-14);
}

TEST_F(TrajectoryFiles, TumTakesUsualWritings) {
  const Trajectory trajectory = read_tum(
      write("a.tum", "# t x y z\r\n\r\n1e0 +1 .5 -3. 0 0 0 1\r\n1.5,0,0,0,0,0,0.999,0 # comment"));
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].pose.translation(), Eigen::Vector3d(1, 0.5, -3));
  EXPECT_TRUE(is_rigid(trajectory[1].pose, 1e-12));
  EXPECT_TRUE(read_tum(write("empty.tum", "")).empty());
}

TEST_F(TrajectoryFiles, BadTumLinesAreNamed) {
  const std::string good = "0 0 0 0 0 0 0 1\n";
  EXPECT_THAT(tum_error_of(good + good), HasSubstr("bad.tum:2: time 0.000000 is not above"));
  EXPECT_THAT(tum_error_of(good + "#\n-1 0 0 0 0 0 0 1\n"), HasSubstr("bad.tum:3: time -1.0"));
  EXPECT_THAT(tum_error_of("0 0 0 0 0 0 0 0.9"), HasSubstr("bad.tum:1: quaternion has length 0.9"));
  EXPECT_THAT(tum_error_of("0 0 0 0 0 0 0 0"), HasSubstr("quaternion has length 0.0"));
  EXPECT_THAT(tum_error_of("0 nan 0 0 0 0 0 1"), HasSubstr("'nan' is not a finite number"));
  EXPECT_THAT(tum_error_of("inf 0 0 0 0 0 0 1"), HasSubstr("'inf' is not a finite number"));
  EXPECT_THAT(tum_error_of("0 0 0 x 0 0 0 1"), HasSubstr("'x' is not a finite number"));
  EXPECT_THAT(tum_error_of(good + "1 0 0 0"), HasSubstr("bad.tum:2: has 4 values instead of 8"));
  EXPECT_THAT(
      runtime_error_of([&] { read_tum(path("none.tum")); }), HasSubstr("none.tum: cannot be read"));
}

TEST_F(TrajectoryFiles, BadKittiLinesAreNamed) {
  const std::string good = "1 0 0 1 0 1 0 2 0 0 1 3\n";
  EXPECT_THAT(kitti_error_of(good), HasSubstr("has 1 poses for 2 times"));
  EXPECT_THAT(kitti_error_of(good + good + good), HasSubstr("bad.txt:3: more poses than the 2"));
  EXPECT_THAT(kitti_error_of("1 0 0 1 0 1 0 2 0 0 -1 3"), HasSubstr("bad.txt:1: the left 3x3"));
  EXPECT_THAT(kitti_error_of("2 0 0 1 0 1 0 2 0 0 1 3"), HasSubstr("is not a rotation"));
  EXPECT_THAT(kitti_error_of("1 2 3"), HasSubstr("has 3 values instead of 12"));
}

TEST_F(TrajectoryFiles, TimesMustAscend) {
  EXPECT_EQ(read_times(write("t.txt", "0.0\n1e-1\n0.2")), (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_THAT(
      runtime_error_of([&] { read_times(write("t.txt", "0\n2\n1\n")); }), HasSubstr("t.txt:3: "));
}

TEST_F(TrajectoryFiles, DamagedFilesNeverDoMoreThanThrow) {
  auto rng = test::rng();
  write_tum(path("a.tum"), random_trajectory(rng));
  test::read_damaged(read_file(path("a.tum")), rng, [&](const std::string& damaged) {
    for (const StampedPose& stamped : read_tum(write("damaged.tum", damaged))) {
      EXPECT_TRUE(is_rigid(stamped.pose));
    }
  });
}

}  // namespace
}  // namespace nvm::io
