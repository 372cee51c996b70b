// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/json_file.hpp"

#include "io/file/file.hpp"

namespace nvm::io {

nlohmann::ordered_json read_json(const std::string& path) {
  try {
    return nlohmann::ordered_json::parse(read_file(path));
  } catch (const nlohmann::json::exception& error) {
    fail(path, std::string("not JSON: ") + error.what());
  }
}

}  // namespace nvm::io
