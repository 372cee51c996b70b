// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <string_view>

namespace nvm::io {

/// Whether ROS 1 bags may be compressed in this way, but nvm was built without the library for it
/// (CMake option NVM_WITH_BAG_COMPRESSION).
bool is_built_without(std::string_view compression);

/// Expands `bytes`, compressed as a ROS 1 bag names it ("bz2", "lz4": a frame of any writer), to at
/// most `max_size` bytes; what a truncated or damaged end left whole. Throws std::runtime_error for
/// another compression.
std::string decompress(std::string_view compression, std::string_view bytes, std::size_t max_size);

}  // namespace nvm::io
