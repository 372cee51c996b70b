// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/inertial_pipeline.hpp"

#include <algorithm>
#include <cmath>

#include "lio/match/aligned_matcher.hpp"
#include "lio/pipeline/pose_covariance.hpp"
#include "lio/pipeline/stage_timer.hpp"

namespace nvm::lio {

namespace {

/// A prediction less sure than this is looked for on a coarse map first [m].
constexpr double kMaxDoubt = 0.15;

constexpr PoseObservation kFoundAgain{0.2, 0.05};

// So long may scans leave a direction open before the pose counts as adrift [s]. Errors of the
// map's planes do not average out: an attitude that is wrong by 2 mrad, which the covariance does
// not know, accelerates the body by 0.02 m/s^2 and moves it by kMaxDoubt in that time.
constexpr double kMaxBlind = 4.0;

/// Whether a match that began far off is beyond doubt: most of the scan is in the map, and near it.
bool fits_well(const MatchResult& match, std::size_t keypoints) {
  constexpr double kMaxRms = 0.05;  // [m]
  return 2 * match.residuals >= keypoints && match.residual_rms <= kMaxRms;
}

}  // namespace

InertialPipeline::InertialPipeline(
    const InertialOptions& options,
    std::unique_ptr<ScanMatcher> matcher,
    const LidarOdometryOptions& alone,
    std::shared_ptr<LioMap> map,
    const Executor& executor)
    : options_((options.validate(), options)),
      executor_(executor),
      initializer_(options.initializer),
      preparer_(options.normals, options.max_plane_offset, options.keypoints, executor),
      judge_(options.imu_input, options.T_imu_lidar, options.initializer.gravity),
      search_(std::make_shared<StartSearch>(alone.search, executor)),
      map_(std::move(map)),
      alone_(alone, map_, search_, executor),
      matcher_(std::move(matcher)),
      min_first_keypoints_(alone.align.min_residuals),
      imu_time_offset_(options.imu_input.time_offset) {}

void InertialPipeline::add_imu(const ImuSample& sample) {
  ImuSample shifted = sample;
  shifted.time += imu_time_offset_;
  imu_.add(shifted);
}

FrameResult InertialPipeline::process(const Scan& scan) {
  FrameResult result;
  result.time = scan.t_end;
  read_imu(scan.t_end);
  if (!is_alone_ && !filter_ && !initialize(result)) {
    if (!is_to_go_alone(scan.t_end)) {
      return result;
    }
    Pose levelled = Pose::Identity();
    levelled.linear() = initializer_.level();
    go_alone(ConstantVelocity({scan.t_begin, start_.value_or(levelled)}));
  }
  if (is_alone_) {
    return process_alone(scan);
  }
  if (scan.points.empty() || scan.t_end < filter_->state().time) {
    result.status = FrameStatus::kSkipped;
    result.message =
        scan.points.empty() ? "the scan is empty" : "the scan is older than the last one";
    return result;
  }
  is_scan_alone_ = false;
  if (hangs(scan)) {
    result.status = FrameStatus::kSkipped;
    result.message = "the LiDAR hangs: it sends the points of the scan before while the IMU moves";
    return result;
  }
  prepare(scan, result);
  if (!is_rigid(filter_->state().T_world_body)) {  // no reading may end a run
    go_alone(motion_);
    return process_alone(scan);
  }
  const ConstantVelocity motion = motion_;
  match(result);
  const std::optional<Pose> elsewhere = led_astray_from(scan, motion, result);
  if (is_leap(elsewhere.value_or(filter_->state().T_world_lidar()))) {
    *filter_ = *sure_prediction_;
    motion_ = motion;
    result.status = FrameStatus::kWeak;
    result.message = "the scan lies where nothing can have moved it";
  } else if (elsewhere) {
    leave_imu(motion);
    return process_alone(scan);
  }
  insert(result);
  result.T_map_body = filter_->state().T_world_body;
  result.T_map_lidar = filter_->state().T_world_lidar();
  describe_motion(*filter_, samples_.empty() ? nullptr : &samples_.back(), result);
  result.imu_noise = imu_noise_;
  result.imu_time_offset = imu_time_offset_;
  judge_imu(result);
  return result;
}

double InertialPipeline::max_imu_gap() const {
  constexpr double kShortest = 0.05;  // [s]
  constexpr double kIntervals = 4.0;
  return options_.max_imu_gap > 0.0 ? options_.max_imu_gap
                                    : std::max(kShortest, kIntervals * imu_.interval());
}

void InertialPipeline::predict(double until) {
  const double begin = filter_->state().time;
  const double max_gap = max_imu_gap();
  take_readings(until, max_gap);
  segments_.clear();
  for (const ImuSample& next : samples_) {
    const double time = filter_->state().time;
    if (next.time <= time) {
      continue;
    }
    const ImuSample* previous = &next == samples_.data() ? nullptr : &next - 1;
    const bool bridged = previous && next.time - previous->time <= max_gap &&
                         !imu_.is_doubtful(previous->time, next.time);
    if (bridged) {
      segments_.push_back(filter_->predict(*previous, next));
    } else {
      coast(next.time);
    }
  }
  if (filter_->state().time < until) {
    coast(until);
  } else if (!samples_.empty()) {
    use_rest();
  }
  if (segments_.empty()) {  // a scan that ends where the last one did
    segments_.push_back({begin, filter_->state().T_world_body, filter_->state().velocity});
  }
  imu_.use_until(until);
}

void InertialPipeline::coast(double until) {
  constexpr double kLongestTurn = 0.3;  // a hand's turn does not last longer [s]
  const bool turns = until - motion_.last().time <= kLongestTurn;
  segments_.push_back(
      filter_->coast(until, turns ? motion_.rate() : Eigen::Vector3d(Eigen::Vector3d::Zero())));
}

// A smooth ride looks like rest to the IMU. Where the scans do not tell the speed, as along a wall
// that fills the view, the estimate may be slow and wrong.
void InertialPipeline::use_rest() {
  constexpr double kSlow = 0.05;   // [m/s]
  constexpr double kDoubts = 3.0;  // standard deviations
  const Stillness stillness = judge_stillness(samples_, options_.initializer);
  const double speed_deviation =
      std::sqrt(filter_->covariance().block<3, 3>(kVelocity, kVelocity).trace());
  if (stillness.still && filter_->state().velocity.norm() + kDoubts * speed_deviation < kSlow) {
    filter_->observe_rest(stillness.mean_gyro);
    placed_time_ = filter_->state().time;
  }
}

void InertialPipeline::believe() {
  const StampedPose now{filter_->state().time, filter_->state().T_world_body};
  if (now.time > motion_.last().time) {
    motion_.add(now);
  }
  believed_doubt_ = pose_doubt(*filter_).translation_deviation;
}

void InertialPipeline::prepare(const Scan& scan, FrameResult& result) {
  {
    const StageTimer timer(result.times.deskew);
    predict(scan.t_end);
    deskew(scan, segments_, filter_->state(), options_.returns, prepared_.scan);
  }
  const StageTimer timer(result.times.normals);
  preparer_.prepare(prepared_);
}

void InertialPipeline::match(FrameResult& result) {
  const StageTimer timer(result.times.optimize);
  pick(prepared_.scan.points, prepared_.keypoints, key_points_);
  pick(prepared_.normals, prepared_.keypoints, key_normals_);
  pick(prepared_.scan.ages, prepared_.keypoints, key_ages_);
  result.points = prepared_.scan.size();
  result.keypoints = prepared_.keypoints.size();
  if (map_->size() == 0) {
    begin_map(result);
    return;
  }
  const ErrorStateFilter predicted = *filter_;
  const bool was_sure = is_sure();
  sure_prediction_.reset();
  if (!was_sure) {
    find_again();
  } else if (has_readings()) {
    sure_prediction_ = predicted;
  }
  const MatchResult match = matcher_->match(*map_, prepared_, *filter_);
  predictions_.add(predicted, *filter_, match.inlier_share, imu_.interval());
  result.residuals = match.residuals;
  result.residual_rms = match.residual_rms;
  result.inlier_share = match.inlier_share;
  result.unobserved = match.unobserved;
  result.degenerate_directions = match.unobserved.count();
  result.iterations = match.iterations;
  if (match.accepted && (was_sure ? agrees_with_map(match) : fits_well(match, result.keypoints))) {
    believe();
    watch_deskewing();
    result.status = FrameStatus::kTracking;
    if (!placed_time_ || result.unobserved.translations.empty()) {
      placed_time_ = result.time;
    }
    if (is_adrift(result.unobserved) || result.time - *placed_time_ > kMaxBlind) {
      result.status = FrameStatus::kDegenerate;
      result.message = "the scan does not tell the pose " + result.unobserved.text();
    }
    return;
  }
  *filter_ = predicted;
  const bool lost = result.time - motion_.last().time > options_.max_weak_duration;
  result.status = lost ? FrameStatus::kLost : FrameStatus::kWeak;
  result.message = kTooLittleFits;
}

void InertialPipeline::watch_deskewing() {
  const NavState& state = filter_->state();
  pick(prepared_.scan.points, prepared_.keypoints, key_points_);  // where the match has moved them
  alone_.deskew_watch().add(
      *map_,
      {key_points_, key_normals_, key_ages_},
      state.T_world_body,
      state.T_body_lidar,
      {state.T_world_body.linear().transpose() * motion_.velocity(), motion_.rate()});
}

// Every later pose will be one in this scan's surfaces.
void InertialPipeline::begin_map(FrameResult& result) {
  if (result.keypoints < min_first_keypoints_) {
    result.message = kTooFewSurfaces;
    return;
  }
  believe();
  result.status = FrameStatus::kTracking;
}

// What corridors leave open grows with the way, and no search in the map would close it.
bool InertialPipeline::is_sure() const {
  const double now = pose_doubt(*filter_).translation_deviation;
  return now * now - believed_doubt_ * believed_doubt_ < kMaxDoubt * kMaxDoubt;
}

bool InertialPipeline::is_adrift(const UnobservedDirections& unobserved) const {
  constexpr double kMaxTurnDoubt = 0.05;  // [rad]
  const NavCovariance& P = filter_->covariance();
  const auto is_open = [&](NavIndex part, const Eigen::Vector3d& direction, double limit) {
    return direction.dot(P.block<3, 3>(part, part) * direction) > limit * limit;
  };
  const auto& [translations, rotations] = unobserved;
  return std::any_of(
             translations.begin(),
             translations.end(),
             [&](const auto& direction) { return is_open(kPosition, direction, kMaxDoubt); }) ||
         std::any_of(rotations.begin(), rotations.end(), [&](const auto& axis) {
           return is_open(kRotation, axis, kMaxTurnDoubt);
         });
}

// The map's voxels reach no farther than their size, a coarse map's do.
void InertialPipeline::find_again() {
  const NavState predicted = filter_->state();
  const std::vector<Pose> guesses = {
      predicted.T_world_lidar(), motion_.last().pose * predicted.T_body_lidar};
  const std::vector<Pose> found = search_->search(key_points_, key_normals_, guesses);
  observe_lidar_pose(found.front(), kFoundAgain, *filter_);
  correct_deskew(predicted, filter_->state(), prepared_.scan);
}

void InertialPipeline::insert(FrameResult& result) {
  if (!is_believed(result.status) || map_->is_frozen()) {
    return;
  }
  const StageTimer timer(result.times.map_update);
  const Pose T_map_lidar = filter_->state().T_world_lidar();
  result.inserted = preparer_.insert(T_map_lidar, prepared_, *map_);
  search_->insert(key_points_, key_normals_, T_map_lidar);
}

}  // namespace nvm::lio
