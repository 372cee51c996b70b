// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

namespace nvm::test {

/// A simple LZF encoder: the longest match by brute force, so that copies of all kinds appear.
inline std::string lzf_compress(const std::string& data) {
  std::string output;
  std::string literals;
  const auto flush = [&] {
    for (std::size_t at = 0; at < literals.size(); at += 32) {
      const std::string run = literals.substr(at, 32);
      output += static_cast<char>(run.size() - 1) + run;
    }
    literals.clear();
  };
  for (std::size_t at = 0; at < data.size();) {
    std::size_t best_length = 0;
    std::size_t best_distance = 0;
    for (std::size_t distance = 1; distance <= std::min<std::size_t>(at, 8192); ++distance) {
      std::size_t length = 0;
      while (length < 264 && at + length < data.size() &&
             data[at + length] == data[at + length - distance]) {
        ++length;
      }
      if (length > best_length) {
        best_length = length;
        best_distance = distance;
      }
    }
    if (best_length < 3) {
      literals += data[at++];
      continue;
    }
    flush();
    const std::size_t code = best_length - 2;
    const std::size_t offset = best_distance - 1;
    output += static_cast<char>((std::min<std::size_t>(code, 7) << 5) | (offset >> 8));
    if (code >= 7) {
      output += static_cast<char>(code - 7);
    }
    output += static_cast<char>(offset & 255);
    at += best_length;
  }
  flush();
  return output;
}

}  // namespace nvm::test
