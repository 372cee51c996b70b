// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/executor.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "lio/place/loss_watch.hpp"
#include "lio/place/place_search.hpp"
#include "lio/scan/deskew.hpp"
#include "nvm/normal/normal_estimator.hpp"

namespace nvm::lio {

/// Where a run in a prior map begins.
struct Start {
  Pose T_map_body = Pose::Identity();
  bool is_upright = false;  ///< only place and heading are given: gravity tells the rest
};

/// Runs a pipeline in a map that others have made: finds the place of the first scans near the
/// start, or anywhere in the map without one, and has the pipeline go on from there. Until then
/// frames are kInitializing and say why.
///
/// When the pose is lost, or no scan could tell it for so long that the sensor may have been
/// carried anywhere, the whole map is searched again, and until a place in it is beyond doubt
/// frames are kLost and say why.
class PriorPipeline final : public Pipeline {
 public:
  /// `prior` has points with normals. Extended, it takes the scans in; else it stays as it is.
  /// Throws std::invalid_argument for bad options, and for a prior or a type of map that this
  /// cannot use.
  PriorPipeline(
      const PipelineOptions& options,
      VoxelMap prior,
      const std::optional<Start>& start,
      bool extends);

  void add_imu(const ImuSample& sample) override;
  double imu_needed_until(double time) const override { return pipeline_->imu_needed_until(time); }
  FrameResult process(const Scan& scan) override;
  const LioMap& map() const override { return pipeline_->map(); }
  const DeskewedScan& scan() const override { return pipeline_->scan(); }
  const std::vector<Eigen::Vector3f>& normals() const override { return pipeline_->normals(); }
  void start_at(const Pose& T_map_body) override { start_ = Start{T_map_body, false}; }
  std::optional<ImuSetup> better_imu_setup() const override {
    return pipeline_->better_imu_setup();
  }
  std::vector<std::string> findings() const override;

 private:
  FrameResult search(const Scan& scan);
  void lose(double time);
  void believe(const FrameResult& result);
  bool is_doubtful(const FrameResult& result) const;
  double contradiction(const Pose& T_map_lidar) const;
  Place find(const Scan& scan);
  Place find_near_start(const std::vector<Eigen::Vector3f>& normals, const Eigen::Vector3d& up);
  Eigen::Matrix3d level() const;
  Pose guess() const;
  bool is_to_search(double time);

  std::optional<Start> start_;
  ReturnLimits returns_;
  NavState body_;  ///< at rest: nothing is known of the motion yet
  Executor executor_;
  NormalEstimator normal_estimator_;
  std::unique_ptr<Pipeline> pipeline_;
  std::optional<PlaceSearch> search_;
  LossWatch watch_;
  bool is_placed_ = false;
  std::string start_finding_;             ///< that the start which was given is wrong, or may be
  std::optional<Pose> last_pose_;         ///< T_map_body of the last frame that was believed
  double usual_share_ = 0.0;              ///< of the keypoints, that fitted of late
  double last_speed_ = 0.0;               ///< [m/s]
  bool was_believed_ = false;             ///< the last frame
  std::optional<double> first_try_;       ///< time of the first scan that was searched for [s]
  double next_try_ = -1e300;              ///< [s]
  std::optional<Eigen::Vector3d> force_;  ///< mean specific force of late [m/s^2], body frame
  double force_time_ = 0.0;               ///< of the last reading in it [s]
  DeskewedScan scan_;                     // kept for its memory
};

}  // namespace nvm::lio
