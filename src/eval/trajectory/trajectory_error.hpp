// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "eval/trajectory/alignment.hpp"
#include "eval/trajectory/association.hpp"
#include "eval/trajectory/error_statistics.hpp"

namespace nvm::eval {

/// Distance [m] of each aligned estimated position to the true one, in the order of `pairs`: the
/// absolute trajectory error (spec §6) before it is summarised.
std::vector<double> position_errors(const std::vector<PosePair>& pairs, const Alignment& alignment);

/// Root mean square of what those distances are made of along x, y and z of the world [m].
std::array<double, 3> axis_rmse(const std::vector<PosePair>& pairs, const Alignment& alignment);

/// Over which step of the motion a relative error is taken.
enum class StepUnit { kFrame, kSecond, kMetre };

/// Errors of the motion over a step; alignment plays no part in them.
struct RelativeError {
  std::optional<ErrorStatistics> translation;   ///< [m]; nothing when no step is that long
  std::optional<ErrorStatistics> rotation_deg;  ///< [degrees]
};

/// Relative pose error (Sturm et al., IROS 2012) over steps of one `unit`: the pose of
/// (T_i^-1 T_j)_true^-1 (T_i^-1 T_j)_estimated, for each pose i and the first j that is a whole
/// step after it (in true path length for metres).
RelativeError relative_error(const std::vector<PosePair>& pairs, StepUnit unit);

}  // namespace nvm::eval
