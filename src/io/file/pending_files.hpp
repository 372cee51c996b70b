// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "io/file/pending_path.hpp"

namespace nvm::io {

/// A file and others that belong to it, in one folder that exists: made in a temporary folder
/// there, from which commit() takes them; without commit() nothing is left. What a killed process
/// leaves is found by leftovers_of().
class PendingFiles {
 public:
  /// For `path` and what belongs to it. Throws std::runtime_error when nothing can be written
  /// there.
  explicit PendingFiles(const std::string& path);

  /// Where to write the file itself; the others go beside it, under names of their own.
  std::string temporary() const;

  /// Puts all in place, the file itself last; an older one is removed first, so that it never lies
  /// beside what belongs to another. Throws std::runtime_error.
  void commit();

 private:
  std::string path_;
  PendingPath folder_;
};

}  // namespace nvm::io
