// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/prior_pipeline.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lio/room_recording.hpp"
#include "nvm/map/sighting.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

using test::RoomRecording;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

PipelineOptions thin_scan_options(PipelineType type) {
  PipelineOptions options;
  options.type = type;
  options.inertial.normals.min_radius = 0.3;  // the recording's scans are thin
  options.inertial.normals.max_radius = 0.6;
  return options;
}

/// The room's pose in the prior map's frame: level, or not.
Pose room_in_map(double tilt) {
  Pose T_map_room = Pose::Identity();
  T_map_room.linear() = so3_exp({0.0, 0.0, 2.0}) * so3_exp({tilt, 0.0, 0.0});
  T_map_room.translation() << 30.0, -12.0, 4.0;
  return T_map_room;
}

VoxelMap prior_map(const Pose& T_map_room) {
  auto random = test::rng();
  const test::Room room;
  MapOptions options;
  options.capacity = 50'000;
  options.min_point_distance = 0.07;
  VoxelMap map(options);
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(0.0, 0.0, 0.0), {2.0, 1.5, 0.3}, {-3.0, 2.0, 0.0}, {1.0, -2.0, 0.5}}) {
    Pose T_room_scan = Pose::Identity();
    T_room_scan.translation() = place;
    const test::RoomScan scan = room.scan(T_room_scan, 20'000, 0.005, random);
    map.insert(scan.points, scan.normals, T_map_room * T_room_scan);
  }
  return map;
}

RoomRecording recording() {
  RoomRecording recording;
  recording.duration = 3.0;
  return recording;
}

/// The largest distance [m] of the poses that were claimed to the truth in the prior map.
double worst_error(
    const RoomRecording& recording,
    const Pose& T_map_room,
    const std::vector<FrameResult>& results) {
  double worst = 0.0;
  for (const FrameResult& result : results) {
    if (result.status != FrameStatus::kInitializing) {
      const Pose truth = T_map_room * recording.motion.pose(result.time);
      const Eigen::Vector3d error = truth.translation() - result.T_map_body.translation();
      worst = std::max(worst, error.norm());
    }
  }
  return worst;
}

class EveryPipelineInAPriorMap : public ::testing::TestWithParam<PipelineType> {};

TEST_P(EveryPipelineInAPriorMap, FindsItsWayNearAStartAndLeavesTheMapAsItIs) {
  const Pose T_map_room = room_in_map(0.0);
  const std::size_t size = prior_map(T_map_room).size();
  Start start{T_map_room, true};
  start.T_map_body.translation() += Eigen::Vector3d(0.4, -0.3, 0.1);
  start.T_map_body.linear() = so3_exp({0.0, 0.0, 2.2});
  PriorPipeline pipeline(thin_scan_options(GetParam()), prior_map(T_map_room), start, false);
  const std::vector<FrameResult> results = recording().run(pipeline);
  EXPECT_EQ(results.back().status, FrameStatus::kTracking);
  EXPECT_LT(worst_error(recording(), T_map_room, results), 0.05);
  EXPECT_EQ(pipeline.map().size(), size);
}

INSTANTIATE_TEST_SUITE_P(
    Types,
    EveryPipelineInAPriorMap,
    ::testing::Values(
        PipelineType::kFastLio,
        PipelineType::kCtLio,
        PipelineType::kCtLioContinuous,
        PipelineType::kLidarOnly));

TEST(PriorPipeline, FindsThePlaceByItself) {
  const Pose T_map_room = room_in_map(0.0);
  PriorPipeline pipeline(
      thin_scan_options(PipelineType::kFastLio), prior_map(T_map_room), std::nullopt, false);
  const std::vector<FrameResult> results = recording().run(pipeline);
  EXPECT_EQ(results.back().status, FrameStatus::kTracking);
  EXPECT_LT(worst_error(recording(), T_map_room, results), 0.05);
}

TEST(PriorPipeline, IsNotLostWhereNoPlaceWasConfirmed) {
  PipelineOptions options = thin_scan_options(PipelineType::kLidarOnly);
  options.lidar_only.align.min_residuals = 100'000;  // more than any scan has
  const Pose T_map_room = room_in_map(0.0);
  PriorPipeline pipeline(options, prior_map(T_map_room), Start{T_map_room, true}, false);
  RoomRecording recording;
  recording.duration = 0.5;
  for (const FrameResult& result : recording.run(pipeline)) {
    EXPECT_EQ(result.status, FrameStatus::kInitializing);
  }
  EXPECT_THAT(pipeline.findings(), Not(Contains(HasSubstr("lost"))));
}

