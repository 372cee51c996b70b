// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <filesystem>
#include <string>

namespace nvm::io {

/// `path`, or the map in it when it is a folder of results.
inline std::string map_in(const std::string& path) {
  const std::string file = path + "/map.nvm";
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) && std::filesystem::exists(file, ignored)
             ? file
             : path;
}

}  // namespace nvm::io
