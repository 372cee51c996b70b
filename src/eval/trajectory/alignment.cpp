// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory/alignment.hpp"

#include <Eigen/Dense>
#include <stdexcept>

namespace nvm::eval {

namespace {

/// Positions as columns, one per pair.
using Positions = Eigen::Matrix3Xd;

template <class Member>
Positions positions(const std::vector<PosePair>& pairs, Member pose) {
  Positions result(3, static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    result.col(static_cast<Eigen::Index>(i)) = (pairs[i].*pose).translation();
  }
  return result;
}

/// True when the positions span at least a plane, relative to their own extent.
bool span_plane(const Positions& positions) {
  const Positions centered = positions.colwise() - positions.rowwise().mean();
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                                     centered * centered.transpose(), Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  constexpr double kSqTolerance = 1e-12;
  return spread(1) > kSqTolerance * spread(2);
}

}  // namespace

AlignmentKind alignment_kind(const std::string& name) {
  if (name == "none") {
    return AlignmentKind::kNone;
  }
  if (name == "se3") {
    return AlignmentKind::kSe3;
  }
  if (name == "sim3") {
    return AlignmentKind::kSim3;
  }
  throw std::invalid_argument("alignment is '" + name + "'; allowed: none, se3, sim3");
}

Alignment align(const std::vector<PosePair>& pairs, AlignmentKind kind) {
  if (kind == AlignmentKind::kNone) {
    return {};
  }
  const Positions p_map = positions(pairs, &PosePair::T_map_body);
  const Positions p_world = positions(pairs, &PosePair::T_world_body);
  if (pairs.size() < 3 || !span_plane(p_map) || !span_plane(p_world)) {
    throw std::runtime_error(
        "the positions do not determine an alignment (" + std::to_string(pairs.size()) +
        " poses; they must span a plane); align by 'none' if both trajectories share a frame");
  }
  const bool with_scale = kind == AlignmentKind::kSim3;
  const Eigen::Matrix4d T = Eigen::umeyama(p_map, p_world, with_scale);
  Alignment alignment;
  alignment.scale = with_scale ? T.topLeftCorner<3, 3>().col(0).norm() : 1.0;
  alignment.T_world_map.linear() = T.topLeftCorner<3, 3>() / alignment.scale;
  alignment.T_world_map.translation() = T.topRightCorner<3, 1>();
  return alignment;
}

}  // namespace nvm::eval
