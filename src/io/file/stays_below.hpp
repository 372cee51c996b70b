// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <filesystem>
#include <string>

namespace nvm::io {

/// Whether a file that is called `name` in a list lies in the list's folder or below it: a relative
/// path that does not lead out of the folder. A list from elsewhere can so read nothing else.
inline bool stays_below(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
  return !path.empty() && path.is_relative() && *path.begin() != "..";
}

}  // namespace nvm::io
