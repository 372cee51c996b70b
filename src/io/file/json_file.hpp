// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace nvm::io {

/// The JSON value in the file `path`, members in the file's order. Throws std::runtime_error,
/// naming the file, when it is missing or malformed.
nlohmann::ordered_json read_json(const std::string& path);

}  // namespace nvm::io
