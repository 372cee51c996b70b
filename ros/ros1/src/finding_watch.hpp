// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <map>
#include <string>
#include <vector>

namespace nvm_ros {

/// Chooses what to say of findings, each kind once, whatever its numbers: while a run goes on they
/// change from scan to scan, and what the first scans seem to say may not last.
class FindingWatch {
 public:
  /// Those of `findings`, as they are at `time` [s], that have lasted and have not been said.
  std::vector<std::string> new_ones(double time, const std::vector<std::string>& findings);

 private:
  struct Kind {
    double since = 0.0;  ///< [s]
    bool is_said = false;
  };

  std::map<std::string, Kind> kinds_;
};

}  // namespace nvm_ros
