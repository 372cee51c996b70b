// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <fstream>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace nvm::io {

/// Held on a file or folder for as long as it lives, by one process at a time; by none where the
/// file system knows no locks. Waits for its turn.
class PathLock {
 public:
  explicit PathLock(const std::string& path);
  ~PathLock();
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;

 private:
  int descriptor_;
};

/// A file or folder that is made under a temporary name of its own beside the final one, and
/// appears under the final one when it is complete and on the disk: commit() renames; without
/// commit() nothing is left. What a killed process leaves is found by leftovers_of().
class PendingPath {
 public:
  enum class Kind { kFile, kFolder };

  /// Makes it, empty, and the folders above a folder. Throws std::runtime_error.
  PendingPath(const std::string& path, Kind kind);
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
  std::optional<PathLock> lock_;  ///< tells others that this process lives
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

/// The temporary files and folders beside `path` that belong to it and that no process holds any
/// more, in order of their names.
std::vector<std::string> leftovers_of(const std::string& path);

/// Waits until the file `path`, or the names of what is in a folder, are on the disk. Throws
/// std::runtime_error.
void flush_to_disk(const std::string& path);

}  // namespace nvm::io
