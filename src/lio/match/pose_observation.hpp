// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::lio {

/// How sure the filter may be of a pose that the optimisation found: one standard deviation.
struct PoseObservation {
  double translation_deviation = 0.006;  ///< [m]
  double rotation_deviation = 0.0015;    ///< [rad]

  void validate() const;
};

}  // namespace nvm::lio
