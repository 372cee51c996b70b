// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/motion_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace nvm::lio {

namespace {

/// Unknowns: p0, v0, g, of three each, and s.
constexpr int kMotionUnknowns = 10;
using Matrix = Eigen::Matrix<double, kMotionUnknowns, kMotionUnknowns>;
using Vector = Eigen::Matrix<double, kMotionUnknowns, 1>;
using Rows = Eigen::Matrix<double, 3, kMotionUnknowns>;

/// The specific force in the map frame, integrated once and twice since the first pose.
struct ForceSums {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();

  void advance(double duration, const Eigen::Vector3d& force) {
    position += duration * velocity + 0.5 * duration * duration * force;
    velocity += duration * force;
  }
};

/// At each of `poses`. Each reading holds from half-way to the one before until half-way to the
/// next.
std::vector<ForceSums> integrate(const Trajectory& poses, const std::vector<ImuSample>& readings) {
  std::vector<ForceSums> result;
  ForceSums sums;
  double time = poses.front().time;
  std::size_t current = 0;
  for (const StampedPose& pose : poses) {
    while (time < pose.time) {
      const bool is_last = current + 1 == readings.size();
      const double change =
          is_last ? pose.time : 0.5 * (readings[current].time + readings[current + 1].time);
      const double until = std::min(pose.time, std::max(change, time));
      const Pose T_map_body = *pose_at(poses, 0.5 * (time + until));
      sums.advance(until - time, T_map_body.linear() * readings[current].accel);
      time = until;
      current += !is_last && change <= time ? 1 : 0;
    }
    result.push_back(sums);
  }
  return result;
}

bool is_covered(const Trajectory& poses, const std::vector<ImuSample>& readings) {
  constexpr double kMaxGap = 0.12;  // [s]
  double time = poses.front().time;
  for (const ImuSample& reading : readings) {
    if (reading.time - time > kMaxGap) {
      return false;
    }
    time = reading.time;
  }
  return poses.back().time - time <= kMaxGap;
}

Rows rows_at(double time, const ForceSums& sums) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  Rows rows;
  rows << I, time * I, 0.5 * time * time * I, sums.position;
  return rows;
}

/// What the gyroscope turns more than the scans do [rad/s], since `begin` [s].
Eigen::Vector3d excess_rate(const MotionHistory& history, double begin) {
  Eigen::Vector3d excess = Eigen::Vector3d::Zero();
  double duration = 0.0;
  for (const MotionHistory::Turn& turn : history.turns()) {
    const auto from = history.turned_at(turn.begin);
    const auto to = history.turned_at(turn.end);
    if (from && to && turn.begin >= begin) {
      excess += *to - *from - turn.by_scans;
      duration += turn.end - turn.begin;
    }
  }
  return duration > 0.0 ? Eigen::Vector3d(excess / duration) : excess;
}

}  // namespace

std::optional<MotionFit> fit_motion(
    const MotionHistory& history,
    double duration,
    double assumed_scale,
    const Eigen::Vector3d& accel_bias) {
  constexpr std::size_t kMinCount = 8;
  constexpr double kFirm = 1e9;
  constexpr double kPoseDeviation = 0.003;  // at least [m]
  const Trajectory poses = history.poses(duration);
  if (poses.size() < kMinCount) {
    return std::nullopt;
  }
  const double begin = poses.front().time;
  const double end = poses.back().time;
  std::vector<ImuSample> readings = history.readings(begin, end);
  for (ImuSample& reading : readings) {
    reading.accel -= accel_bias;
  }
  if (readings.empty() || !is_covered(poses, readings)) {
    return std::nullopt;
  }
  const std::vector<ForceSums> sums = integrate(poses, readings);
  const Eigen::Vector3d origin = poses.front().pose.translation();
  Matrix information = Matrix::Zero();
  Vector vector = Vector::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Rows rows = rows_at(poses[i].time - begin, sums[i]);
    information += rows.transpose() * rows;
    vector += rows.transpose() * (poses[i].pose.translation() - origin);
  }
  if (assumed_scale != 0.0) {
    information(9, 9) += kFirm;
    vector[9] += kFirm * assumed_scale;
  }
  const Eigen::LDLT<Matrix> solver(information);
  const Vector x = solver.solve(vector);
  if (!x.allFinite()) {
    return std::nullopt;
  }
  double sq_sum = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d fitted = rows_at(poses[i].time - begin, sums[i]) * x;
    sq_sum += (fitted + origin - poses[i].pose.translation()).squaredNorm();
  }
  MotionFit fit;
  fit.gravity = x.segment<3>(6);
  fit.accel_scale = x[9];
  fit.gyro_bias = excess_rate(history, begin);
  fit.velocity = x.segment<3>(3) + (end - begin) * fit.gravity + x[9] * sums.back().velocity;
  fit.position_rms = std::sqrt(sq_sum / static_cast<double>(poses.size()));
  fit.accel_scale_deviation = std::hypot(fit.position_rms, kPoseDeviation) *
                              std::sqrt(std::max(0.0, solver.solve(Vector::Unit(9))[9]));
  return fit;
}

}  // namespace nvm::lio
