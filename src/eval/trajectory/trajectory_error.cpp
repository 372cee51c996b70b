// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory/trajectory_error.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace nvm::eval {

namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

/// How far the motion has come at each pair, in `unit`; never descends.
std::vector<double> progress(const std::vector<PosePair>& pairs, StepUnit unit) {
  std::vector<double> result;
  double path = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i > 0) {
      path +=
          (pairs[i].T_world_body.translation() - pairs[i - 1].T_world_body.translation()).norm();
    }
    result.push_back(
        unit == StepUnit::kFrame    ? static_cast<double>(i)
        : unit == StepUnit::kSecond ? pairs[i].time
                                    : path);
  }
  return result;
}

/// For each index i that has one, (i, first j with progress[j] - progress[i] >= 1).
std::vector<std::pair<std::size_t, std::size_t>> unit_steps(const std::vector<double>& progress) {
  constexpr double kStep = 1.0 - 1e-6;  // times such as 0.1 + 0.9 must count as a second
  std::vector<std::pair<std::size_t, std::size_t>> steps;
  std::size_t j = 0;
  for (std::size_t i = 0; i < progress.size(); ++i) {
    while (j < progress.size() && progress[j] - progress[i] < kStep) {
      ++j;
    }
    if (j == progress.size()) {
      break;
    }
    steps.emplace_back(i, j);
  }
  return steps;
}

Pose step_error(const PosePair& from, const PosePair& to) {
  const Pose T_true = from.T_world_body.inverse() * to.T_world_body;
  const Pose T_estimated = from.T_map_body.inverse() * to.T_map_body;
  return T_true.inverse() * T_estimated;
}

Eigen::Vector3d position_offset(const PosePair& pair, const Alignment& alignment) {
  return alignment * pair.T_map_body.translation() - pair.T_world_body.translation();
}

}  // namespace

std::vector<double> position_errors(
    const std::vector<PosePair>& pairs, const Alignment& alignment) {
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    errors.push_back(position_offset(pair, alignment).norm());
  }
  return errors;
}

std::array<double, 3> axis_rmse(const std::vector<PosePair>& pairs, const Alignment& alignment) {
  Eigen::Array3d sq_sum = Eigen::Array3d::Zero();
  for (const PosePair& pair : pairs) {
    sq_sum += position_offset(pair, alignment).array().square();
  }
  const Eigen::Array3d rmse = (sq_sum / static_cast<double>(pairs.size())).sqrt();
  return {rmse.x(), rmse.y(), rmse.z()};
}

RelativeError relative_error(const std::vector<PosePair>& pairs, StepUnit unit) {
  std::vector<double> translations;
  std::vector<double> rotations_deg;
  for (const auto& [i, j] : unit_steps(progress(pairs, unit))) {
    const Pose error = step_error(pairs[i], pairs[j]);
    translations.push_back(error.translation().norm());
    rotations_deg.push_back(so3_log(error.linear()).norm() * kDegreesPerRadian);
  }
  return {summarize(std::move(translations)), summarize(std::move(rotations_deg))};
}

}  // namespace nvm::eval
