// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/json_file.hpp"

#include "io/file.hpp"

namespace nvm::eval {

nlohmann::ordered_json read_json(const std::string& path) {
  try {
    return nlohmann::ordered_json::parse(io::read_file(path));
  } catch (const nlohmann::json::exception& error) {
    io::fail(path, std::string("not JSON: ") + error.what());
  }
}

}  // namespace nvm::eval
