// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/executor.hpp"
#include "lio/match/deskew_watch.hpp"
#include "lio/match/faint_direction.hpp"
#include "lio/pipeline/lidar_odometry_options.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "lio/place/start_search.hpp"
#include "lio/scan/deskew.hpp"
#include "lio/scan/keypoints.hpp"
#include "lio/state/constant_velocity.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// Odometry from scans alone, scan to map: predict at constant velocity, deskew where points have
/// times, estimate normals, align to the map, deskew by the motion found and align again, insert. A
/// frame of which too little fits is aligned again from several coarse starts, so that sudden turns
/// at a low scan rate are followed.
class LidarOdometry final : public Pipeline {
 public:
  /// When a start was, so that it tells no velocity and a scan that does not fit there counts as
  /// lost [s].
  static constexpr double kLongAgo = -1e9;

  /// Throws std::invalid_argument for bad options.
  LidarOdometry(
      const LidarOdometryOptions& options, std::shared_ptr<LioMap> map, const Executor& executor);
  /// With a coarse map of the same scans that others use too, like `map`.
  LidarOdometry(
      const LidarOdometryOptions& options,
      std::shared_ptr<LioMap> map,
      std::shared_ptr<StartSearch> search,
      const Executor& executor);

  /// The motion before the next scan, for a map that others have begun or a start that is not the
  /// identity.
  void continue_from(const ConstantVelocity& motion);
  /// Where the next scan lies in a map that has been begun. It leaves no trace: process() may take
  /// the same scan after it.
  FrameResult locate(const Scan& scan);

  void add_imu(const ImuSample& /*sample*/) override {}
  FrameResult process(const Scan& scan) override;
  const LioMap& map() const override { return *map_; }
  const DeskewedScan& scan() const override { return scan_; }
  const std::vector<Eigen::Vector3f>& normals() const override { return estimated_->normals; }
  void start_at(const Pose& T_map_body) override;
  std::vector<std::string> findings() const override;
  /// Planes of scan().
  const NormalResult& estimated() const { return *estimated_; }
  /// Of scan(): those that were matched.
  const std::vector<std::uint32_t>& keypoints() const { return keypoints_; }
  /// What the scans say of the times of their points. Others may lead some of the scans.
  DeskewWatch& deskew_watch() { return deskew_watch_; }
  const DeskewWatch& deskew_watch() const { return deskew_watch_; }

 private:
  using Normals = std::vector<Eigen::Vector3f>;

  bool is_usable(const Scan& scan, FrameResult& result) const;
  void predict(const Scan& scan);
  const Normals& prepare(const Scan& scan, FrameResult& result);
  void follow(const Scan& scan, FrameResult& result);
  void begin_map_again(const Pose& T_map_body);
  void settle_first(const Scan& scan, FrameResult& result);
  bool deskew_first(const FrameResult& second);
  void match(const Normals& normals, FrameResult& result);
  void describe_directions(FrameResult& result);
  void choose_keypoints(const Normals& normals);
  void watch_deskewing(const Pose& T_map_lidar);
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
  std::shared_ptr<StartSearch> search_;
  std::shared_ptr<LioMap> map_;
  std::optional<ConstantVelocity> motion_;  // of the body; nothing before the first believed scan
  FaintDirection faint_;
  DeskewWatch deskew_watch_;
  NavState predicted_;          // at the end of the scan in work
  double observed_time_ = 0.0;  // of the last believed frame that told all directions [s]
  std::optional<Scan> first_;   // of the map, until the second tells how it moved
  Pose first_pose_;             // T_map_body of it
  std::size_t in_own_map_ = 0;  // scans, since this began the map
  bool began_map_ = false;
  // Kept for their memory.
  std::vector<MotionSegment> segments_;
  DeskewedScan scan_;
  std::vector<std::uint32_t> keypoints_;
  std::vector<Eigen::Vector3f> key_points_, key_normals_;
  std::vector<float> key_ages_;
  NormalResult nothing_;
  const NormalResult* estimated_ = &nothing_;  // of scan_
};

}  // namespace nvm::lio
