// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "lio/constant_velocity.hpp"
#include "lio/deskew.hpp"
#include "lio/executor.hpp"
#include "lio/keypoints.hpp"
#include "lio/lidar_odometry_options.hpp"
#include "lio/pipeline.hpp"
#include "lio/start_search.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// Odometry from scans alone, scan to map: predict at constant velocity, deskew where points have
/// times, estimate normals, align to the map, deskew by the motion found and align again, insert. A
/// frame of which too little fits is aligned again from several coarse starts, so that sudden turns
/// at a low scan rate are followed.
class LidarOdometry final : public Pipeline {
 public:
  /// Throws std::invalid_argument for bad options.
  LidarOdometry(
      const LidarOdometryOptions& options, std::unique_ptr<LioMap> map, const Executor& executor);

  void add_imu(const ImuSample& /*sample*/) override {}
  FrameResult process(const Scan& scan) override;
  const LioMap& map() const override { return *map_; }
  const DeskewedScan& scan() const override { return scan_; }
  const std::vector<Eigen::Vector3f>& normals() const override { return *normals_; }
  void start_at(const Pose& T_map_body) override;

 private:
  using Normals = std::vector<Eigen::Vector3f>;

  bool is_usable(const Scan& scan, FrameResult& result) const;
  void predict(const Scan& scan);
  const Normals& prepare(const Scan& scan, FrameResult& result);
  void match(const Normals& normals, FrameResult& result);
  void choose_keypoints(const Normals& normals);
  AlignResult align(const Normals& normals);
  AlignResult refine(const Normals& normals, const AlignResult& first);
  bool is_believable(const AlignResult& result) const;
  bool convinces(const AlignResult& result, const Pose& start) const;
  void insert(const Normals& normals, FrameResult& result);

  LidarOdometryOptions options_;
  Executor executor_;
  NormalEstimator normal_estimator_;
  KeypointSampler sampler_;
  ScanAligner<LioMap> aligner_;
  StartSearch search_;
  std::unique_ptr<LioMap> map_;
  std::optional<ConstantVelocity> motion_;  // of the body; nothing before the first believed scan
  NavState predicted_;                      // at the end of the scan in work
  // Kept for their memory.
  std::vector<MotionSegment> segments_;
  DeskewedScan scan_;
  std::vector<Eigen::Vector3f> key_points_, key_normals_;
  Normals no_normals_;
  const Normals* normals_ = &no_normals_;  // of scan_
};

}  // namespace nvm::lio
