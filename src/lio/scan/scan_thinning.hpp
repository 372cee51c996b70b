// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "common/sensor_data.hpp"
#include "lio/scan/deskew.hpp"

namespace nvm::lio {

/// Leaves out returns of a scan that has too many, where they are densest: near the sensor. A
/// LiDAR's returns lie the farther apart the longer their range, so that keeping a share of
/// (range / reach)^2 of those within some reach leaves them as dense as they are there, and all
/// that lie beyond.
class ScanThinning {
 public:
  /// Leaves about limits.max_count of the returns of `scan` within the limits of range, all if
  /// there are no more.
  ScanThinning(const Scan& scan, const ReturnLimits& limits);

  /// Whether to keep the next of these returns, at this squared range [m^2]. To be asked in order.
  bool keeps(float sq_range) noexcept {
    due_ += sq_range < sq_reach_ ? sq_range / sq_reach_ : 1.0F;
    const bool keeps = due_ >= 1.0F;
    due_ -= keeps ? 1.0F : 0.0F;
    return keeps;
  }

 private:
  float sq_reach_ = 0.0F;  ///< [m^2]
  float due_ = 0.0F;       ///< returns to keep, less those kept
};

}  // namespace nvm::lio
