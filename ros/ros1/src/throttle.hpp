// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <chrono>
#include <optional>

namespace nvm_ros {

/// Lets one of many messages pass every few seconds of wall time. (ROS's own throttle goes by ROS
/// time, which stands still when a simulation does.)
class Throttle {
 public:
  bool passes() {
    constexpr std::chrono::seconds kPeriod{5};
    const auto now = std::chrono::steady_clock::now();
    if (last_ && now - *last_ < kPeriod) {
      return false;
    }
    last_ = now;
    return true;
  }

 private:
  std::optional<std::chrono::steady_clock::time_point> last_;
};

}  // namespace nvm_ros
