// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What the points of a pipeline's map carry beside is that of the returns that they come from.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "lio/pipeline/pipeline_options.hpp"
#include "lio/room_pipeline.hpp"
#include "lio/room_recording.hpp"

namespace nvm::lio {
namespace {

using test::options_for;
using test::RoomRecording;

class EveryPipeline : public ::testing::TestWithParam<PipelineType> {};

// Returns are numbered by their intensity, and the points of the map tell which they are.
TEST_P(EveryPipeline, KeepsIntensityAndTimeOfEachReturn) {
  constexpr int kStep = 10'000;
  RoomRecording recording;
  recording.duration = 2.5;
  PipelineOptions options = options_for(GetParam());
  options.map.columns.time = true;
  const auto pipeline = make_pipeline(options);
  std::vector<Scan> scans;
  for (int k = 0; k < recording.scan_count(); ++k) {
    recording.feed(*pipeline, k, [&](Scan& scan) {
      for (std::size_t i = 0; i < scan.points.size(); ++i) {
        scan.points[i].intensity = static_cast<float>(kStep * k) + static_cast<float>(i);
      }
      scans.push_back(scan);
    });
  }
  const std::vector<MapPoint> points = pipeline->map().points();
  ASSERT_GT(points.size(), 1000U);
  for (const MapPoint& point : points) {
    const int number = static_cast<int>(point.values.intensity);
    const Scan& scan = scans.at(static_cast<std::size_t>(number / kStep));
    const TimedPoint& of = scan.points.at(static_cast<std::size_t>(number % kStep));
    const double time = scan.t_begin + static_cast<double>(of.dt);
    EXPECT_EQ(point.values.time, time);
    const Eigen::Vector3d seen = recording.motion.pose(time) * Eigen::Vector3d(of.x, of.y, of.z);
    EXPECT_LT((point.position - seen).norm(), 0.1) << number;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines,
    EveryPipeline,
    ::testing::Values(
        PipelineType::kFastLio,
        PipelineType::kCtLio,
        PipelineType::kCtLioContinuous,
        PipelineType::kLidarOnly));

TEST(PipelineOptions, HaveNoColumnsThatNoScanFills) {
  PipelineOptions options = options_for(PipelineType::kFastLio);
  options.map.columns.color = true;
  EXPECT_THROW(make_pipeline(options), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::lio
