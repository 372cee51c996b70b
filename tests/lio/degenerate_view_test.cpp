// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lio/pipeline/pipeline.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "lio/room_pipeline.hpp"
#include "lio/room_recording.hpp"

namespace nvm::lio {
namespace {

using test::RoomRecording;

class ADegenerateView : public ::testing::TestWithParam<PipelineType> {
 protected:
  FrameResult last_result(
      const std::function<bool(const Eigen::Vector3d&)>& sees, double duration = 4.0) {
    recording_.duration = duration;
    recording_.points_per_scan = 6000;
    recording_.sees = sees;
    const auto pipeline = make_pipeline(test::options_for(GetParam()));
    return recording_.run(*pipeline).back();
  }

  RoomRecording recording_;
};

TEST_P(ADegenerateView, OfTheFloorAloneIsReportedAndLeftToTheImu) {
  const FrameResult result = last_result([](const Eigen::Vector3d& p) { return p.z() < -1.49; });
  EXPECT_EQ(result.status, FrameStatus::kTracking);
  EXPECT_GE(result.degenerate_directions, 3);
  EXPECT_LT(recording_.error(result), 0.15);
}

TEST_P(ADegenerateView, OfACorridorIsReportedAndLeftToTheImu) {
  const FrameResult result =
      last_result([](const Eigen::Vector3d& p) { return std::abs(p.y()) > 2.95 || p.z() < -1.45; });
  EXPECT_EQ(result.status, FrameStatus::kTracking);
  EXPECT_GE(result.degenerate_directions, 1);
  EXPECT_LT(recording_.error(result), 0.15);
}

TEST_P(ADegenerateView, ThatLastsIsSaidThoughTheFilterIsSure) {
  const FrameResult result =
      last_result([](const Eigen::Vector3d& p) { return p.z() < -1.49; }, 7.0);
  EXPECT_EQ(result.status, FrameStatus::kDegenerate);
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines,
    ADegenerateView,
    ::testing::Values(
        PipelineType::kFastLio, PipelineType::kCtLio, PipelineType::kCtLioContinuous));
}  // namespace
}  // namespace nvm::lio
