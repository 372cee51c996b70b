// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "io/file/pending_path.hpp"

namespace nvm::io {

/// The folder in which a run puts its results, all of them or none: they are made in a folder
/// within it, nvm-results.part-…, and replace those of an older run together. A process that is
/// killed before publish() leaves the old results and that folder; one that is killed within it
/// leaves what the next ResultFolder completes. Never do results of two runs lie side by side.
class ResultFolder {
 public:
  /// Makes `folder` unless it exists, completes what a killed process had begun to put in place,
  /// and finds what others left unfinished. Throws std::runtime_error when that cannot be.
  explicit ResultFolder(const std::string& folder);

  /// Where to write the results, each under its own name.
  const std::string& path() const { return pending_.temporary(); }

  /// Folders of runs that were killed, whose files are whole up to their last frame; publish()
  /// removes them.
  const std::vector<std::string>& unfinished() const { return unfinished_; }

  /// Puts the results in place. Those of an older run that this one does not have are removed.
  /// Throws std::runtime_error.
  void publish();

 private:
  std::string folder_;
  std::vector<std::string> unfinished_;
  PendingPath pending_;
};

}  // namespace nvm::io
