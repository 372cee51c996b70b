// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/line_reader.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "config/value.hpp"
#include "io/file/file.hpp"

namespace nvm::io {

std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view kSeparators = " \t\r\n,;";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos) {
    const std::size_t end = line.find_first_of(kSeparators, begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, end);
  }
  return words;
}

std::optional<std::size_t> parse_whole_number(std::string_view word) {
  std::size_t number = 0;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

LineReader::LineReader(const std::string& path) : path_(path), file_(open_to_read(path)) {}

std::optional<std::vector<std::string_view>> LineReader::next() {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of spreadsheets
  while (std::getline(file_, line_)) {
    if (line_number_++ == 0 && line_.rfind(kByteOrderMark, 0) == 0) {
      line_.erase(0, kByteOrderMark.size());
    }
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
    fail(quote(word) + " is not a finite number");
  }
  return *number;
}

void LineReader::fail(const std::string& problem) const {
  io::fail(path_ + ":" + std::to_string(line_number_), problem);
}

}  // namespace nvm::io
