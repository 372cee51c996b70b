// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/continuous_matcher.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lio/match/aligned_matcher.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

namespace {

constexpr std::size_t kBlock = 128;

/// From `from` to `to`, as retract() takes it.
PoseStep step_between(const Pose& from, const Pose& to) {
  PoseStep step;
  step.head<3>() = so3_log(from.linear().transpose() * to.linear());
  step.tail<3>() = to.translation() - from.translation();
  return step;
}

/// How firmly the begin is tied to the last scan's end: one over its variance, which is what the
/// filter doubts, but never nothing.
PoseStep begin_tie(const PoseObservation& doubt) {
  constexpr double kRotationDeviation = 0.0003;    // [rad]
  constexpr double kTranslationDeviation = 0.001;  // [m]
  const double rotation = std::hypot(doubt.rotation_deviation, kRotationDeviation);
  const double translation = std::hypot(doubt.translation_deviation, kTranslationDeviation);
  PoseStep tie;
  tie.head<3>().setConstant(1.0 / (rotation * rotation));
  tie.tail<3>().setConstant(1.0 / (translation * translation));
  return tie;
}

}  // namespace

ContinuousMatcher::ContinuousMatcher(
    const AlignOptions& align, double residual_deviation, const Executor& executor)
    : options_(align),
      coupling_(align, residual_deviation),
      residual_variance_(residual_deviation * residual_deviation),
      executor_(executor) {}

MatchResult ContinuousMatcher::match(
    const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) {
  const Pose predicted = filter.state().T_world_lidar();
  begin_tie_ = residual_variance_ * begin_tie(pose_doubt(filter));
  const auto& ages = scan.scan.ages;
  duration_ = ages.empty() ? 0.0F : *std::max_element(ages.begin(), ages.end());
  begin_.setZero();
  end_.setZero();
  begin_per_end_.setZero();
  MatchResult result;
  const auto linearize_at = [&](const NavState& state, bool, Information& information) {
    const PoseStep end = step_between(predicted, state.T_world_lidar());
    begin_ += begin_per_end_ * (end - end_);
    end_ = end;
    Sums sums = linearize(map, scan, predicted);
    eliminate_begin(sums);
    return coupling_.inform(sums.end, state, information, result);
  };
  const UpdateResult update = filter.update(linearize_at, coupling_.iteration());
  result.accepted = update.applied;
  result.iterations = update.iterations;
  if (result.accepted) {
    end_ = step_between(predicted, filter.state().T_world_lidar());
    correct_points(predicted, scan.scan);
  }
  return result;
}

ContinuousMatcher::Sums ContinuousMatcher::linearize(
    const LioMap& map, const PreparedScan& scan, const Pose& T_world_lidar) {
  const std::size_t size = scan.keypoints.size();
  const std::size_t blocks = (size + kBlock - 1) / kBlock;
  block_sums_.assign(blocks, Sums{});
  contexts_.resize(std::max(contexts_.size(), blocks));
  executor_.for_blocks(size, kBlock, [&](std::size_t begin, std::size_t end) {
    const std::size_t block = begin / kBlock;
    for (std::size_t i = begin; i < end; ++i) {
      add_point(map, scan, scan.keypoints[i], T_world_lidar, block);
    }
  });
  Sums total;
  for (const Sums& sums : block_sums_) {
    total.end += sums.end;
    total.begin += sums.begin;
    total.begin_end += sums.begin_end;
    total.begin_gradient += sums.begin_gradient;
  }
  return total;
}

void ContinuousMatcher::add_point(
    const LioMap& map,
    const PreparedScan& scan,
    std::uint32_t index,
    const Pose& T_world_lidar,
    std::size_t block) {
  LioMap::QueryContext& context = contexts_[block];
  Sums& sums = block_sums_[block];
  const double begin_share =
      duration_ > 0.0F ? static_cast<double>(scan.scan.ages[index] / duration_) : 0.0;
  const PoseStep here = begin_share * begin_ + (1.0 - begin_share) * end_;
  const Pose T_here = retract(T_world_lidar, here);
  const Eigen::Vector3d p_scan = scan.scan.points[index].cast<double>();
  const Eigen::Vector3f n_map =
      (T_here.linear() * scan.normals[index].cast<double>()).cast<float>();
  const Association association =
      associate(map, T_here * p_scan, n_map, options_.association, context);
  NormalEquations equations;
  equations.add(p_scan, T_here.linear(), association, options_.kernel);
  sums.begin += begin_share * begin_share * equations.information;
  sums.begin_end += begin_share * (1.0 - begin_share) * equations.information;
  sums.begin_gradient += begin_share * equations.gradient;
  equations.information *= (1.0 - begin_share) * (1.0 - begin_share);
  equations.gradient *= 1.0 - begin_share;
  sums.end += equations;
}

void ContinuousMatcher::eliminate_begin(Sums& sums) {
  sums.begin.diagonal() += begin_tie_;
  sums.begin_gradient += begin_tie_.cwiseProduct(begin_);
  const Eigen::LDLT<PoseMatrix> begin(sums.begin);
  const PoseStep step = begin.solve(sums.begin_gradient);
  begin_per_end_ = -begin.solve(sums.begin_end);
  begin_ -= step;
  sums.end.information += sums.begin_end.transpose() * begin_per_end_;
  sums.end.gradient -= sums.begin_end.transpose() * step;
}

void ContinuousMatcher::correct_points(const Pose& T_world_lidar, DeskewedScan& scan) const {
  if (!(duration_ > 0.0F)) {
    return;
  }
  const PoseStep begin_to_end = begin_ - end_;
  const Eigen::Vector3f turn = begin_to_end.head<3>().cast<float>();
  const Eigen::Vector3f shift =
      (T_world_lidar.linear().transpose() * begin_to_end.tail<3>()).cast<float>();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float begin_share = scan.ages[i] / duration_;
    scan.points[i] += begin_share * (turn.cross(scan.points[i]) + shift);
    scan.viewpoints[i] += begin_share * (turn.cross(scan.viewpoints[i]) + shift);
  }
}

}  // namespace nvm::lio
