// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/csv_reader.hpp"

#include <algorithm>
#include <utility>

#include "config/value.hpp"
#include "io/file/file.hpp"

namespace nvm::io {

CsvReader::CsvReader(const std::string& path, const std::vector<std::string_view>& columns)
    : lines_(path) {
  const auto first = lines_.next();
  if (!first) {
    io::fail(path, "is empty");
  }
  const bool has_names = !config::parse_number(first->front());
  const std::vector<std::string_view>& names = has_names ? *first : columns;
  width_ = names.size();
  for (const std::string_view column : columns) {
    const auto found = std::find(names.begin(), names.end(), column);
    if (found == names.end()) {
      lines_.fail("has no column '" + std::string(column) + "'");
    }
    order_.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  if (!has_names) {
    unread_ = first;
  }
}

std::optional<std::vector<std::string_view>> CsvReader::next() {
  const auto words = unread_ ? std::exchange(unread_, std::nullopt) : lines_.next();
  if (!words) {
    return std::nullopt;
  }
  if (words->size() != width_) {
    lines_.fail(
        "has " + std::to_string(words->size()) + " values instead of " + std::to_string(width_));
  }
  std::vector<std::string_view> cells;
  for (const std::size_t index : order_) {
    cells.push_back((*words)[index]);
  }
  return cells;
}

}  // namespace nvm::io
