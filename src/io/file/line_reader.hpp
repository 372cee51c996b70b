// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nvm::io {

/// The words of a line, parted by blanks, tabs or commas.
std::vector<std::string_view> split(std::string_view line);

/// The whole number of zero or more that all of `word` spells; nothing when it spells none.
std::optional<std::size_t> parse_whole_number(std::string_view word);

/// A text file, one line of words at a time; empty lines and what follows a '#' are left out.
class LineReader {
 public:
  /// Throws std::runtime_error when the file cannot be read.
  explicit LineReader(const std::string& path);

  /// The words of the next line, valid until the next call; none at the end.
  std::optional<std::vector<std::string_view>> next();

  /// The finite number that `word` of the present line spells. Throws std::runtime_error.
  double number(std::string_view word) const;

  /// Throws std::runtime_error "path:line: problem" for the present line.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::string line_;
  std::size_t line_number_ = 0;
};

}  // namespace nvm::io
