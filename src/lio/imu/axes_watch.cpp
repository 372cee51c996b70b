// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/axes_watch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nvm::lio {

namespace {

constexpr double kStretch = 0.95;  // [s]

using Stretch = AxesWatch::Stretch;

/// Nothing where the turns from `at` on leave a gap or end too soon.
std::optional<Stretch> stretch_at(
    const MotionHistory& history, const std::vector<MotionHistory::Turn>& turns, std::size_t at) {
  Eigen::Matrix3d by_scans = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d by_gyro = Eigen::Matrix3d::Identity();
  for (std::size_t i = at; i < turns.size(); ++i) {
    const auto begin = history.turned_at(turns[i].begin);
    const auto end = history.turned_at(turns[i].end);
    if (!begin || !end || (i > at && turns[i].begin != turns[i - 1].end)) {
      return std::nullopt;
    }
    by_scans *= so3_exp(turns[i].by_scans);
    by_gyro *= so3_exp(*end - *begin);
    if (turns[i].end - turns[at].begin >= kStretch) {
      return Stretch{
          turns[at].begin, turns[i].end, so3_log(by_scans), so3_log(by_gyro), i + 1 - at};
    }
  }
  return std::nullopt;
}

/// The gyroscope's rate at `time` [rad/s].
std::optional<Eigen::Vector3d> rate_at(const MotionHistory& history, double time) {
  constexpr double kStep = 0.02;  // [s]
  const auto before = history.turned_at(time - kStep);
  const auto after = history.turned_at(time + kStep);
  return before && after ? std::optional<Eigen::Vector3d>((*after - *before) / (2.0 * kStep))
                         : std::nullopt;
}

/// Turns that differ by more are of a scan that was matched badly.
bool belong_together(const Stretch& stretch) {
  constexpr double kSlack = 0.02;  // [rad]
  constexpr double kShare = 0.3;   // what 17 degrees between the axes make of a turn
  return (stretch.by_scans - stretch.by_gyro).norm() <= kSlack + kShare * stretch.by_gyro.norm();
}

}  // namespace

void AxesWatch::look(const MotionHistory& history, double begin, double mended) {
  const std::vector<MotionHistory::Turn> turns = history.turns();
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto stretch = stretch_at(history, turns, i);
    if (stretch && stretch->end > begin && belong_together(*stretch)) {
      add(history, *stretch, mended);
    }
  }
}

void AxesWatch::add(const MotionHistory& history, const Stretch& stretch, double mended) {
  const auto rate_before = rate_at(history, stretch.begin);
  const auto rate_after = rate_at(history, stretch.end);
  if (!rate_before || !rate_after) {
    return;
  }
  Eigen::Matrix<double, 3, kSize> H;
  H.middleCols<3>(0) = -skew(stretch.by_gyro);
  H.middleCols<3>(3) = (stretch.end - stretch.begin) * Eigen::Matrix3d::Identity();
  H.col(6) = *rate_after - *rate_before;
  H.col(7) = stretch.by_gyro;
  const double share = 1.0 / static_cast<double>(stretch.turns);
  const Eigen::Vector3d difference = stretch.by_scans - stretch.by_gyro + mended * H.col(6);
  information_ += share * H.transpose() * H;
  vector_ += share * H.transpose() * difference;
  sq_difference_ += share * difference.squaredNorm();
  weight_ += share;
}

/// What is left of the difference of both turns [rad^2] once all from the `first` on are learned.
double AxesWatch::difference_left(int first, const Matrix& prior) const {
  const int size = kSize - first;
  const Eigen::VectorXd tail = vector_.tail(size);
  const Eigen::MatrixXd information = (information_ + prior).bottomRightCorner(size, size);
  return std::max(0.0, sq_difference_ - tail.dot(information.ldlt().solve(tail)));
}

/// What the motion does not tell stays near zero.
AxesWatch::Matrix AxesWatch::prior_information() {
  Vector deviations;
  deviations << Eigen::Vector3d::Constant(0.3), Eigen::Vector3d::Constant(0.1), 0.05, 0.05;
  return deviations.cwiseAbs2().cwiseInverse().asDiagonal();
}

std::optional<AxesWatch::Finding> AxesWatch::finding() const {
  constexpr double kLeast = 0.0175;  // [rad]
  constexpr double kDeviations = 6.0;
  constexpr double kMinWeight = 6.0;    // of stretches
  constexpr double kMostLeft = 0.3;     // of the difference: what else is wrong leaves more
  constexpr double kLeastNoise = 2e-4;  // of poses [rad]
  if (weight_ < kMinWeight) {
    return std::nullopt;
  }
  const Matrix prior = prior_information();
  const double left = difference_left(0, 1e-6 * prior);
  if (left > kMostLeft * difference_left(kRotation, 1e-6 * prior)) {
    return std::nullopt;
  }
  const double variance =
      std::max(kLeastNoise * kLeastNoise, left / (3.0 * weight_ - static_cast<double>(kSize)));
  const Matrix covariance = (information_ / variance + prior).inverse();
  const Vector learned = covariance * vector_ / variance;
  const Eigen::Vector3d turn = learned.head<3>();
  const Eigen::Matrix3d unsure = covariance.topLeftCorner<3, 3>();
  const double surprise = turn.dot(unsure.inverse() * turn);
  if (turn.norm() < kLeast || surprise < kDeviations * kDeviations) {
    return std::nullopt;
  }
  return Finding{so3_exp(turn), learned[6]};
}

}  // namespace nvm::lio
