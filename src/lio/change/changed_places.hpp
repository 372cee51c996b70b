// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lio/change/change_votes.hpp"

namespace nvm::lio {

/// Changed surfaces that lie together.
struct ChangedPlace {
  std::vector<ChangedSurface> surfaces;
  double area = 0.0;                                 ///< [m^2], about
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the surfaces [m]
};

/// `surfaces` by places, largest first; what is too small to be told from noise is left out.
std::vector<ChangedPlace> changed_places(const std::vector<ChangedSurface>& surfaces);

}  // namespace nvm::lio
