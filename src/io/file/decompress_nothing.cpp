// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
// In the place of decompress.cpp where nvm is built without libbz2 and liblz4.
#include <stdexcept>

#include "io/file/decompress.hpp"

namespace nvm::io {

bool is_built_without(std::string_view compression) {
  return compression == "bz2" || compression == "lz4";
}

std::string decompress(
    std::string_view compression, std::string_view /*bytes*/, std::size_t /*max_size*/) {
  throw std::runtime_error("cannot be expanded: " + std::string(compression));
}

}  // namespace nvm::io
