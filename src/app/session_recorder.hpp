// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>

#include "io/result/session_file.hpp"
#include "lio/map/lio_map.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "lio/scan/keypoints.hpp"

namespace nvm::app {

/// Writes session.nvms as a run goes: a keyframe wherever the LiDAR has moved or turned on, so that
/// nvm merge can find how this run lies towards others. Takes the memory of one keyframe.
class SessionRecorder {
 public:
  /// Makes the file in `folder`, if `map` will be in map.nvm there. Throws std::runtime_error.
  SessionRecorder(const std::string& folder, const lio::LioMap& map);

  const std::string& path() const { return path_; }

  /// Takes the frame that `pipeline` has just finished, when it fits the map and shows something
  /// new. What cannot be written does not end the run: finish() says it.
  void add(const lio::FrameResult& frame, const lio::Pipeline& pipeline);

  /// Completes the file with the stamp of map.nvm, or removes it where that could not be written.
  /// Throws std::runtime_error.
  void finish();

 private:
  std::string map_;
  std::string path_;
  std::optional<io::SessionWriter> writer_;
  lio::KeypointSampler sampler_;
  std::optional<Pose> last_;  ///< T_map_lidar of the last keyframe
  std::string error_;         ///< of the first keyframe that could not be written
  io::Keyframe keyframe_;     // kept for its memory
};

}  // namespace nvm::app
