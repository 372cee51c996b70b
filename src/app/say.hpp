// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdio>
#include <string>

namespace nvm::app {

/// Prints "nvm: TEXT" as a line on standard error. When that is a log on a full disk, or closed,
/// the line is lost and nothing else.
inline void say(const std::string& text) {
  static_cast<void>(std::fputs(("nvm: " + text + "\n").c_str(), stderr));
}

}  // namespace nvm::app
