// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <fstream>
#include <ostream>
#include <string>
#include <string_view>

namespace nvm::io {

/// Throws std::runtime_error "path: problem", the one form of error about a file.
[[noreturn]] void fail(const std::string& path, const std::string& problem);

/// Opens a file to read it. Throws std::runtime_error when that fails or it is a folder.
std::ifstream open_to_read(const std::string& path);

/// All bytes of a file. Throws std::runtime_error when it cannot be read.
std::string read_file(const std::string& path);

/// The extension of `path` in lower case, with its dot.
std::string extension_of(const std::string& path);

/// `text` in quotes, for a message: cut to 40 characters, and what cannot be printed as '?'.
std::string quote(std::string_view text);

/// A file or folder that is made under a temporary name beside its own, and appears under its own
/// when it is complete: commit() renames; without commit() nothing is left.
class PendingPath {
 public:
  explicit PendingPath(const std::string& path);
  ~PendingPath();
  PendingPath(const PendingPath&) = delete;
  PendingPath& operator=(const PendingPath&) = delete;

  const std::string& path() const { return path_; }
  const std::string& temporary() const { return temporary_; }

  /// Puts it in place. Throws std::runtime_error.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  bool is_committed_ = false;
};

/// A stream into a PendingPath.
class AtomicFile {
 public:
  /// Throws std::runtime_error when the folder cannot be written to.
  explicit AtomicFile(const std::string& path);

  std::ostream& stream() { return stream_; }

  /// Puts the file in place. Throws std::runtime_error when something could not be written.
  void commit();

 private:
  PendingPath pending_;
  std::ofstream stream_;
};

}  // namespace nvm::io
