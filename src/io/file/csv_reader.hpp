// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/line_reader.hpp"

namespace nvm::io {

/// A table of comma-separated values, one row at a time.
class CsvReader {
 public:
  /// The first line names the columns, in any order and with others among them; a table that begins
  /// with a number has exactly `columns`. Throws std::runtime_error, naming the file, when it
  /// cannot be read or lacks a column.
  CsvReader(const std::string& path, const std::vector<std::string_view>& columns);

  /// The cells of the next row in the order of `columns`, valid until the next call; nothing at the
  /// end. Throws std::runtime_error when the row has another number of cells than the first line.
  std::optional<std::vector<std::string_view>> next();

  /// The line that next() gave, for numbers and errors.
  const LineReader& line() const { return lines_; }

 private:
  LineReader lines_;
  std::size_t width_ = 0;
  std::vector<std::size_t> order_;  ///< where in a line each of the columns stands
  std::optional<std::vector<std::string_view>> unread_;  ///< a first line that is a row
};

}  // namespace nvm::io
