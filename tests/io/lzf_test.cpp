// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/cloud/lzf.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>

#include "io/lzf_compress.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

TEST(Lzf, ExpandsWhatIsCompressed) {
  auto rng = test::rng();
  for (std::size_t alphabet = 1; alphabet <= 256; alphabet *= 4) {
    std::string data;
    const std::size_t size = rng() % 3000;
    while (data.size() < size) {
      data += static_cast<char>(rng() % alphabet);
    }
    EXPECT_EQ(lzf_decompress(test::lzf_compress(data), data.size()), data);
    EXPECT_EQ(lzf_decompress(test::lzf_compress(data), data.size() + 1), std::nullopt);
  }
  EXPECT_EQ(lzf_decompress("", 0), "");
}

TEST(Lzf, RefusesWhatCannotBe) {
  EXPECT_EQ(lzf_decompress(std::string(2, '\0'), std::size_t{1} << 40), std::nullopt);
  EXPECT_EQ(lzf_decompress("\x20\x05", 3), std::nullopt);  // copies from before the begin
  EXPECT_EQ(lzf_decompress("\x05xx", 6), std::nullopt);    // literals cut off
}

}  // namespace
}  // namespace nvm::io
