// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>

namespace nvm::test {

/// A generator seeded from the running test's full name: each test has its own numbers, the same in
/// every run.
inline std::mt19937_64 rng() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : std::string(info->test_suite_name()) + "." + info->name()) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return std::mt19937_64(hash);
}

}  // namespace nvm::test
