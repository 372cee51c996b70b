// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lio/scan/deskew.hpp"

namespace nvm::lio {

/// A deskewed scan on its way into the map.
struct PreparedScan {
  DeskewedScan scan;
  std::vector<Eigen::Vector3f> normals;  ///< unit or sighting, scan frame; zero: left out
  std::vector<std::uint32_t> keypoints;  ///< indices of the points to match
};

}  // namespace nvm::lio
