// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace nvm::io {

/// Throws std::runtime_error "path: problem", the one form of error about a file.
[[noreturn]] void fail(const std::string& path, const std::string& problem);

/// All bytes of a file. Throws std::runtime_error when it cannot be read.
std::string read_file(const std::string& path);

/// The extension of `path` in lower case, with its dot.
std::string extension_of(const std::string& path);

/// A file that appears under its name only when it is complete: the text goes to a temporary name
/// in the same folder, commit() renames, and without commit() nothing is left.
class AtomicFile {
 public:
  /// Throws std::runtime_error when the folder cannot be written to.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }

  /// Puts the file in place. Throws std::runtime_error when something could not be written.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  std::ofstream stream_;
};

}  // namespace nvm::io
