// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <limits>
#include <string>

#include "io/scan/repeat_watch.hpp"
#include "io/scan/scan_converter.hpp"

namespace nvm::io {

/// Keeps a topic to the clouds of one LiDAR, each once: two may publish on it in turn, and a driver
/// may send its last cloud again with a new stamp.
class CloudStream {
 public:
  /// Takes the next cloud, recorded at `time` [s]. Throws std::runtime_error for one that comes
  /// from another frame while the first one's go on, or has the points of the cloud before.
  void check(const CloudMessage& cloud, double time);

 private:
  std::string frame_;
  double time_ = -std::numeric_limits<double>::infinity();  ///< of its last cloud [s]
  RepeatWatch repeats_;
};

}  // namespace nvm::io
