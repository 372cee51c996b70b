// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/natural_order.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace nvm::io {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

namespace {

/// Cuts the first run of digits, without leading zeros, or the first other character off `text`.
std::string_view take_part(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) {
    ++end;
  }
  std::string_view part = text.substr(0, std::max<std::size_t>(end, 1));
  text.remove_prefix(part.size());
  while (part.size() > 1 && part[0] == '0') {
    part.remove_prefix(1);
  }
  return part;
}

/// Whether part `a` comes before `b`: of two numbers, the one with fewer digits.
bool precedes(std::string_view a, std::string_view b) {
  const bool are_numbers = is_digit(a[0]) && is_digit(b[0]);
  return are_numbers && a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace

bool precedes_naturally(const std::string& a, const std::string& b) {
  std::string_view rest_a = a;
  std::string_view rest_b = b;
  while (!rest_a.empty() && !rest_b.empty()) {
    const std::string_view part_a = take_part(rest_a);
    const std::string_view part_b = take_part(rest_b);
    if (part_a != part_b) {
      return precedes(part_a, part_b);
    }
  }
  return rest_a.empty() != rest_b.empty() ? rest_a.empty() : a < b;
}

}  // namespace nvm::io
