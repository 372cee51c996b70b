// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "lio/error_state_filter.hpp"

namespace nvm::lio {

/// Takes out of `information` the directions of the pose that the scan hardly tells, so that the
/// update leaves them to the IMU (solution remapping: Zhang, Kaess and Singh, ICRA 2016): in a
/// corridor, noise in the normals would else pass for knowledge of the position along it.
///
/// A direction counts as unobserved when its share of the information, with rotations measured by
/// the arc [m] that they make at `mean_range` [m], is below `min_observability` (0: none of it, 1:
/// every residual). Returns how many were removed, 0 to 6.
int remove_unobserved(Information& information, double mean_range, double min_observability);

}  // namespace nvm::lio
