// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/pipeline.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

#include "lio/pipeline/inertial_pipeline.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "lio/room_pipeline.hpp"
#include "lio/room_recording.hpp"

namespace nvm::lio {
namespace {

using test::options_for;
using test::RoomRecording;

std::unique_ptr<Pipeline> fast_lio() { return make_pipeline(options_for(PipelineType::kFastLio)); }

std::size_t count(const std::vector<FrameResult>& results, FrameStatus status) {
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [&](const FrameResult& r) { return r.status == status; }));
}

void expect_back_on_track(const RoomRecording& recording, const std::vector<FrameResult>& results) {
  EXPECT_EQ(results.back().status, FrameStatus::kTracking);
  EXPECT_LT(recording.error(results.back()), 0.02);
}

using Combination = std::tuple<PipelineType, MapType>;
class EveryInertialPipeline : public ::testing::TestWithParam<Combination> {};

void expect_millimetres(const PipelineOptions& options) {
  const auto pipeline = make_pipeline(options);
  RoomRecording recording;
  recording.duration = 4.0;
  double worst = 0.0;
  const std::vector<FrameResult> results = recording.run(*pipeline);
  for (const FrameResult& result : results) {
    if (result.status == FrameStatus::kTracking) {
      worst = std::max(worst, recording.error(result));
    }
  }
  EXPECT_GE(count(results, FrameStatus::kTracking), 28U);
  EXPECT_EQ(count(results, FrameStatus::kWeak), 0U);
  EXPECT_LT(worst, 0.012);
  EXPECT_GT(pipeline->map().size(), 1000U);
}

TEST_P(EveryInertialPipeline, TracksARoomToMillimetres) {
  const auto [type, map] = GetParam();
  expect_millimetres(options_for(type, map));
}

TEST(ScanToMapOptimisation, TracksARoomLooselyCoupledToo) {
  PipelineOptions options = options_for(PipelineType::kCtLio);
  options.coupling = Coupling::kLoose;
  expect_millimetres(options);
}

