// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/pipeline.hpp"

namespace nvm::lio {

const char* name(FrameStatus status) {
  switch (status) {
    case FrameStatus::kInitializing:
      return "initializing";
    case FrameStatus::kTracking:
      return "tracking";
    case FrameStatus::kDegenerate:
      return "degenerate";
    case FrameStatus::kWeak:
      return "weak";
    case FrameStatus::kLost:
      return "lost";
    case FrameStatus::kSkipped:
      return "skipped";
  }
  return "unknown";
}

}  // namespace nvm::lio
