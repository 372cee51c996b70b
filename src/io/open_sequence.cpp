// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <filesystem>

#include "io/file.hpp"
#include "io/nvm_sequence_reader.hpp"
#include "io/scan_folder.hpp"
#include "io/sequence_reader.hpp"

namespace nvm::io {

std::unique_ptr<SequenceReader> open_sequence(
    const std::string& path, const SequenceOptions& options) {
  if (!std::filesystem::exists(path)) {
    fail(path, "does not exist");
  }
  if (std::filesystem::is_directory(path)) {
    return is_nvm_sequence(path) ? open_nvm_sequence(path) : open_scan_folder(path, options);
  }
  fail(path, "is no sequence: expected a folder of scans, an nvm sequence folder or a .bag file");
}

}  // namespace nvm::io
