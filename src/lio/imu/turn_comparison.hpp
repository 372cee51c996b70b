// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lio/imu/motion_history.hpp"

namespace nvm::lio {

/// How the gyroscope's turning compares with that of the scans. A mismatch is the mean squared
/// difference over the mean square of the scans' turning: 0 where they agree, 1 where the gyroscope
/// says nothing, 4 where it says the opposite.
struct TurnComparison {
  double turned = 0.0;         ///< by the scans, all turns added up [rad]
  double mismatch = 0.0;       ///< as the readings are
  double best_mismatch = 0.0;  ///< after `offset`, `scale` and `rotation`
  /// The IMU's clock is late by this [s]: a reading stamped t belongs to t - offset.
  double offset = 0.0;
  double scale = 1.0;  ///< the scans' turning over the gyroscope's
  /// The same of what changes in both, which a bias of the gyroscope does not touch, its standard
  /// deviation, and the share of the scans' changes that it leaves unexplained, 0 to 1.
  double scale_of_changes = 1.0, scale_deviation = 1.0, unexplained_changes = 1.0;
  /// From the IMU's axes to those that the poses take for them; identity where they agree.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  bool is_about_one_axis = true;  ///< `rotation` is known up to a turn about it
  /// The same if one set of axes is left-handed, and the mismatch that is left then.
  Eigen::Matrix3d reflection = Eigen::Matrix3d::Identity();
  double reflected_mismatch = 1.0;
};

/// Nothing until the scans of `history` have turned enough to tell. The offset, up to half a
/// second, is where both turn by amounts that go together best, whatever their units and axes; it
/// stays zero unless the amounts disagree without it.
std::optional<TurnComparison> compare_turns(const MotionHistory& history);

}  // namespace nvm::lio
