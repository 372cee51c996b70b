// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/continuous_matcher.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace nvm::lio {

namespace {

constexpr std::size_t kBlock = 128;

// A residual errs by about this [m]; the ties are weighed against it.
constexpr double kResidualDeviation = 0.01;
// How far the begin may leave the last scan's end, and the end the prediction, where the filter is
// sure of it.
constexpr PoseObservation kBeginTie{0.001, 0.0003};
constexpr PoseObservation kEndTie{0.05, 0.02};

PoseObservation loosened(const PoseObservation& tie, const PoseObservation& doubt) {
  return {
      std::hypot(tie.translation_deviation, doubt.translation_deviation),
      std::hypot(tie.rotation_deviation, doubt.rotation_deviation)};
}

}  // namespace

ContinuousMatcher::ContinuousMatcher(
    const AlignOptions& align, const PoseObservation& observation, const Executor& executor)
    : options_(align), observation_(observation), executor_(executor) {
  align.validate();
  observation.validate();
}

MatchResult ContinuousMatcher::match(
    const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) {
  const Pose predicted = filter.state().T_world_lidar();
  doubt_ = pose_doubt(filter);
  const auto& ages = scan.scan.ages;
  duration_ = ages.empty() ? 0.0F : *std::max_element(ages.begin(), ages.end());
  correction_.setZero();
  MatchResult result;
  bool converged = false;
  while (result.iterations < options_.max_iterations && !converged) {
    Sums sums = linearize(map, scan, predicted);
    result.residuals = sums.end.counts.valid;
    result.inlier_share = static_cast<double>(sums.end.counts.valid) /
                          static_cast<double>(std::max<std::size_t>(sums.end.counts.total(), 1));
    result.residual_rms = sums.end.rms_distance();
    result.degenerate_directions =
        solve(sums.end, options_.min_observability).degenerate_directions;
    if (result.residuals < options_.min_residuals) {
      return result;
    }
    add_ties(sums);
    const Vector12 step = -sums.information.ldlt().solve(sums.gradient);
    correction_ += step;
    ++result.iterations;
    converged = step.segment<3>(6).norm() < options_.converged_rotation &&
                step.segment<3>(9).norm() < options_.converged_translation;
  }
  result.accepted = true;
  observe_lidar_pose(retract(predicted, correction_.tail<6>()), observation_, filter);
  correct_points(predicted, scan.scan);
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
    total.information += sums.information;
    total.gradient += sums.gradient;
    total.end += sums.end;
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
  const PoseStep here =
      begin_share * correction_.head<6>() + (1.0 - begin_share) * correction_.tail<6>();
  const Pose T_here = retract(T_world_lidar, here);
  const Eigen::Vector3d p_scan = scan.scan.points[index].cast<double>();
  const Eigen::Vector3f n_map =
      (T_here.linear() * scan.normals[index].cast<double>()).cast<float>();
  const Association association =
      associate(map, T_here * p_scan, n_map, options_.association, context);
  sums.end.add(p_scan, T_here.linear(), association, options_.kernel);
  if (association.status != AssociationStatus::kValid) {
    return;
  }
  const PoseStep jacobian = point_to_plane_jacobian(
      p_scan, T_here.linear().transpose() * association.normal, association.normal);
  Vector12 both;
  both << begin_share * jacobian, (1.0 - begin_share) * jacobian;
  const double weight = options_.kernel.weight(association.weight * association.distance) *
                        association.weight * association.weight;
  sums.information.noalias() += (weight * both) * both.transpose();
  sums.gradient += (weight * association.distance) * both;
}

void ContinuousMatcher::add_ties(Sums& sums) const {
  const auto tie = [&](int begin, const PoseObservation& deviation) {
    PoseStep weight;
    weight.head<3>().setConstant(kResidualDeviation / deviation.rotation_deviation);
    weight.tail<3>().setConstant(kResidualDeviation / deviation.translation_deviation);
    weight = weight.cwiseAbs2().eval();
    sums.information.diagonal().segment<6>(begin) += weight;
    sums.gradient.segment<6>(begin) += weight.cwiseProduct(correction_.segment<6>(begin));
  };
  tie(0, loosened(kBeginTie, doubt_));
  tie(6, loosened(kEndTie, doubt_));
}

void ContinuousMatcher::correct_points(const Pose& T_world_lidar, DeskewedScan& scan) const {
  if (!(duration_ > 0.0F)) {
    return;
  }
  const PoseStep begin_to_end = correction_.head<6>() - correction_.tail<6>();
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
