// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// Which scans, and which poses, InertialPipeline does not believe.
#include <cstddef>
#include <utility>
#include <vector>

#include "lio/map/map_agreement.hpp"
#include "lio/pipeline/inertial_pipeline.hpp"
#include "lio/scan/plane_projection.hpp"

namespace nvm::lio {

namespace {

/// Of some of the points of a scan: those of another differ.
std::vector<Eigen::Vector3f> print_of(const Scan& scan) {
  constexpr std::size_t kPoints = 100;
  std::vector<Eigen::Vector3f> print;
  for (std::size_t i = 0; i < scan.points.size(); i += scan.points.size() / kPoints + 1) {
    print.emplace_back(scan.points[i].x, scan.points[i].y, scan.points[i].z);
  }
  return print;
}

}  // namespace

// Without noise, as in a simulator, the scans of one who stands are alike too.
bool InertialPipeline::hangs(const Scan& scan) {
  std::vector<Eigen::Vector3f> print = print_of(scan);
  const bool is_repeat = print == last_print_;
  last_print_ = std::move(print);
  if (!is_repeat) {
    return false;
  }
  take_readings(scan.t_end, 0.0);
  return !samples_.empty() && !judge_stillness(samples_, options_.initializer).still;
}

// Of a sure pose few keypoints may fit, as long as the others lie where the map ends.
bool InertialPipeline::agrees_with_map(const MatchResult& match) const {
  constexpr double kMostly = 0.8;
  if (match.inlier_share >= options_.min_inlier_share) {
    return match.residual_share >= options_.min_inlier_share;
  }
  return match.residual_share >= kMostly &&
         judge_agreement(*map_, key_points_, key_normals_, filter_->state().T_world_lidar())
                 .share() >= options_.min_inlier_share;
}

// Up to the end of the scan, rather than a guess.
bool InertialPipeline::has_readings() const {
  return !samples_.empty() && filter_->state().time - samples_.back().time <= max_imu_gap();
}

// One scan may be damaged or of elsewhere; when more of them lie there, the IMU was wrong.
bool InertialPipeline::is_leap(const Pose& T_map_lidar) {
  constexpr double kLeap = 0.2;         // [m]
  constexpr std::size_t kPatience = 3;  // scans
  const bool leaps =
      sure_prediction_ &&
      (sure_prediction_->state().T_world_lidar().translation() - T_map_lidar.translation()).norm() >
          kLeap;
  leaps_ = leaps ? leaps_ + 1 : 0;
  return leaps && leaps_ <= kPatience;
}

// A doubtful pose is compared with where the scan lies by itself, T_map_lidar: there, if it fits
// the map clearly better.
std::optional<Pose> InertialPipeline::led_astray_from(
    const Scan& scan, const ConstantVelocity& motion, const FrameResult& result) {
  constexpr double kApart = 0.02;    // [m]
  constexpr double kTurned = 0.02;   // [rad]
  constexpr double kClearly = 0.92;  // of a sweep that is deskewed badly both lie off
  if (result.residuals == 0 || !predictions_.is_doubtful()) {
    return std::nullopt;
  }
  alone_.continue_from(motion);
  const FrameResult alone = alone_.locate(scan);
  const Pose apart = filter_->state().T_world_lidar().inverse() * alone.T_map_lidar;
  const bool is_elsewhere =
      apart.translation().norm() > kApart || so3_log(apart.linear()).norm() > kTurned;
  if (!is_elsewhere || !is_believed(alone.status) || !alone.unobserved.empty()) {
    return std::nullopt;
  }
  DeskewedScan alone_scan = alone_.scan();
  project_to_planes(alone_.estimated(), options_.max_plane_offset, alone_scan);
  const bool is_better =
      distance_from_map(alone_scan, alone.T_map_lidar) <
      kClearly * distance_from_map(prepared_.scan, filter_->state().T_world_lidar());
  return is_better ? std::optional<Pose>(alone.T_map_lidar) : std::nullopt;
}

// Of the points that the scans alone have matched, wherever a motion has placed them: of a scan
// that is deskewed badly the walls that tell it are thick, and no planes to its own matching.
double InertialPipeline::distance_from_map(
    const DeskewedScan& scan, const Pose& T_map_lidar) const {
  std::vector<Eigen::Vector3f> points, normals;
  pick(scan.points, alone_.keypoints(), points);
  pick(alone_.normals(), alone_.keypoints(), normals);
  return lio::distance_from_map(*map_, points, normals, T_map_lidar);
}

}  // namespace nvm::lio
