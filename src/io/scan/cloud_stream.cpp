// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/cloud_stream.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nvm::io {

void CloudStream::check(const CloudMessage& cloud, double time) {
  constexpr double kGone = 1.0;  // a frame that has not come for so long has a new name [s]
  if (cloud.frame != frame_ && time - time_ < kGone) {
    throw std::runtime_error(fmt::format(
        "is of frame '{}', not '{}' as those before: two LiDARs on one topic; record a topic for "
        "each",
        cloud.frame,
        frame_));
  }
  frame_ = cloud.frame;
  time_ = time;
  if (repeats_.is_repeat(cloud.records.bytes)) {
    throw std::runtime_error("has the points of the cloud before, with another stamp");
  }
}

}  // namespace nvm::io
