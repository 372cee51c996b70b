// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::lio {

/// How far and how finely a StartSearch looks.
struct StartSearchOptions {
  /// Edge of the coarse map's voxels [m], 0.1 to 10: a start may be off by about this much.
  double voxel_size = 1.0;
  /// At most one keypoint in each cube of this edge [m], positive.
  double keypoint_spacing = 1.0;
  /// How far turned() turns [rad], 0 (not at all) to pi.
  double turn = 0.5;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  void validate() const;
};

}  // namespace nvm::lio
