// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "lio/match/main_axis.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::lio {

/// Notices where the scans of a run tell the pose just enough to be followed, but not well: what
/// the sweep's motion and the normals err by comes back many times larger there. A VLP-16 in a room
/// that shows it neither floor nor ceiling errs by centimetres to decimetres of height.
class FaintDirection {
 public:
  /// Takes the alignment of points at `mean_range` [m]; `R_body_scan` is the extrinsic's rotation.
  void add(const AlignResult& aligned, double mean_range, const Eigen::Matrix3d& R_body_scan);

  /// One line once most of at least fifty scans were faint, "" otherwise.
  std::string finding() const;

 private:
  std::size_t scans_ = 0;
  std::size_t faint_ = 0;
  double sum_shares_ = 0.0;  // of the faint ones' faintest directions
  MainAxis along_, about_;
};

}  // namespace nvm::lio
