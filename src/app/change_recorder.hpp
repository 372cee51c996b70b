// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "lio/change/change_finder.hpp"
#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// Watches a run in a prior map for what has changed since that was made.
class ChangeRecorder {
 public:
  /// A map that scans go into is not watched.
  explicit ChangeRecorder(const lio::LioMap& map);

  /// Takes the scan that `pipeline` has taken last, when it tells more than the ones before.
  void add(const lio::FrameResult& frame, const lio::Pipeline& pipeline);

  /// Whether there is something to tell.
  bool is_of_use() const { return finder_ && finder_->scans() > 0; }

  /// Writes changes.ply (see docs/formats.md) to `folder`, with the map's origin at `origin` [m],
  /// and returns what has changed, in a line. Throws std::runtime_error.
  std::string write(const std::string& folder, const Eigen::Vector3d& origin) const;

 private:
  std::optional<lio::ChangeFinder> finder_;
  double last_time_ = 0.0;  ///< of a scan that was taken [s]
  Pose last_pose_;
};

}  // namespace nvm::app
