// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>

namespace nvm::test {

/// Calls `read` with `bytes` cut at every length (a sample of `limit` lengths for longer ones) and
/// with `limit` sets of changed bytes: std::runtime_error is the only exception let by.
inline void read_damaged(
    const std::string& bytes,
    std::mt19937_64& rng,
    const std::function<void(const std::string&)>& read,
    std::size_t limit = 1000) {
  const auto attempt = [&](const std::string& damaged) {
    try {
      read(damaged);
    } catch (const std::runtime_error&) {
    }
  };
  const std::size_t step = bytes.size() / limit + 1;
  for (std::size_t size = 0; size < bytes.size(); size += step) {
    attempt(bytes.substr(0, size));
  }
  for (std::size_t i = 0; i < limit; ++i) {
    std::string damaged = bytes;
    for (std::size_t change = 0; change <= i % 4; ++change) {
      damaged[rng() % damaged.size()] = static_cast<char>(rng());
    }
    attempt(damaged);
  }
}

}  // namespace nvm::test
