// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/lidar_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lio/match/degeneracy.hpp"
#include "lio/pipeline/pose_covariance.hpp"
#include "lio/pipeline/stage_timer.hpp"

namespace nvm::lio {

namespace {

/// Each makes the error of the motion within a sweep several times smaller; later ones no longer.
constexpr int kRefinements = 2;

bool is_sweep(const DeskewedScan& scan) {
  return std::any_of(scan.ages.begin(), scan.ages.end(), [](float age) { return age > 0.0F; });
}

}  // namespace

LidarOdometry::LidarOdometry(
    const LidarOdometryOptions& options, std::shared_ptr<LioMap> map, const Executor& executor)
    : LidarOdometry(
          options,
          std::move(map),
          std::make_shared<StartSearch>(options.search, executor),
          executor) {}

LidarOdometry::LidarOdometry(
    const LidarOdometryOptions& options,
    std::shared_ptr<LioMap> map,
    std::shared_ptr<StartSearch> search,
    const Executor& executor)
    : options_((options.validate(), options)),
      executor_(executor),
      normal_estimator_(options.normals),
      sampler_(options.keypoints),
      aligner_(options.align),
      search_(std::move(search)),
      map_(std::move(map)) {
  predicted_.T_body_lidar = options.T_body_lidar;
  predicted_.time = -std::numeric_limits<double>::infinity();
  if (map_->size() > 0) {
    search_->insert(*map_->voxel_map());
  }
}

void LidarOdometry::start_at(const Pose& T_map_body) {
  motion_.emplace(StampedPose{kLongAgo, T_map_body});
}

void LidarOdometry::continue_from(const ConstantVelocity& motion) {
  motion_ = motion;
  predicted_.time = motion.last().time;
  observed_time_ = motion.last().time;
}

FrameResult LidarOdometry::locate(const Scan& scan) {
  const double time = predicted_.time;
  const double observed_time = observed_time_;
  const FaintDirection faint = faint_;
  FrameResult result;
  result.time = scan.t_end;
  match(prepare(scan, result), result);
  predicted_.time = time;
  observed_time_ = observed_time;
  faint_ = faint;
  return result;
}

FrameResult LidarOdometry::process(const Scan& scan) {
  FrameResult result;
  result.time = scan.t_end;
  if (!is_usable(scan, result)) {
    return result;
  }
  follow(scan, result);
  const bool is_badly_begun = began_map_ && in_own_map_ <= 1;
  const bool sees_enough = result.keypoints >= options_.align.min_residuals;
  if (result.status == FrameStatus::kLost && is_badly_begun && sees_enough) {
    begin_map_again(motion_->last().pose);
    result.message = "";
    follow(scan, result);
    result.message = "the map begins again: its first scan fits none of the others";
  } else if (began_map_ && is_believed(result.status)) {
    settle_first(scan, result);
  }
  return result;
}

void LidarOdometry::follow(const Scan& scan, FrameResult& result) {
  const Normals& normals = prepare(scan, result);
  match(normals, result);
  insert(normals, result);
}

std::vector<std::string> LidarOdometry::findings() const {
  std::vector<std::string> findings;
  for (const std::string& line : {deskew_watch_.finding(), faint_.finding()}) {
    if (!line.empty()) {
      findings.push_back(line);
    }
  }
  return findings;
}

bool LidarOdometry::is_usable(const Scan& scan, FrameResult& result) const {
  if (scan.points.empty()) {
    result.message = "the scan is empty";
  } else if (!(scan.t_end > predicted_.time)) {
    result.message = "the scan is not newer than the last one";
  }
  if (!result.message.empty()) {
    result.status = FrameStatus::kSkipped;
  }
  return result.message.empty();
}

void LidarOdometry::predict(const Scan& scan) {
  const double horizon = options_.max_weak_duration;
  const ConstantVelocity motion =
      motion_.value_or(ConstantVelocity({scan.t_end, Pose::Identity()}));
  motion.sweep(scan.t_begin, scan.t_end, horizon, segments_);
  predicted_.time = scan.t_end;
  const MotionSegment end = motion.at(scan.t_end, horizon);
  predicted_.T_world_body = end.T_world_body;
  predicted_.velocity = end.velocity;
  predicted_.gyro_bias = -end.rate;  // as if a gyroscope had read zero
}

const LidarOdometry::Normals& LidarOdometry::prepare(const Scan& scan, FrameResult& result) {
  {
    const StageTimer timer(result.times.deskew);
    predict(scan);
    deskew(scan, segments_, predicted_, options_.returns, scan_);
  }
  const StageTimer timer(result.times.normals);
  result.points = scan_.size();
  estimated_ = &normal_estimator_.estimate(scan_.points, scan_.viewpoints, executor_);
  return estimated_->normals;
}

void LidarOdometry::match(const Normals& normals, FrameResult& result) {
  const StageTimer timer(result.times.optimize);
  choose_keypoints(normals);
  result.keypoints = key_points_.size();
  result.T_map_lidar = predicted_.T_world_lidar();
  if (map_->size() == 0) {
    const bool enough = key_points_.size() >= options_.align.min_residuals;
    observed_time_ = result.time;
    began_map_ = true;
    result.status = enough ? FrameStatus::kTracking : FrameStatus::kInitializing;
    result.message = enough ? "" : kTooFewSurfaces;
    return;
  }
  AlignResult aligned = align(normals);
  const int refinements = is_sweep(scan_) ? kRefinements : 0;
  for (int i = 0; i < refinements && is_believable(aligned); ++i) {
    aligned = refine(normals, aligned);
  }
  result.residuals = aligned.counts.valid;
  result.residual_rms = aligned.rms_distance;
  result.inlier_share = aligned.inlier_share();
  const double range = mean_range(key_points_);
  result.unobserved = unobserved_by(aligned, range, options_.T_body_lidar.linear());
  result.degenerate_directions = result.unobserved.count();
  result.iterations = aligned.iterations;
  if (is_believable(aligned)) {
    result.T_map_lidar = aligned.T_map_scan;
    result.pose_covariance = covariance_of(aligned, options_.T_body_lidar);
    faint_.add(aligned, range, options_.T_body_lidar.linear());
    watch_deskewing(aligned.T_map_scan);
    describe_directions(result);
    return;
  }
  const bool lost = result.time - motion_->last().time > options_.max_weak_duration;
  result.status = lost ? FrameStatus::kLost : FrameStatus::kWeak;
  result.message = kTooLittleFits;
}

// Where the scan does not tell it the motion goes on as before, which it does not do for long.
void LidarOdometry::describe_directions(FrameResult& result) {
  if (result.unobserved.empty()) {
    observed_time_ = result.time;
  }
  const bool is_adrift = result.time - observed_time_ > options_.max_weak_duration;
  result.status = is_adrift ? FrameStatus::kDegenerate : FrameStatus::kTracking;
  if (is_adrift) {
    result.message = "the scan does not tell the pose " + result.unobserved.text();
  }
}

void LidarOdometry::choose_keypoints(const Normals& normals) {
  keypoints_ = sampler_.sample(scan_.points, normals);
  pick(scan_.points, keypoints_, key_points_);
  pick(normals, keypoints_, key_normals_);
  pick(scan_.ages, keypoints_, key_ages_);
}

void LidarOdometry::watch_deskewing(const Pose& T_map_lidar) {
  const Eigen::Matrix3d R_body_map = predicted_.T_world_body.linear().transpose();
  deskew_watch_.add(
      *map_,
      {key_points_, key_normals_, key_ages_},
      T_map_lidar * options_.T_body_lidar.inverse(),
      options_.T_body_lidar,
      {R_body_map * predicted_.velocity, -predicted_.gyro_bias});
}

bool LidarOdometry::is_believable(const AlignResult& result) const {
  return result.inlier_share() >= options_.min_inlier_share &&
         result.status != AlignStatus::kTooFewResiduals;
}

// Deskews by the motion that an alignment has found instead of the one before, and aligns again.
AlignResult LidarOdometry::refine(const Normals& normals, const AlignResult& first) {
  ConstantVelocity found = *motion_;
  found.add({predicted_.time, first.T_map_scan * options_.T_body_lidar.inverse()});
  NavState corrected = predicted_;
  corrected.T_world_body = found.last().pose;
  corrected.velocity = found.velocity();
  corrected.gyro_bias = -found.rate();
  correct_deskew(predicted_, corrected, scan_);
  predicted_ = corrected;
  choose_keypoints(normals);
  return aligner_.align(*map_, key_points_, key_normals_, first.T_map_scan, executor_);
}

// From the prediction; when that does not convince, from coarse starts, first near ones.
AlignResult LidarOdometry::align(const Normals& normals) {
  AlignResult best;
  const auto convinced_by = [&](const std::vector<Pose>& starts) {
    for (const Pose& start : starts) {
      const AlignResult result = aligner_.align(*map_, key_points_, key_normals_, start, executor_);
      if (result.cost <= best.cost) {
        best = result;
      }
      if (convinces(result, start)) {
        return true;
      }
    }
    return false;
  };
  const Pose predicted = predicted_.T_world_lidar();
  const Pose standing_still = motion_->last().pose * options_.T_body_lidar;
  const std::vector<Pose> near = {predicted, standing_still};
  if (!convinced_by({predicted}) && !convinced_by(search_->search(scan_.points, normals, near))) {
    convinced_by(search_->search(scan_.points, normals, search_->turned(near)));
  }
  return best;
}

// An alignment that moves the points farther than they can be associated may have ended anywhere.
bool LidarOdometry::convinces(const AlignResult& result, const Pose& start) const {
  double sum_sq_motions = 0.0;
  for (const Eigen::Vector3f& point : key_points_) {
    const Eigen::Vector3d p_scan = point.cast<double>();
    sum_sq_motions += (result.T_map_scan * p_scan - start * p_scan).squaredNorm();
  }
  const double max_motion = options_.max_confident_motion;
  return result.inlier_share() >= options_.min_confident_share &&
         sum_sq_motions <= max_motion * max_motion * static_cast<double>(key_points_.size());
}

void LidarOdometry::insert(const Normals& normals, FrameResult& result) {
  const Pose T_map_body = result.T_map_lidar * options_.T_body_lidar.inverse();
  result.T_map_body = T_map_body;
  describe_prediction(predicted_, motion_ ? result.time - motion_->last().time : 0.0, result);
  if (!is_believed(result.status)) {
    return;
  }
  const StageTimer timer(result.times.map_update);
  const StampedPose pose{result.time, T_map_body};
  if (!motion_) {
    motion_.emplace(pose);
  } else if (pose.time > motion_->last().time) {
    motion_->add(pose);
  }
  result.velocity = motion_->velocity();
  result.angular_rate = motion_->rate();
  ++in_own_map_;
  if (map_->is_frozen()) {
    return;
  }
  result.inserted = map_->insert(scan_.points, normals, scan_.values, result.T_map_lidar);
  search_->insert(scan_.points, normals, result.T_map_lidar);
}

}  // namespace nvm::lio
