// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/line_reader.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "config/value.hpp"
#include "io/file.hpp"

namespace nvm::io {

std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view kSeparators = " \t\r\n,";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos) {
    const std::size_t end = line.find_first_of(kSeparators, begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, end);
  }
  return words;
}

LineReader::LineReader(const std::string& path) : path_(path), file_(path) {
  if (!file_ || std::filesystem::is_directory(path)) {
    io::fail(path, std::string("cannot be read: ") + std::strerror(file_ ? EISDIR : errno));
  }
}

std::optional<std::vector<std::string_view>> LineReader::next() {
  while (std::getline(file_, line_)) {
    ++line_number_;
    auto words = split(std::string_view(line_).substr(0, line_.find('#')));
    if (!words.empty()) {
      return words;
    }
  }
  return std::nullopt;
}

double LineReader::number(std::string_view word) const {
  const auto number = config::parse_number(word);
  if (!number || !std::isfinite(*number)) {
    fail("'" + std::string(word.substr(0, 40)) + "' is not a finite number");
  }
  return *number;
}

void LineReader::fail(const std::string& problem) const {
  io::fail(path_ + ":" + std::to_string(line_number_), problem);
}

}  // namespace nvm::io
