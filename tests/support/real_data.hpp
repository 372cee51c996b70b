// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace nvm::test {

/// The folder of real scans: $NVM_DATA, or ../shared/data beside the source tree, which the build
/// names (__FILE__ is relative under ccache); empty without one.
inline std::string real_data() {
  const char* variable = std::getenv("NVM_DATA");
  const std::filesystem::path folder =
      variable != nullptr ? variable : NVM_SOURCE_DIR "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder.string() : "";
}

}  // namespace nvm::test
