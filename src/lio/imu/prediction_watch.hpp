// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lio/state/error_state_filter.hpp"

namespace nvm::lio {

/// Compares where the IMU leads the pose with where the scans put it. A match follows a prediction
/// that is wrong, for the map's voxels reach no farther than their size, and scans half fit there:
/// it shows in corrections that the filter does not expect, or in a share of inliers below the
/// usual.
class PredictionWatch {
 public:
  /// The filter before and after the correction by a scan of which `inlier_share` fits, 0 to 1;
  /// `imu_interval` lies between readings [s].
  void add(
      const ErrorStateFilter& predicted,
      const ErrorStateFilter& corrected,
      double inlier_share,
      double imu_interval);

  /// Whether the prediction may have led the last scan astray.
  bool is_doubtful() const { return is_doubtful_; }

  /// What was unexpected in the whole run, in one line; empty where that is next to nothing.
  std::string finding() const;

 private:
  std::optional<double> usual_share_;
  bool is_doubtful_ = false;
  std::size_t count_ = 0;
  std::size_t unexpected_ = 0;  ///< corrections
  double largest_ = 0.0;        ///< of these [m]
};

}  // namespace nvm::lio
