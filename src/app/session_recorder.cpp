// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/session_recorder.hpp"

#include <filesystem>
#include <stdexcept>

#include "app/is_on_from.hpp"

namespace nvm::app {

namespace {

/// Without sightings: what is asked where it was made must lie on a surface.
constexpr lio::KeypointOptions kThinned{0.15, 5000, 0, 0};

}  // namespace

SessionRecorder::SessionRecorder(const std::string& folder, const lio::LioMap& map)
    : map_(folder + "/map.nvm"),
      path_(folder + "/" + io::SessionWriter::kFileName),
      sampler_(kThinned) {
  if (map.voxel_map() != nullptr && !map.is_frozen()) {
    writer_.emplace(path_);
  }
}

void SessionRecorder::add(const lio::FrameResult& frame, const lio::Pipeline& pipeline) {
  if (!writer_ || !error_.empty() || !lio::is_believed(frame.status) ||
      (last_ && !is_on_from(*last_, frame.T_map_lidar))) {
    return;
  }
  const std::vector<std::uint32_t>& thinned =
      sampler_.sample(pipeline.scan().points, pipeline.normals());
  keyframe_.time = frame.time;
  keyframe_.T_map_lidar = frame.T_map_lidar;
  lio::pick(pipeline.scan().points, thinned, keyframe_.points);
  lio::pick(pipeline.normals(), thinned, keyframe_.normals);
  last_ = frame.T_map_lidar;
  try {
    writer_->add(keyframe_);
  } catch (const std::runtime_error& error) {
    error_ = error.what();
  }
}

void SessionRecorder::finish() {
  if (!writer_) {
    return;
  }
  if (!std::filesystem::exists(map_)) {
    std::filesystem::remove(path_);
    return;
  }
  if (!error_.empty()) {
    throw std::runtime_error(error_);
  }
  writer_->finish(io::stamp_of(map_));
}

}  // namespace nvm::app
