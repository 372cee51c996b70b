// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Runs in a prior map that lose their pose: the sensor is carried away, covered or switched off.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "lio/pipeline/prior_pipeline.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Pose at(double x, double y, double yaw) {
  Pose pose = Pose::Identity();
  pose.translation() << x, y, 0.0;
  pose.linear() = so3_exp({0.0, 0.0, yaw});
  return pose;
}

const Pose kHere = at(0.5, 0.0, 0.2);
const Pose kThere = at(-2.7, 1.5, 2.6);  // behind the partition

/// What happens to the sensor while it rests somewhere, from `begin` to `end` [s].
enum class View { kOpen, kCovered, kOff, kElsewhere };
struct Stay {
  double begin, end;
  Pose T_room_body;
  View view = View::kOpen;
};

class CarriedAway : public ::testing::TestWithParam<PipelineType> {
 protected:
  static PipelineOptions options() {
    PipelineOptions options;
    options.type = GetParam();
    options.inertial.normals.min_radius = 0.3;  // the scans are thin
    options.inertial.normals.max_radius = 0.6;
    return options;
  }

  VoxelMap prior() {
    MapOptions options;
    options.capacity = 50'000;
    options.min_point_distance = 0.07;
    VoxelMap map(options);
    for (const Pose& T_room_scan : {at(0, 0, 0), at(2, 1.5, 0), at(-3, 2, 0), at(1, -2, 0)}) {
      const test::RoomScan scan = room_.scan(T_room_scan, 20'000, 0.005, random_);
      map.insert(scan.points, scan.normals, T_room_scan);
    }
    return map;
  }

  Scan scan(double time, const Stay& stay) {
    Scan scan{time, time, {}};
    const test::RoomScan seen = room_.scan(stay.T_room_body, 3000, 0.005, random_);
    const float scale = stay.view == View::kCovered     ? 0.01F
                        : stay.view == View::kElsewhere ? 1.6F
                                                        : 1.0F;
    for (const Eigen::Vector3f& point : seen.points) {
      scan.points.push_back({scale * point.x(), scale * point.y(), scale * point.z(), 0, 0, 0});
    }
    return scan;
  }

  /// Frames of `stays`, of which none may be believed off its place.
  std::vector<FrameResult> run(PriorPipeline& pipeline, const std::vector<Stay>& stays) {
    std::vector<FrameResult> frames;
    for (const Stay& stay : stays) {
      for (int i = static_cast<int>(std::lround(stay.begin * 10)); i < stay.end * 10; ++i) {
        const double time = 0.1 * i;
        for (int k = 0; k < 20 && stay.view != View::kOff; ++k) {
          pipeline.add_imu({time - 0.1 + 0.005 * (k + 1), {0, 0, 0}, {0, 0, 9.81}});
        }
        if (stay.view != View::kOff) {
          frames.push_back(pipeline.process(scan(time, stay)));
          expect_no_wrong_claim(frames.back(), stay);
        }
      }
    }
    return frames;
  }

  static void expect_no_wrong_claim(const FrameResult& frame, const Stay& stay) {
    if (is_believed(frame.status)) {
      const Pose error = stay.T_room_body.inverse() * frame.T_map_body;
      EXPECT_NE(stay.view, View::kElsewhere);
      EXPECT_LT(error.translation().norm(), 0.03) << "at " << frame.time;
      EXPECT_LT(so3_log(error.linear()).norm(), 0.02) << "at " << frame.time;
    }
  }

  PriorPipeline pipeline(bool extends = false) {
    return PriorPipeline(options(), prior(), Start{kHere, true}, extends);
  }

  test::Room room_;
  std::mt19937_64 random_ = test::rng();
};

TEST_P(CarriedAway, IsFoundAgainWhenItIsSwitchedOn) {
  PriorPipeline pipeline = this->pipeline();
  const std::vector<FrameResult> frames =
      run(pipeline, {{0.1, 2.5, kHere}, {2.5, 6.0, kHere, View::kOff}, {6.0, 8.0, kThere}});
  EXPECT_TRUE(is_believed(frames.back().status));
  EXPECT_THAT(pipeline.findings(), Contains(HasSubstr("lost from 2.3 to 5.9 s, found again")));
}

TEST_P(CarriedAway, IsFoundAgainWhenItIsUncovered) {
  PriorPipeline pipeline = this->pipeline();
  const std::vector<FrameResult> frames =
      run(pipeline, {{0.1, 2.5, kHere}, {2.5, 6.0, kHere, View::kCovered}, {6.0, 8.0, kThere}});
  EXPECT_TRUE(is_believed(frames.back().status));
  EXPECT_THAT(pipeline.findings(), Contains(HasSubstr("lost from 2.3 to ")));
  const auto again = std::find_if(frames.begin(), frames.end(), [](const FrameResult& frame) {
    return frame.time > 5.95 && is_believed(frame.status);
  });
  ASSERT_NE(again, frames.end());
  EXPECT_THAT(again->message, HasSubstr("found again in the prior map"));
}

TEST_P(CarriedAway, IsFoundAgainBetweenTwoScans) {
  PriorPipeline pipeline = this->pipeline(true);
  const std::vector<FrameResult> frames = run(pipeline, {{0.1, 2.5, kHere}, {2.5, 6.0, kThere}});
  EXPECT_TRUE(is_believed(frames.back().status));
  EXPECT_THAT(pipeline.findings(), Contains(HasSubstr("found again")));
}

TEST_P(CarriedAway, IsNotFoundWhereTheMapDoesNotReach) {
  PriorPipeline pipeline = this->pipeline();
  const std::vector<FrameResult> frames =
      run(pipeline, {{0.1, 2.5, kHere}, {2.5, 3.3, kThere, View::kElsewhere}});
  EXPECT_EQ(frames.back().status, FrameStatus::kLost);
  EXPECT_THAT(frames.back().message, HasSubstr("not found in the prior map"));
  EXPECT_THAT(pipeline.findings(), Contains(HasSubstr("to the end, not found again")));
}

TEST_P(CarriedAway, IsNotLostWhereAnImuBridgesAPause) {
  PriorPipeline pipeline = this->pipeline();
  std::vector<FrameResult> frames = run(pipeline, {{0.1, 2.5, kHere}});
  for (double time = 2.41; time < 4.4; time += 0.005) {
    pipeline.add_imu({time, {0, 0, 0}, {0, 0, 9.81}});
  }
  frames = run(pipeline, {{4.4, 5.0, kHere}});
  EXPECT_TRUE(is_believed(frames.back().status));
  const auto is_told = Contains(HasSubstr("the pose was lost"));
  if (GetParam() == PipelineType::kLidarOnly) {
    EXPECT_THAT(pipeline.findings(), is_told);
  } else {
    EXPECT_THAT(pipeline.findings(), Not(is_told));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Types,
    CarriedAway,
    ::testing::Values(PipelineType::kFastLio, PipelineType::kCtLio, PipelineType::kLidarOnly));

}  // namespace
}  // namespace nvm::lio
