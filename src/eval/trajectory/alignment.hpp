// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "eval/trajectory/association.hpp"

namespace nvm::eval {

/// Which transform may be taken out before an estimate is compared with the truth.
enum class AlignmentKind {
  kNone,  ///< both already share one frame
  kSe3,   ///< rotation and translation
  kSim3,  ///< and a scale
};

/// The kind named "none", "se3" or "sim3". Throws std::invalid_argument for any other name.
AlignmentKind alignment_kind(const std::string& name);

/// Maps map coordinates to the world: p_world = scale * R p_map + t, with R and t of T_world_map.
struct Alignment {
  Pose T_world_map = Pose::Identity();
  double scale = 1.0;

  Eigen::Vector3d operator*(const Eigen::Vector3d& p_map) const {
    return scale * (T_world_map.linear() * p_map) + T_world_map.translation();
  }
};

/// The least-squares alignment of the estimated to the true positions (Umeyama, PAMI 1991). Throws
/// std::runtime_error when they leave it undetermined: fewer than three pairs, or all positions in
/// one point or on one straight line.
Alignment align(const std::vector<PosePair>& pairs, AlignmentKind kind);

}  // namespace nvm::eval
