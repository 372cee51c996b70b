// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string_view>
#include <vector>

namespace nvm::sim {

/// A file of scenes/, built into the program so that it needs no data beside it.
struct ShippedFile {
  std::string_view name;
  std::string_view text;
};

/// In the order of their names.
const std::vector<ShippedFile>& shipped_files();

}  // namespace nvm::sim