TEST(PriorPipeline, TakesGravityFromTheScansInATiltedMap) {
  const Pose T_map_room = room_in_map(0.5);
  PriorPipeline pipeline(
      thin_scan_options(PipelineType::kFastLio),
      prior_map(T_map_room),
      Start{T_map_room, false},
      false);
  const std::vector<FrameResult> results = recording().run(pipeline);
  EXPECT_EQ(results.back().status, FrameStatus::kTracking);
  EXPECT_LT(worst_error(recording(), T_map_room, results), 0.05);
}

TEST(PriorPipeline, ExtendsTheMapOnlyWhenAskedTo) {
  const Pose T_map_room = room_in_map(0.0);
  const std::size_t size = prior_map(T_map_room).size();
  PriorPipeline pipeline(
      thin_scan_options(PipelineType::kFastLio),
      prior_map(T_map_room),
      Start{T_map_room, true},
      true);
  recording().run(pipeline);
  EXPECT_GT(pipeline.map().size(), size);
}

// Half a turn puts most of a scan on the walls of a room as well.
TEST(PriorPipeline, FindsThePlaceByItselfWhereTheStartIsWrong) {
  const Pose T_map_room = room_in_map(0.0);
  for (const auto& [distance, turn] : {std::pair(20.0, 0.0), {0.0, 3.14}, {0.0, 1.57}}) {
    Start start{T_map_room, true};
    start.T_map_body.translation().x() += distance;
    start.T_map_body.linear() *= so3_exp({0.0, 0.0, turn});
    PriorPipeline pipeline(
        thin_scan_options(PipelineType::kFastLio), prior_map(T_map_room), start, false);
    const std::vector<FrameResult> results = recording().run(pipeline);
    EXPECT_EQ(results.back().status, FrameStatus::kTracking);
    EXPECT_LT(worst_error(recording(), T_map_room, results), 0.05);
    EXPECT_THAT(
        pipeline.findings(), Contains(HasSubstr("the start that was given is wrong: the first")));
  }
}

TEST(PriorPipeline, ClaimsNoPlaceWhereTheScansDoNotFit) {
  VoxelMap map;
  std::vector<Eigen::Vector3f> points, normals;
  for (int i = 0; i < 10'000; ++i) {  // a wall alone
    points.emplace_back(
        3.0F, 0.05F * static_cast<float>(i % 100), 0.05F * static_cast<float>(i / 100));
    normals.emplace_back(-1.0F, 0.0F, 0.0F);
  }
  map.insert(points, normals);
  PriorPipeline pipeline(thin_scan_options(PipelineType::kFastLio), std::move(map), Start{}, false);
  for (const FrameResult& result : recording().run(pipeline)) {
    EXPECT_EQ(result.status, FrameStatus::kInitializing);
    EXPECT_THAT(result.message, HasSubstr("not found in the prior map"));
  }
}

TEST(PriorPipeline, NeverTakesTheOutsideOfARoomForItsInside) {
  auto random = test::rng();
  test::RoomScan scan = test::Room().scan(Pose::Identity(), 60'000, 0.005, random);
  for (Eigen::Vector3f& normal : scan.normals) {
    normal = -normal;
  }
  VoxelMap map;
  map.insert(scan.points, scan.normals);
  PriorPipeline pipeline(
      thin_scan_options(PipelineType::kLidarOnly), std::move(map), std::nullopt, false);
  RoomRecording short_recording = recording();
  short_recording.duration = 0.5;
  for (const FrameResult& result : short_recording.run(pipeline)) {
    EXPECT_EQ(result.status, FrameStatus::kInitializing);
  }
}

TEST(PriorPipeline, RefusesMapsWithoutPointsOrNormals) {
  const PipelineOptions options = thin_scan_options(PipelineType::kLidarOnly);
  const auto make = [&](VoxelMap map) {
    PriorPipeline(options, std::move(map), std::nullopt, false);
  };
  EXPECT_THROW(make(VoxelMap()), std::invalid_argument);
  VoxelMap unsided;
  unsided.insert_unsided(std::vector<Eigen::Vector3f>{{1.0F, 2.0F, 3.0F}});
  EXPECT_THROW(make(std::move(unsided)), std::invalid_argument);
  VoxelMap of_sightings;
  const std::vector<Eigen::Vector3f> points{{1.0F, 2.0F, 3.0F}};
  const std::vector<Eigen::Vector3f> sightings{sighting(points[0], Eigen::Vector3d::Zero())};
  of_sightings.insert(points, sightings, Pose::Identity());
  ASSERT_EQ(of_sightings.size(), 1U);
  EXPECT_THROW(make(std::move(of_sightings)), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::lio
