// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace nvm::io {

/// Counts what was left out while reading, and remembers why the first one was.
class LeftOut {
 public:
  /// `what` in the plural, for the note.
  explicit LeftOut(std::string what) : what_(std::move(what)) {}

  void add(const std::string& reason) {
    if (count_++ == 0) {
      first_ = reason;
    }
  }

  std::size_t count() const { return count_; }

  /// For the user; nothing when nothing was left out.
  std::optional<std::string> note() const {
    return count_ == 0
               ? std::nullopt
               : std::optional(
                     std::to_string(count_) + " " + what_ + " left out; the first: " + first_);
  }

 private:
  std::string what_;
  std::size_t count_ = 0;
  std::string first_;
};

}  // namespace nvm::io
