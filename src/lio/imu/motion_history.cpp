// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/motion_history.hpp"

#include <algorithm>

namespace nvm::lio {

namespace {

constexpr double kLength = 15.0;  // [s]

}  // namespace

void MotionHistory::add(const ImuSample& reading) {
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();
  if (!readings_.empty()) {
    const Reading& last = readings_.back();
    const double duration = reading.time - last.sample.time;
    if (!(duration > 0.0)) {
      return;
    }
    turned = last.turned + 0.5 * duration * (last.sample.gyro + reading.gyro);
  }
  readings_.push_back({reading, turned});
  while (readings_.front().sample.time < reading.time - kLength) {
    readings_.pop_front();
  }
}

void MotionHistory::add(const StampedPose& T_map_body) {
  if (!poses_.empty() && !(T_map_body.time > poses_.back().time)) {
    return;
  }
  poses_.push_back(T_map_body);
  while (poses_.front().time < T_map_body.time - kLength) {
    poses_.pop_front();
  }
}

void MotionHistory::move_readings(double by) {
  for (Reading& reading : readings_) {
    reading.sample.time += by;
  }
}

void MotionHistory::turn_readings(const Eigen::Matrix3d& rotation) {
  for (Reading& reading : readings_) {
    reading.sample.gyro = (rotation * reading.sample.gyro).eval();
    reading.sample.accel = (rotation * reading.sample.accel).eval();
    reading.turned = (rotation * reading.turned).eval();
  }
}

double MotionHistory::duration() const {
  return poses_.empty() ? 0.0 : poses_.back().time - poses_.front().time;
}

Trajectory MotionHistory::poses(double duration) const {
  const auto first = std::find_if(poses_.begin(), poses_.end(), [&](const StampedPose& pose) {
    return pose.time >= poses_.back().time - duration - 1e-6;
  });
  return {first, poses_.end()};
}

std::vector<ImuSample> MotionHistory::readings(double begin, double end) const {
  std::vector<ImuSample> readings;
  for (const Reading& reading : readings_) {
    if (reading.sample.time >= begin && reading.sample.time <= end) {
      readings.push_back(reading.sample);
    }
  }
  return readings;
}

std::vector<MotionHistory::Turn> MotionHistory::turns() const {
  constexpr double kMaxDuration = 0.6;  // [s]
  std::vector<Turn> turns;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const StampedPose& begin = poses_[i - 1];
    const StampedPose& end = poses_[i];
    if (end.time - begin.time <= kMaxDuration) {
      const Eigen::Matrix3d turn = begin.pose.linear().transpose() * end.pose.linear();
      turns.push_back({begin.time, end.time, so3_log(turn)});
    }
  }
  return turns;
}

std::optional<Eigen::Vector3d> MotionHistory::turned_at(double time) const {
  const auto next = std::lower_bound(
      readings_.begin(), readings_.end(), time, [](const Reading& reading, double t) {
        return reading.sample.time < t;
      });
  if (next == readings_.end() || next == readings_.begin()) {
    return std::nullopt;
  }
  const Reading& previous = *(next - 1);
  const double share = (time - previous.sample.time) / (next->sample.time - previous.sample.time);
  return (1.0 - share) * previous.turned + share * next->turned;
}

}  // namespace nvm::lio
