// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "common/executor.hpp"
#include "lio/imu/imu_buffer.hpp"
#include "lio/imu/imu_initializer.hpp"
#include "lio/imu/imu_judge.hpp"
#include "lio/imu/imu_noise_learner.hpp"
#include "lio/imu/prediction_watch.hpp"
#include "lio/match/scan_matcher.hpp"
#include "lio/pipeline/lidar_odometry.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "lio/place/start_search.hpp"
#include "lio/scan/deskew.hpp"
#include "lio/scan/keypoints.hpp"
#include "lio/scan/scan_preparer.hpp"
#include "lio/state/error_state_filter.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "nvm/normal/normal_options.hpp"

namespace nvm::lio {

/// What the inertial pipelines share.
struct InertialOptions {
  ImuInputOptions imu_input;
  InitializerOptions initializer;
  /// White noise that is zero is learned from the readings.
  ImuNoise imu_noise;
  /// IMU readings farther apart than this [s] are a gap, which is bridged at constant velocity. 0:
  /// four times what is usual in the stream, and at least 0.05 s.
  double max_imu_gap = 0.0;
  ReturnLimits returns;
  NormalOptions normals;
  /// Points are moved onto the plane of their neighbourhood by at most this [m], 0 or more; with 0
  /// they stay (see project_to_planes).
  double max_plane_offset = 0.05;
  KeypointOptions keypoints;
  /// A frame is believed when at least this share of its residuals fits, 0 to 1.
  double min_inlier_share = 0.5;
  /// Frames that are not believed for longer than this mean "lost" [s].
  double max_weak_duration = 0.5;
  /// Extrinsic, and how sure it is: zero deviations keep it, others let the filter estimate it.
  Pose T_imu_lidar = Pose::Identity();
  double extrinsic_translation_deviation = 0.0;  ///< [m]
  double extrinsic_rotation_deviation = 0.0;     ///< [rad]

  void validate() const;
};

/// The frame of both inertial pipelines: initialise from the IMU, predict to the scan's end,
/// deskew, estimate normals on the deskewed scan with the LiDAR's place at each point's time,
/// match, and insert what was believed. The ScanMatcher makes it FAST-LIO style or CT-LIO style.
///
/// While the IMU cannot be used the scans go their way alone, in the same map: at a start in
/// motion, before its readings begin, after the pose was lost, where a scan lies elsewhere than it
/// led the pose, and for good when an ImuJudge finds that it contradicts them. It joins, and joins
/// again, once both tell the same motion.
class InertialPipeline final : public Pipeline {
 public:
  InertialPipeline(
      const InertialOptions& options,
      std::unique_ptr<ScanMatcher> matcher,
      const LidarOdometryOptions& alone,
      std::shared_ptr<LioMap> map,
      const Executor& executor);

  void add_imu(const ImuSample& sample) override;
  double imu_needed_until(double time) const override { return time - imu_time_offset_; }
  FrameResult process(const Scan& scan) override;
  const LioMap& map() const override { return *map_; }
  const DeskewedScan& scan() const override;
  const std::vector<Eigen::Vector3f>& normals() const override;
  void start_at(const Pose& T_map_body) override;
  std::optional<ImuSetup> better_imu_setup() const override;
  std::vector<std::string> findings() const override;

  /// The filter, once initialised.
  const std::optional<ErrorStateFilter>& filter() const { return filter_; }
  const ImuBufferStats& imu_stats() const { return imu_.stats(); }

 private:
  void read_imu(double until);
  bool initialize(FrameResult& result);
  bool is_to_go_alone(double time);
  void go_alone(const ConstantVelocity& motion);
  FrameResult process_alone(const Scan& scan);
  std::optional<Pose> led_astray_from(
      const Scan& scan, const ConstantVelocity& motion, const FrameResult& result);
  void take_readings(double until, double max_gap);
  bool hangs(const Scan& scan);
  bool has_readings() const;
  bool is_leap(const Pose& T_map_lidar);
  double distance_from_map(const DeskewedScan& scan, const Pose& T_map_lidar) const;
  void leave_imu(const ConstantVelocity& motion);
  void join_imu(const MotionFit& motion);
  void judge_imu(const FrameResult& result);
  void follow_imu_clock();
  std::string why_left() const;
  void forget_accel_bias();
  NavVector extrinsic_deviations() const;
  double max_imu_gap() const;
  void predict(double until);
  void coast(double until);
  void use_rest();
  void believe();
  void prepare(const Scan& scan, FrameResult& result);
  void match(FrameResult& result);
  void begin_map(FrameResult& result);
  void find_again();
  bool is_sure() const;
  bool is_adrift(const UnobservedDirections& unobserved) const;
  bool agrees_with_map(const MatchResult& match) const;
  void watch_deskewing();
  void insert(FrameResult& result);

  InertialOptions options_;
  Executor executor_;
  ImuBuffer imu_;
  ImuInitializer initializer_;
  ImuNoiseLearner noise_learner_;
  ScanPreparer preparer_;
  ImuJudge judge_;
  PredictionWatch predictions_;
  std::shared_ptr<StartSearch> search_;
  std::shared_ptr<LioMap> map_;
  LidarOdometry alone_;
  bool is_alone_ = false;
  bool is_scan_alone_ = false;  ///< the last scan was taken by alone_
  bool is_imu_usable_ = true;
  double slid_time_ = -1e300;  ///< of the last scan alone that left directions open [s]
  double join_after_ = 1.0;    ///< so long must it tell the motion of the scans [s]
  double joined_after_ = 0.0;  ///< by scans alone at the start [s]
  double left_time_ = -1e300;  ///< when the scans last went on without it [s]
  std::unique_ptr<ScanMatcher> matcher_;
  std::size_t min_first_keypoints_;  ///< of a scan that begins a map
  std::optional<Pose> start_;        ///< T_map_body in a map that others have begun
  std::optional<ErrorStateFilter> filter_;
  std::optional<ErrorStateFilter> sure_prediction_;  ///< of the last scan, by readings
  std::size_t leaps_ = 0;                            ///< of scans away from it, on end
  double imu_time_offset_;                           ///< that is added to the times of readings [s]
  double read_until_ = -1e300;                       ///< time of the last reading taken [s]
  ImuNoise imu_noise_;                               ///< that the filter works with
  std::optional<double> first_time_;                 ///< of a scan [s]
  ConstantVelocity motion_{StampedPose()};           ///< of the body, by the frames believed
  double believed_doubt_ = 0.0;                      ///< of its place [m]
  std::optional<double> placed_time_;                ///< of the last that told its place [s]
  std::size_t believed_ = 0;                         ///< frames since the IMU joined
  std::size_t contradictions_ = 0;                   ///< that made it go on without the IMU
  double first_contradiction_ = 0.0;                 ///< since the first scan [s]
  std::vector<Eigen::Vector3f> last_print_;          ///< some of the points of the last scan
  // Kept for their memory.
  std::deque<ImuSample> unread_;  ///< by the initializer
  std::vector<ImuSample> samples_;
  std::vector<MotionSegment> segments_;
  PreparedScan prepared_;
  std::vector<Eigen::Vector3f> key_points_, key_normals_;
  std::vector<float> key_ages_;
};

}  // namespace nvm::lio
