// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/deskew_watch.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

using ::testing::HasSubstr;

constexpr float kSweep = 0.1F;  // [s]

/// The motion of a body, by that of the LiDAR on it.
SweepMotion of_body(const SweepMotion& lidar, const Pose& T_body_lidar) {
  const Eigen::Vector3d rate = T_body_lidar.linear() * lidar.rate;
  return {T_body_lidar.linear() * lidar.velocity - rate.cross(T_body_lidar.translation()), rate};
}

/// What a watch says of `scans` sweeps in a known room, whose points lie where `share` of deskewing
/// puts them best, while they were moved by all of it.
std::string finding(double share, int scans, double turning) {
  auto rng = test::rng();
  std::normal_distribution<double> normal;
  const test::Room room;
  const std::unique_ptr<LioMap> map = make_map(MapType::kNvm, MapOptions{});
  for (int i = 0; i < 20; ++i) {
    const test::RoomScan scan = room.scan(Pose::Identity(), 3000, 0.005, rng);
    map->insert(
        scan.points, scan.normals, std::vector<PointValues>(scan.points.size()), Pose::Identity());
  }
  Pose T_body_lidar = Pose::Identity();
  T_body_lidar.linear() = so3_exp({0.3, -1.0, 2.0});
  T_body_lidar.translation() << 0.4, -0.3, 0.8;
  DeskewWatch watch;
  for (int i = 0; i < scans; ++i) {
    const SweepMotion motion{
        0.5 * Eigen::Vector3d(normal(rng), normal(rng), normal(rng)),
        turning * Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized()};
    test::RoomScan scan = room.scan(Pose::Identity(), 600, 0.01, rng);
    std::vector<float> ages;
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      ages.push_back(kSweep * static_cast<float>(k) / static_cast<float>(scan.points.size()));
      const Eigen::Vector3d p = scan.points[k].cast<double>();
      const double excess = (1.0 - share) * static_cast<double>(ages[k]);
      scan.points[k] -= (excess * (motion.velocity + motion.rate.cross(p))).cast<float>();
    }
    watch.add(
        *map,
        {scan.points, scan.normals, ages},
        T_body_lidar.inverse(),
        T_body_lidar,
        of_body(motion, T_body_lidar));
  }
  return watch.finding();
}

TEST(DeskewWatch, NoticesPointsThatWereDeskewedBefore) {
  EXPECT_THAT(finding(0.0, 20, 0.6), HasSubstr("input.point_time_field=none"));
  EXPECT_THAT(finding(-1.0, 20, 0.6), HasSubstr("moves their points less"));
}

TEST(DeskewWatch, NoticesTimesThatSpanTooLittle) {
  EXPECT_THAT(finding(2.0, 20, 0.6), HasSubstr("moves their points more"));
}

TEST(DeskewWatch, IsSilentOfRightTimesAndOfWhatSaysNothing) {
  EXPECT_EQ(finding(1.0, 40, 0.6), "");
  EXPECT_EQ(finding(1.02, 40, 0.6), "");
  EXPECT_EQ(finding(0.0, 40, 0.1), "");  // hardly turns
  EXPECT_EQ(finding(0.0, 3, 0.6), "");   // too few
}

}  // namespace
}  // namespace nvm::lio
