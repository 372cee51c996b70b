// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace nvm::app {

/// A text file that grows with a run and is whole up to what append() took last, also when the
/// disk is full or the process is killed.
class LineFile {
 public:
  /// Makes the file, empty. Throws std::runtime_error.
  explicit LineFile(const std::string& path);

  /// Adds `lines`, all or none of them. Throws std::runtime_error when they cannot be written.
  void append(const std::string& lines);

 private:
  std::string path_;
  std::ofstream stream_;
  std::uintmax_t size_ = 0;  ///< [bytes] of what is whole
};

}  // namespace nvm::app
