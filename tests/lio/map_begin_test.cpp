// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include "lio/pipeline/pipeline_options.hpp"
#include "lio/room_recording.hpp"

namespace nvm::lio {
namespace {

using test::RoomRecording;

PipelineOptions begin_options(PipelineType type) {
  PipelineOptions options;
  options.type = type;
  options.map.capacity = 20'000;
  options.inertial.normals.min_radius = 0.3;  // the recording's scans are thin
  options.inertial.normals.max_radius = 0.6;
  return options;
}

// Whatever kind of odometry, a scan without surfaces is no evidence of a pose.
TEST(Pipeline, BeginsNoMapWithAScanThatShowsNoSurface) {
  constexpr int kFirstGood = 40;
  for (const PipelineType type :
       {PipelineType::kFastLio,
        PipelineType::kCtLio,
        PipelineType::kCtLioContinuous,
        PipelineType::kLidarOnly}) {
    RoomRecording recording;
    const auto pipeline = make_pipeline(begin_options(type));
    FrameResult result;
    for (int i = 0; i < kFirstGood; ++i) {
      result = recording.feed(
          *pipeline, i, [i](Scan& scan) { scan.points.resize(i % 2 == 0 ? 2 : 40); });
      EXPECT_EQ(result.status, FrameStatus::kInitializing) << i << " " << result.message;
    }
    EXPECT_THAT(result.message, ::testing::HasSubstr("too few surfaces"));
    EXPECT_EQ(pipeline->map().size(), 0U);
    const FrameResult first = recording.feed(*pipeline, kFirstGood);
    for (int i = kFirstGood + 1; i < recording.scan_count(); ++i) {
      result = recording.feed(*pipeline, i);
      EXPECT_EQ(result.status, FrameStatus::kTracking) << i << " " << result.message;
    }
    EXPECT_LT(recording.error_since(first, result), 0.03);
  }
}

}  // namespace
}  // namespace nvm::lio
