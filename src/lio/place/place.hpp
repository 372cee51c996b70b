// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

/// Where in a map a scan was made.
struct Place {
  Pose T_map_scan = Pose::Identity();
  double share = 0.0;       ///< of the scan that lies on surfaces of the map that face it, 0 to 1
  double cost = 1.0;        ///< how far off the scan lies there, see AlignResult
  int open_directions = 0;  ///< of the pose's six, that the scan does not tell
  std::string why_not;      ///< empty when the place is beyond doubt

  bool is_found() const { return why_not.empty(); }
};

}  // namespace nvm::lio