TEST(ScanToMapOptimisation, RefusesABadDeviation) {
  PipelineOptions options = options_for(PipelineType::kCtLio);
  options.residual_deviation = 0.0;
  EXPECT_THROW(make_pipeline(options), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines,
    EveryInertialPipeline,
    ::testing::Values(
        Combination{PipelineType::kFastLio, MapType::kNvm},
        Combination{PipelineType::kCtLio, MapType::kNvm},
        Combination{PipelineType::kCtLioContinuous, MapType::kNvm},
        Combination{PipelineType::kFastLio, MapType::kVoxel},
        Combination{PipelineType::kFastLio, MapType::kFacing},
        Combination{PipelineType::kFastLio, MapType::kReject},
        Combination{PipelineType::kFastLio, MapType::kKdTree},
        Combination{PipelineType::kCtLio, MapType::kVoxel},
        Combination{PipelineType::kCtLioContinuous, MapType::kKdTree}));

class AnyNumberOfThreads : public ::testing::TestWithParam<PipelineType> {};

TEST_P(AnyNumberOfThreads, GivesTheSameBits) {
  RoomRecording recording;
  recording.duration = 2.5;
  std::vector<std::vector<FrameResult>> runs;
  for (const int threads : {1, 2, 4}) {
    PipelineOptions options = options_for(GetParam());
    options.threads = threads;
    runs.push_back(recording.run(*make_pipeline(options)));
  }
  for (const std::vector<FrameResult>& run : runs) {
    ASSERT_EQ(run.size(), runs[0].size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_EQ(run[i].T_map_body.matrix(), runs[0][i].T_map_body.matrix()) << "scan " << i;
      EXPECT_EQ(run[i].inserted.stored, runs[0][i].inserted.stored) << "scan " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines,
    AnyNumberOfThreads,
    ::testing::Values(
        PipelineType::kFastLio, PipelineType::kCtLio, PipelineType::kCtLioContinuous));

class AfterAGapOfTwoSeconds : public ::testing::TestWithParam<PipelineType> {
 protected:
  AfterAGapOfTwoSeconds() { recording_.duration = 7.0; }

  void expect_recovery() {
    const auto pipeline = make_pipeline(options_for(GetParam()));
    expect_back_on_track(recording_, recording_.run(*pipeline));
  }

  RoomRecording recording_;
};

TEST_P(AfterAGapOfTwoSeconds, InTheScansRecovers) {
  recording_.scan_gap = {2.5, 4.5};
  expect_recovery();
}

TEST_P(AfterAGapOfTwoSeconds, InTheImuRecovers) {
  recording_.imu_gap = {2.5, 4.5};
  expect_recovery();
}

TEST_P(AfterAGapOfTwoSeconds, InBothRecovers) {
  recording_.scan_gap = recording_.imu_gap = {2.5, 4.5};
  expect_recovery();
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines,
    AfterAGapOfTwoSeconds,
    ::testing::Values(
        PipelineType::kFastLio, PipelineType::kCtLio, PipelineType::kCtLioContinuous));

TEST(InertialPipeline, SaysWhyThereIsNoPoseYet) {
  const FrameResult result = fast_lio()->process(RoomRecording().scan(0));
  EXPECT_EQ(result.status, FrameStatus::kInitializing);
  EXPECT_THAT(result.message, ::testing::HasSubstr("no IMU data"));
}

TEST(InertialPipeline, KeepsScansThatFitNothingOutOfTheMapAndSaysLost) {
  RoomRecording recording;
  recording.duration = 2.0;
  const auto pipeline = fast_lio();
  recording.run(*pipeline);
  const std::size_t before = pipeline->map().size();
  FrameResult result;
  for (int i = 20; i < 30; ++i) {
    result = recording.feed(*pipeline, i, [](Scan& scan) {
      for (TimedPoint& point : scan.points) {
        point.x *= 40.0F;
        point.y *= 40.0F;
        point.z *= 40.0F;
      }
    });
    EXPECT_TRUE(result.status == FrameStatus::kWeak || result.status == FrameStatus::kLost);
  }
  EXPECT_EQ(result.status, FrameStatus::kLost);
  EXPECT_THAT(result.message, ::testing::HasSubstr("too little"));
  EXPECT_EQ(pipeline->map().size(), before);
}

TEST(InertialPipeline, KeepsScansWithFewReturnsOutOfTheMap) {
  RoomRecording recording;
  recording.duration = 2.0;
  const auto pipeline = fast_lio();
  recording.run(*pipeline);
  const std::size_t before = pipeline->map().size();
  const FrameResult result =
      recording.feed(*pipeline, 20, [](Scan& scan) { scan.points.resize(30); });
  EXPECT_EQ(result.status, FrameStatus::kWeak);
  EXPECT_EQ(pipeline->map().size(), before);
  EXPECT_EQ(recording.feed(*pipeline, 21).status, FrameStatus::kTracking);
}

TEST(InertialPipeline, SkipsEmptyAndOldScans) {
  RoomRecording recording;
  recording.duration = 2.0;
  const auto pipeline = fast_lio();
  recording.run(*pipeline);
  EXPECT_EQ(pipeline->process(recording.scan(5)).status, FrameStatus::kSkipped);
  EXPECT_EQ(pipeline->process(Scan{2.0, 2.1, {}}).status, FrameStatus::kSkipped);
  EXPECT_EQ(recording.feed(*pipeline, 20).status, FrameStatus::kTracking);
}

TEST(InertialPipeline, TakesNoHarmFromNonFiniteReturns) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  RoomRecording recording;
  recording.duration = 2.0;
  const auto pipeline = fast_lio();
  recording.run(*pipeline);
  const FrameResult all_bad = recording.feed(*pipeline, 20, [](Scan& scan) {
    std::fill(scan.points.begin(), scan.points.end(), TimedPoint{kNaN, kNaN, kNaN, 0.0F, 0.0F, 0});
  });
  EXPECT_EQ(all_bad.status, FrameStatus::kWeak);
  const FrameResult half_bad = recording.feed(*pipeline, 21, [](Scan& scan) {
    for (std::size_t i = 0; i < scan.points.size(); i += 2) {
      scan.points[i].x = kNaN;
    }
  });
  EXPECT_EQ(half_bad.status, FrameStatus::kTracking);
  EXPECT_LT(recording.error(half_bad), 0.012);
}

TEST(InertialPipeline, TakesNoHarmFromReadingsThatAreLateRepeatedOrNotFinite) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  RoomRecording recording;
  recording.duration = 3.0;
  const auto clean = fast_lio();
  const auto disturbed = fast_lio();
  for (int i = 0; i < recording.scan_count(); ++i) {
    const FrameResult expected = recording.feed(*clean, i);
    const double end = (i + 1) * recording.scan_period;
    disturbed->add_imu({kNaN, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
    disturbed->add_imu({end, Eigen::Vector3d::Constant(kNaN), Eigen::Vector3d::Zero()});
    if (i > 15) {
      disturbed->add_imu({end - 1.0, Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones()});
    }
    const FrameResult result = recording.feed(*disturbed, i);
    EXPECT_EQ(result.T_map_body.matrix(), expected.T_map_body.matrix()) << "scan " << i;
    disturbed->add_imu(recording.imu(i).back());
  }
}

TEST(InertialPipeline, EstimatesAWrongExtrinsicWhenAsked) {
  RoomRecording recording;
  recording.duration = 8.0;
  PipelineOptions options = options_for(PipelineType::kFastLio);
  options.inertial.T_imu_lidar.linear() = so3_exp(Eigen::Vector3d(0.03, 0.0, 0.0));
  options.inertial.extrinsic_rotation_deviation = 0.03;
  const auto pipeline = make_pipeline(options);
  recording.run(*pipeline);
  const auto& filter = dynamic_cast<const InertialPipeline&>(*pipeline).filter();
  ASSERT_TRUE(filter);
  EXPECT_LT(so3_log(filter->state().T_body_lidar.linear()).norm(), 0.01);
}

TEST(PipelineOptions, AreRefusedByNameAndRange) {
  PipelineOptions options = options_for(PipelineType::kFastLio);
  options.measurement.neighbors = 0;
  try {
    make_pipeline(options);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "nvm: neighbors = 0 must be 3 to 64");
  }
}

}  // namespace
}  // namespace nvm::lio
