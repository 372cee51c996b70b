// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// What a viewer shows of a run while it goes on: each frame with its deskewed scan, and from time
/// to time the map (docs/formats.md, "Stream of a run").
class RunStream {
 public:
  /// Into the file or pipe `path`; nowhere when it is empty. Throws std::runtime_error when that
  /// cannot be written.
  explicit RunStream(const std::string& path);

  /// Writes what `pipeline` has just made of a scan. Where the viewer has gone the run goes on
  /// without it.
  void add(const lio::FrameResult& frame, const lio::Pipeline& pipeline);

 private:
  std::vector<MapPoint> map_when_due(const lio::Pipeline& pipeline);

  std::ofstream stream_;
  std::chrono::steady_clock::time_point next_map_;
};

}  // namespace nvm::app
