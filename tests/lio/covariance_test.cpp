// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lio/pipeline/pipeline_options.hpp"
#include "lio/room_recording.hpp"

namespace nvm::lio {
namespace {

using test::RoomRecording;

class PoseCovarianceOf : public ::testing::TestWithParam<PipelineType> {
 protected:
  /// The last frame of a walk in a corridor along x.
  FrameResult in_a_corridor() {
    RoomRecording recording;
    recording.duration = 3.0;
    recording.points_per_scan = 6000;
    recording.sees = [](const Eigen::Vector3d& p) {
      return std::abs(p.y()) > 2.95 || p.z() < -1.45;
    };
    PipelineOptions options;
    options.type = GetParam();
    options.inertial.normals.min_radius = 0.3;  // the recording's scans are thin
    options.inertial.normals.max_radius = 0.6;
    const auto pipeline = make_pipeline(options);
    return recording.run(*pipeline).back();
  }
};

TEST_P(PoseCovarianceOf, ACorridorIsLargestAlongIt) {
  const FrameResult result = in_a_corridor();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> position(
      result.pose_covariance.topLeftCorner<3, 3>());
  EXPECT_GT(position.eigenvalues()[0], 0.0);
  EXPECT_LT(position.eigenvalues()[0], 1e-4);
  EXPECT_GT(position.eigenvalues()[2], 4.0 * position.eigenvalues()[1]);
  EXPECT_GT(std::abs(position.eigenvectors()(0, 2)), 0.95);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> all(result.pose_covariance);
  EXPECT_GT(all.eigenvalues()[0], 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Pipelines,
    PoseCovarianceOf,
    ::testing::Values(PipelineType::kFastLio, PipelineType::kLidarOnly));

}  // namespace
}  // namespace nvm::lio
