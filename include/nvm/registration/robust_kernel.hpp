// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>

#include "nvm/core/finite.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"

namespace nvm {

/// Loss rho(e) of one residual e [m], so that outliers pull less than their square.
struct RobustKernel {
  enum class Type {
    kNone,    ///< e^2 / 2
    kHuber,   ///< e^2 / 2 up to `scale`, linear beyond
    kCauchy,  ///< scale^2 / 2 log(1 + (e / scale)^2)
  };

  Type type = Type::kCauchy;
  /// Residual from which the kernel takes effect [m], positive.
  double scale = 0.05;

  /// rho'(e) / e, 0 to 1: the weight that makes e^2 / 2 descend like rho (iterative reweighting).
  NVM_SHARED double weight(double residual) const {
    const double ratio = std::abs(residual) / scale;
    switch (type) {
      case Type::kNone:
        return 1.0;
      case Type::kHuber:
        return ratio <= 1.0 ? 1.0 : 1.0 / ratio;
      case Type::kCauchy:
        return 1.0 / (1.0 + ratio * ratio);
    }
    return 1.0;
  }

  /// Throws std::invalid_argument when the scale is not positive.
  NVM_SHARED void validate() const {
    require(scale > 0.0 && detail::is_finite(scale), "kernel scale", scale, "positive [m]");
  }
};

}  // namespace nvm
