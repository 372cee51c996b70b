// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/geometry/pose.hpp"

namespace nvm::app {

/// Whether a scan made at `now` tells enough that one made at `last` did not.
inline bool is_on_from(const Pose& last, const Pose& now) {
  constexpr double kStep = 0.5;  // [m]
  constexpr double kTurn = 0.5;  // [rad]
  return (now.translation() - last.translation()).norm() > kStep ||
         so3_log(last.linear().transpose() * now.linear()).norm() > kTurn;
}

}  // namespace nvm::app
