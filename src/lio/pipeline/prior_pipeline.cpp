// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/prior_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "common/printed.hpp"
#include "lio/map/has_planes.hpp"
#include "lio/place/scan_witness.hpp"

namespace nvm::lio {

namespace {

std::unique_ptr<LioMap> usable(const PipelineOptions& options, VoxelMap prior, bool extends) {
  if (options.map_type != MapType::kNvm) {
    throw std::invalid_argument("a prior map needs map.type=nvm");
  }
  if (!has_planes(prior)) {
    throw std::invalid_argument(
        prior.empty() ? "the prior map has no points"
                      : "the points of the prior map have no normals: make it with map.type=nvm");
  }
  return continued_map(std::move(prior), !extends);
}

/// The share of the lines of sight of a scan at `T_map_scan` that pass faces of `map`.
double share_against(const ScanWitness& witness, const VoxelMap& map, const Pose& T_map_scan) {
  const Testimonies testimonies = witness.testify(map, T_map_scan);
  return static_cast<double>(count(testimonies, Testimony::kAgainst)) /
         static_cast<double>(std::max<std::size_t>(1, testimonies.size()));
}

std::string found_again(double silence) {
  std::ostringstream text;
  text << "found again in the prior map " << std::fixed << std::setprecision(1) << silence
       << " s after the pose was lost";
  return text.str();
}

}  // namespace

PriorPipeline::PriorPipeline(
    const PipelineOptions& options, VoxelMap prior, const std::optional<Start>& start, bool extends)
    : start_(start),
      returns_(options.inertial.returns),
      executor_(options.threads),
      normal_estimator_(options.inertial.normals),
      pipeline_(make_pipeline(options, usable(options, std::move(prior), extends))),
      search_(std::in_place, *pipeline_->map().voxel_map(), executor_) {
  body_.T_body_lidar = options.inertial.T_imu_lidar;
}

void PriorPipeline::add_imu(const ImuSample& sample) {
  constexpr double kMemory = 0.5;  // [s]
  watch_.note_reading(sample.time);
  if (sample.accel.allFinite()) {
    const double age = force_ ? sample.time - force_time_ : 0.0;
    const double weight = force_ ? -std::expm1(-std::max(age, 0.0) / kMemory) : 1.0;
    force_ = (1.0 - weight) * force_.value_or(sample.accel) + weight * sample.accel;
    force_time_ = sample.time;
  }
  pipeline_->add_imu(sample);
}

FrameResult PriorPipeline::process(const Scan& scan) {
  watch_.note_scan(scan.t_end);
  if (is_placed_ && watch_.is_overdue(scan.t_end)) {
    lose(scan.t_end);
  }
  if (!is_placed_) {
    return search(scan);
  }
  FrameResult result = pipeline_->process(scan);
  if (is_believed(result.status) && is_doubtful(result)) {
    result.status = FrameStatus::kLost;
    result.message = "the scan fits elsewhere than it can have been made, or through walls";
  }
  if (is_believed(result.status)) {
    believe(result);
  } else if (result.status == FrameStatus::kLost) {
    lose(scan.t_end);
  }
  was_believed_ = is_believed(result.status);
  return result;
}

void PriorPipeline::believe(const FrameResult& result) {
  constexpr double kLately = 0.1;
  watch_.note_pose(result.time, result.imu_noise.gyro > 0.0);
  last_pose_ = result.T_map_body;
  usual_share_ += (was_believed_ ? kLately : 1.0) * (result.inlier_share - usual_share_);
  last_speed_ = result.velocity.norm();
}

// Half of a scan fits somewhere in most rooms. Of a sensor that was carried away tell how far it
// would have come and, where it fits worse than before, the lines of sight.
bool PriorPipeline::is_doubtful(const FrameResult& result) const {
  constexpr double kReach = 0.5;         // [m]
  constexpr double kSpeed = 3.0;         // [m/s]
  constexpr double kDrop = 0.2;          // of the share that fits
  constexpr double kMostAgainst = 0.02;  // of the lines of sight: furniture may have been moved
  const double reach = kReach + (kSpeed + 2.0 * last_speed_) * watch_.silence(result.time);
  if ((result.T_map_body.translation() - last_pose_->translation()).norm() > reach) {
    return true;
  }
  const bool is_worse = !was_believed_ || result.inlier_share < usual_share_ - kDrop;
  return is_worse && contradiction(result.T_map_lidar) > kMostAgainst;
}

double PriorPipeline::contradiction(const Pose& T_map_lidar) const {
  return share_against(
      ScanWitness(pipeline_->scan().points, pipeline_->normals()),
      *pipeline_->map().voxel_map(),
      T_map_lidar);
}

FrameResult PriorPipeline::search(const Scan& scan) {
  FrameResult result;
  result.time = scan.t_end;
  result.status = last_pose_ ? FrameStatus::kLost : FrameStatus::kInitializing;
  if (!is_to_search(scan.t_end)) {
    result.message = "not found in the prior map yet";
    return result;
  }
  const Place place = find(scan);
  if (!place.is_found()) {
    result.message = "not found in the prior map: " + place.why_not;
    return result;
  }
  const std::optional<Start> start = start_;
  const Pose T_map_body = place.T_map_scan * body_.T_body_lidar.inverse();
  start_ = Start{T_map_body, false};
  pipeline_->start_at(T_map_body);
  const FrameStatus searching = result.status;
  result = pipeline_->process(scan);
  is_placed_ = is_believed(result.status);
  if (is_placed_) {
    result.message = watch_.is_lost() ? found_again(watch_.silence(result.time)) : result.message;
    believe(result);
    was_believed_ = true;
  } else if (result.status == FrameStatus::kLost) {  // a place that the pipeline does not confirm
    result.status = searching;
    start_ = start;
  }
  return result;
}

// A map that grows has places by now that it had not when it was loaded.
void PriorPipeline::lose(double time) {
  watch_.lose();
  is_placed_ = false;
  start_.reset();
  first_try_ = time;
  next_try_ = time;
  if (!pipeline_->map().is_frozen()) {
    search_.emplace(*pipeline_->map().voxel_map(), executor_);
  }
}

// A search of the whole map takes the time of many scans, and the next scan shows about the same:
// the longer it fails the rarer it is.
bool PriorPipeline::is_to_search(double time) {
  constexpr double kPause = 0.25;    // [s]
  constexpr double kPatience = 0.1;  // of the time since the first try
  first_try_ = first_try_.value_or(time);
  if (time < next_try_) {
    return false;
  }
  next_try_ = time + kPause + kPatience * (time - *first_try_);
  return true;
}

Place PriorPipeline::find(const Scan& scan) {
  deskew(scan, {{scan.t_end, Pose::Identity()}}, body_, returns_, scan_);
  const std::vector<Eigen::Vector3f>& normals =
      normal_estimator_.estimate(scan_.points, scan_.viewpoints, executor_).normals;
  const Eigen::Vector3d up = (level() * body_.T_body_lidar.linear()).row(2);
  if (start_) {
    return find_near_start(normals, up);
  }
  std::optional<Pose> likely;
  if (last_pose_) {
    likely = *last_pose_ * body_.T_body_lidar;
  }
  return search_->anywhere(scan_.points, normals, up, likely);
}

// A start may be wrong, as by half a turn or a room: most of a scan fits there too, and its lines
// of sight pass walls. Then, and where less fits, the whole map is searched.
Place PriorPipeline::find_near_start(
    const std::vector<Eigen::Vector3f>& normals, const Eigen::Vector3d& up) {
  constexpr double kMostly = 0.75;    // of the scan, that fits
  constexpr double kDoubtful = 0.01;  // of the lines of sight, against it
  constexpr double kMost = 0.03;      // who gives a start may know of furniture that was moved
  constexpr double kFar = 1.5;        // [m]
  constexpr double kTurned = 0.5;     // [rad]
  constexpr double kDegrees = 57.29577951308232;
  const Pose given = guess() * body_.T_body_lidar;
  Place near = search_->near(scan_.points, normals, given);
  if (near.is_found()) {
    const double against = share_against(
        ScanWitness(scan_.points, normals), *pipeline_->map().voxel_map(), near.T_map_scan);
    if (against <= kDoubtful && near.share >= kMostly) {
      return near;
    }
    start_finding_ = printed(
        "at the start that was given %.0f %% of the scan fit the map, and %.1f %% of its lines of "
        "sight pass walls or furniture: unless much was moved, the start is wrong",
        100.0 * near.share,
        100.0 * against);
    near.why_not = against > kMost ? start_finding_ : "";
  }
  Place elsewhere = search_->anywhere(scan_.points, normals, up);
  if (!elsewhere.is_found()) {
    return near;
  }
  const Pose apart = given.inverse() * elsewhere.T_map_scan;
  const double distance = apart.translation().norm();
  const double turn = so3_log(apart.linear()).norm();
  start_finding_.clear();
  if (distance > kFar || turn > kTurned) {
    start_finding_ = printed(
        "the start that was given is wrong: the first scan fits the map %.1f m and %.0f degrees "
        "away from it, and not there",
        distance,
        kDegrees * turn);
  }
  return elsewhere;
}

// At rest the specific force points up. The heading is kept: that of the body's x axis.
Eigen::Matrix3d PriorPipeline::level() const {
  constexpr double kSteep = 0.1;
  if (!force_) {
    return last_pose_.value_or(Pose::Identity()).linear();
  }
  const Eigen::Matrix3d level =
      Eigen::Quaterniond::FromTwoVectors(*force_, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d ahead = level.col(0);
  const bool has_heading = ahead.head<2>().norm() > kSteep;
  const double heading = has_heading ? std::atan2(ahead.y(), ahead.x()) : 0.0;
  return so3_exp({0.0, 0.0, -heading}) * level;
}

Pose PriorPipeline::guess() const {
  Pose guess = start_->T_map_body;
  if (start_->is_upright) {
    guess.linear() *= level();
  }
  return guess;
}

std::vector<std::string> PriorPipeline::findings() const {
  std::vector<std::string> findings = pipeline_->findings();
  if (!start_finding_.empty()) {
    findings.push_back(start_finding_);
  }
  const std::string loss = watch_.finding();
  if (!loss.empty()) {
    findings.push_back(loss);
  }
  return findings;
}

}  // namespace nvm::lio
