// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// Scans that are not what the sensor sees, and readings that end: a sound IMU keeps the pose.
#include <gmock/gmock.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lio/room_pipeline.hpp"
#include "lio/room_recording.hpp"

namespace nvm::lio {
namespace {

using test::RoomRecording;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class DamagedScans : public ::testing::TestWithParam<PipelineType> {
 protected:
  /// Feeds the recording, with the scan that `sent` gives for each; no frame that is believed may
  /// lie off its place.
  std::vector<FrameResult> run(const std::function<Scan(int)>& sent) {
    std::vector<FrameResult> frames;
    for (int i = 0; i < recording_.scan_count(); ++i) {
      frames.push_back(
          recording_.feed(*pipeline_, i, [&](Scan& scan) { scan.points = sent(i).points; }));
      if (is_believed(frames.back().status) && i > 15) {
        EXPECT_LT(recording_.error_since(frames[15], frames.back()), 0.02) << i;
      }
    }
    return frames;
  }

  RoomRecording recording_;
  std::unique_ptr<Pipeline> pipeline_ = make_pipeline(test::options_for(GetParam()));
};

TEST_P(DamagedScans, ThatLieElsewhereAreNotBelieved) {
  for (const float shift : {0.3F, 1.0F}) {
    pipeline_ = make_pipeline(test::options_for(GetParam()));
    const auto frames = run([&](int i) {
      Scan scan = recording_.scan(i);
      for (TimedPoint& point : scan.points) {
        point.x += i >= 40 && i < 42 ? shift : 0.0F;
      }
      return scan;
    });
    for (std::size_t i = 16; i < frames.size(); ++i) {
      EXPECT_EQ(is_believed(frames[i].status), i < 40 || i >= 42) << i;
    }
    EXPECT_THAT(pipeline_->findings(), ::testing::IsEmpty());
  }
}

TEST_P(DamagedScans, OfALidarThatHangsAreSkipped) {
  for (const int end : {45, recording_.scan_count()}) {
    pipeline_ = make_pipeline(test::options_for(GetParam()));
    const auto frames = run([&](int i) { return recording_.scan(i >= 40 && i < end ? 40 : i); });
    for (int i = 16; i < recording_.scan_count(); ++i) {
      const bool hangs = i > 40 && i < end;
      EXPECT_EQ(frames[static_cast<std::size_t>(i)].status == FrameStatus::kSkipped, hangs) << i;
    }
  }
}

TEST_P(DamagedScans, ThatAreAllAlikeAreTakenWhereNothingMoves) {
  recording_.motion.start = 100.0;
  recording_.duration = 3.0;
  for (const FrameResult& frame : run([&](int) { return recording_.scan(0); })) {
    EXPECT_NE(frame.status, FrameStatus::kSkipped) << frame.time;
  }
}

TEST_P(DamagedScans, GoOnWhereTheReadingsEnd) {
  recording_.imu_gap = {4.0, 1e9};
  const auto frames = recording_.run(*pipeline_);
  EXPECT_TRUE(is_believed(frames.back().status)) << frames.back().message;
  EXPECT_LT(recording_.error_since(frames[15], frames.back()), 0.05);
  EXPECT_THAT(pipeline_->findings(), ElementsAre(HasSubstr("readings end 2.0 s before")));
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines, DamagedScans, ::testing::Values(PipelineType::kFastLio, PipelineType::kCtLio));

}  // namespace
}  // namespace nvm::lio
