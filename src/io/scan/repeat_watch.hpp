// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

namespace nvm::io {

/// Finds scans that are those before them: drivers send the last one again, or hang.
class RepeatWatch {
 public:
  /// Whether `points`, the bytes of the next scan, are those of the scan before. What has never
  /// changed, or does not for 30 scans on end, is no repeat: then nothing moves, and nothing is
  /// noisy, as in a simulator.
  bool is_repeat(const std::string& points) {
    constexpr std::size_t kMinChanges = 3, kMaxRepeats = 30;
    const bool is_same = !points.empty() && points == points_;
    repeats_ = is_same ? repeats_ + 1 : 0;
    changes_ += is_same || points_.empty() ? 0 : 1;
    points_ = points;
    return is_same && repeats_ <= kMaxRepeats && changes_ >= kMinChanges;
  }

 private:
  std::string points_;       ///< of the scan before
  std::size_t repeats_ = 0;  ///< on end
  std::size_t changes_ = 0;  ///< in all
};

}  // namespace nvm::io
