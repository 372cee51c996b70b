// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "lio/pipeline/pipeline_options.hpp"

namespace nvm::test {

/// Of a pipeline for the thin scans of a RoomRecording.
inline lio::PipelineOptions options_for(
    lio::PipelineType type, lio::MapType map = lio::MapType::kNvm) {
  lio::PipelineOptions options;
  options.type = type;
  options.map_type = map;
  options.map.capacity = 20'000;
  options.inertial.normals.min_radius = 0.3;
  options.inertial.normals.max_radius = 0.6;
  return options;
}

}  // namespace nvm::test
