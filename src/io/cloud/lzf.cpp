// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/cloud/lzf.hpp"

#include <cstdint>

namespace nvm::io {

// A control byte c begins each run. c < 32: c + 1 literal bytes follow. Otherwise a copy from the
// output so far: its length is (c >> 5) + 2, where 7 in place of c >> 5 means that the next byte is
// added; its distance is the low five bits of c, then one more byte, plus 1.
std::optional<std::string> lzf_decompress(std::string_view compressed, std::size_t size) {
  if (size / kMaxLzfRatio > compressed.size()) {
    return std::nullopt;
  }
  std::string output;
  output.reserve(size);
  std::size_t at = 0;
  const auto has = [&](std::size_t count) { return compressed.size() - at >= count; };
  const auto next = [&] { return static_cast<std::size_t>(std::uint8_t(compressed[at++])); };
  while (has(1)) {
    const std::size_t control = next();
    const bool is_literal = control < 32;
    if (!has(is_literal ? control + 1 : (control >> 5) == 7 ? 2 : 1)) {
      return std::nullopt;
    }
    if (is_literal) {
      output.append(compressed.substr(at, control + 1));
      at += control + 1;
    } else {
      const std::size_t length = (control >> 5) + ((control >> 5) == 7 ? next() : 0) + 2;
      const std::size_t distance = ((control & 31) << 8) + next() + 1;
      if (distance > output.size()) {
        return std::nullopt;
      }
      for (std::size_t i = 0; i < length; ++i) {  // byte by byte: the copy may overlap itself
        output.push_back(output[output.size() - distance]);
      }
    }
    if (output.size() > size) {
      return std::nullopt;
    }
  }
  return output.size() == size ? std::optional(std::move(output)) : std::nullopt;
}

}  // namespace nvm::io
