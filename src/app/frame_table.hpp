// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// The first line of frames.csv: the names of its columns, see docs/formats.md.
std::string frame_header();

/// The line of one frame.
std::string frame_row(const lio::FrameResult& frame);

}  // namespace nvm::app
