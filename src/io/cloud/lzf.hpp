// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nvm::io {

/// LZF never makes data smaller than by this factor: 3 bytes stand for at most 264.
inline constexpr std::size_t kMaxLzfRatio = 88;

/// Expands LZF data (the format of LibLZF, used by compressed PCD files) to exactly `size` bytes;
/// nothing when the data is corrupt or of another size. Never allocates more than kMaxLzfRatio
/// times the size of `compressed`.
std::optional<std::string> lzf_decompress(std::string_view compressed, std::size_t size);

}  // namespace nvm::io
