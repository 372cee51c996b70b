// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/turn_comparison.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nvm::lio {

namespace {

struct Pair {
  Eigen::Vector3d by_scans, by_gyro;
  double duration;  // [s]
};
using Pairs = std::vector<Pair>;

Pairs pairs_at(
    const MotionHistory& history, const std::vector<MotionHistory::Turn>& turns, double offset) {
  Pairs pairs;
  constexpr double kMinRate = 0.1;  // slower ones are mostly noise [rad/s]
  for (const MotionHistory::Turn& turn : turns) {
    if (turn.by_scans.norm() < kMinRate * (turn.end - turn.begin)) {
      continue;
    }
    const auto begin = history.turned_at(turn.begin + offset);
    const auto end = history.turned_at(turn.end + offset);
    if (begin && end) {
      pairs.push_back({turn.by_scans, *end - *begin, turn.end - turn.begin});
    }
  }
  return pairs;
}

/// 1 minus the squared correlation of how much both turn.
double difference_of_amounts(const Pairs& pairs) {
  double scans = 0.0;
  double gyro = 0.0;
  double both = 0.0;
  for (const Pair& pair : pairs) {
    scans += pair.by_scans.squaredNorm();
    gyro += pair.by_gyro.squaredNorm();
    both += pair.by_scans.norm() * pair.by_gyro.norm();
  }
  return scans > 0.0 && gyro > 0.0 ? 1.0 - both * both / (scans * gyro) : 1.0;
}

double mismatch_of(const Pairs& pairs, const Eigen::Matrix3d& scaled_rotation) {
  double difference = 0.0;
  double scans = 0.0;
  for (const Pair& pair : pairs) {
    difference += (pair.by_scans - scaled_rotation * pair.by_gyro).squaredNorm();
    scans += pair.by_scans.squaredNorm();
  }
  return scans > 0.0 ? difference / scans : 0.0;
}

/// Whether the scans turn now more, now less: only that tells times.
bool has_changes(const Pairs& pairs) {
  constexpr std::size_t kMinCount = 20;
  constexpr double kMinVariation = 0.2;  // standard deviation over mean
  double sum = 0.0;
  double sq_sum = 0.0;
  for (const Pair& pair : pairs) {
    sum += pair.by_scans.norm();
    sq_sum += pair.by_scans.squaredNorm();
  }
  const auto count = static_cast<double>(pairs.size());
  return pairs.size() >= kMinCount &&
         count * sq_sum > (1.0 + kMinVariation * kMinVariation) * sum * sum;
}

/// Looks for the offset, and makes `pairs` those that belong to it.
double find_offset(const MotionHistory& history, Pairs& pairs) {
  constexpr double kMaxOffset = 0.5;       // [s]
  constexpr double kStep = 0.005;          // [s]
  constexpr double kMinDifference = 0.01;  // of amounts, that calls for an offset
  constexpr double kMuchBetter = 0.2;
  const double difference = difference_of_amounts(pairs);
  if (difference < kMinDifference || !has_changes(pairs)) {
    return 0.0;
  }
  const std::vector<MotionHistory::Turn> turns = history.turns();
  const std::size_t enough = pairs.size() - pairs.size() / 5;
  double best = kMuchBetter * difference;
  double best_offset = 0.0;
  for (int i = 0; i <= 2 * static_cast<int>(kMaxOffset / kStep); ++i) {
    const double offset = i * kStep - kMaxOffset;
    Pairs there = pairs_at(history, turns, offset);
    const double its = difference_of_amounts(there);
    if (its < best && there.size() >= enough) {
      best = its;
      best_offset = offset;
      pairs = std::move(there);
    }
  }
  return best_offset;
}

/// The rotation, and the reflection, that turn what the gyroscope says into what the scans say
/// (Kabsch); of turns about one axis alone the smallest rotation and no reflection.
void fit_rotation(const Pairs& pairs, TurnComparison& comparison) {
  constexpr double kMinShare = 0.02;  // of the second axis in the first
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Pair& pair : pairs) {
    products += pair.by_scans * pair.by_gyro.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& U = svd.matrixU();
  const Eigen::Matrix3d& V = svd.matrixV();
  comparison.is_about_one_axis = svd.singularValues()[1] < kMinShare * svd.singularValues()[0];
  if (comparison.is_about_one_axis) {
    comparison.rotation = Eigen::Quaterniond::FromTwoVectors(V.col(0), U.col(0)).toRotationMatrix();
    return;
  }
  const double sign = (U * V.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  const auto with_last_axis = [&U, &V](double direction) {
    return Eigen::Matrix3d(U * Eigen::Vector3d(1.0, 1.0, direction).asDiagonal() * V.transpose());
  };
  comparison.rotation = with_last_axis(sign);
  comparison.reflection = with_last_axis(-sign);
}

double fitted_scale(const Pairs& pairs, const Eigen::Matrix3d& rotation) {
  double both = 0.0;
  double gyro = 0.0;
  for (const Pair& pair : pairs) {
    both += pair.by_scans.dot(rotation * pair.by_gyro);
    gyro += pair.by_gyro.squaredNorm();
  }
  return gyro > 0.0 ? both / gyro : 1.0;
}

/// Turns one after the other as one. Poses that scans tell without an IMU overshoot where a walk
/// swings, which would look like a scale of the gyroscope; slow turns are theirs as well.
Pairs joined(const Pairs& pairs) {
  constexpr double kDuration = 1.0;  // about the period of a step [s]
  Pairs joined;
  Pair sum{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
  for (const Pair& pair : pairs) {
    sum.by_scans += pair.by_scans;
    sum.by_gyro += pair.by_gyro;
    sum.duration += pair.duration;
    if (sum.duration >= kDuration) {
      joined.push_back(sum);
      sum = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
    }
  }
  return joined;
}

/// A straight line through the rates of both.
void fit_changes(const Pairs& pairs, TurnComparison& comparison) {
  constexpr std::size_t kMinCount = 4;
  if (pairs.size() < kMinCount) {
    return;
  }
  const auto count = static_cast<double>(pairs.size());
  const auto scans = [](const Pair& pair) {
    return Eigen::Vector3d(pair.by_scans / pair.duration);
  };
  const auto gyro = [&comparison](const Pair& pair) {
    return Eigen::Vector3d(comparison.rotation * pair.by_gyro / pair.duration);
  };
  Eigen::Vector3d mean_scans = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_gyro = Eigen::Vector3d::Zero();
  for (const Pair& pair : pairs) {
    mean_scans += scans(pair) / count;
    mean_gyro += gyro(pair) / count;
  }
  double sq_scans = 0.0, sq_gyro = 0.0, both = 0.0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d scan_change = scans(pair) - mean_scans;
    const Eigen::Vector3d gyro_change = gyro(pair) - mean_gyro;
    sq_scans += scan_change.squaredNorm();
    sq_gyro += gyro_change.squaredNorm();
    both += scan_change.dot(gyro_change);
  }
  if (!(sq_scans > 0.0) || !(sq_gyro > 0.0)) {
    return;
  }
  const double left = std::max(0.0, sq_scans - both * both / sq_gyro);
  comparison.scale_of_changes = both / sq_gyro;
  comparison.scale_deviation = std::sqrt(left / (3.0 * count - 4.0) / sq_gyro);
  comparison.unexplained_changes = left / sq_scans;
}

}  // namespace

std::optional<TurnComparison> compare_turns(const MotionHistory& history) {
  constexpr double kMinTurned = 0.4;    // [rad]
  constexpr std::size_t kMinCount = 8;  // of turns
  Pairs pairs = pairs_at(history, history.turns(), 0.0);
  TurnComparison comparison;
  for (const Pair& pair : pairs) {
    comparison.turned += pair.by_scans.norm();
  }
  if (pairs.size() < kMinCount || comparison.turned < kMinTurned) {
    return std::nullopt;
  }
  comparison.mismatch = mismatch_of(pairs, Eigen::Matrix3d::Identity());
  comparison.offset = find_offset(history, pairs);
  fit_rotation(pairs, comparison);
  comparison.scale = fitted_scale(pairs, comparison.rotation);
  comparison.best_mismatch = mismatch_of(pairs, comparison.scale * comparison.rotation);
  if (!comparison.is_about_one_axis) {
    const Eigen::Matrix3d& reflection = comparison.reflection;
    comparison.reflected_mismatch =
        mismatch_of(pairs, fitted_scale(pairs, reflection) * reflection);
  }
  fit_changes(joined(pairs), comparison);
  return comparison;
}

}  // namespace nvm::lio
