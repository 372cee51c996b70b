// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/decompress.hpp"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <stdexcept>

namespace nvm::io {
namespace {

/// Makes room as it is needed: what a file says of its size may be wrong.
constexpr std::size_t kStep = 1U << 20;

std::string expand_bz2(std::string_view bytes, std::size_t max_size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) {
    throw std::runtime_error("cannot be expanded: out of memory");
  }
  std::string in(bytes);
  stream.next_in = in.data();
  stream.avail_in = static_cast<unsigned>(in.size());
  std::string out;
  int status = BZ_OK;
  while (status == BZ_OK && out.size() < max_size) {
    const std::size_t size = out.size();
    out.resize(std::min(size + kStep, max_size));
    stream.next_out = out.data() + size;
    stream.avail_out = static_cast<unsigned>(out.size() - size);
    status = BZ2_bzDecompress(&stream);
    const std::size_t got = out.size() - size - stream.avail_out;
    out.resize(size + got);
    if (got == 0 && stream.avail_in == 0) {
      break;
    }
  }
  BZ2_bzDecompressEnd(&stream);
  return out;
}

std::string expand_lz4(std::string_view bytes, std::size_t max_size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0U) {
    throw std::runtime_error("cannot be expanded: out of memory");
  }
  std::string out;
  while (!bytes.empty() && out.size() < max_size) {
    const std::size_t size = out.size();
    out.resize(std::min(size + kStep, max_size));
    std::size_t got = out.size() - size;
    std::size_t taken = bytes.size();
    const std::size_t status =
        LZ4F_decompress(context, out.data() + size, &got, bytes.data(), &taken, nullptr);
    const bool is_error = LZ4F_isError(status) != 0U;
    out.resize(is_error ? size : size + got);
    bytes.remove_prefix(is_error ? 0 : taken);
    if (is_error || status == 0 || (got == 0 && taken == 0)) {
      break;
    }
  }
  LZ4F_freeDecompressionContext(context);
  return out;
}

}  // namespace

bool is_built_without(std::string_view /*compression*/) { return false; }

std::string decompress(std::string_view compression, std::string_view bytes, std::size_t max_size) {
  if (compression == "bz2") {
    return expand_bz2(bytes, max_size);
  }
  if (compression == "lz4") {
    return expand_lz4(bytes, max_size);
  }
  throw std::runtime_error("is compressed in an unknown way: " + std::string(compression));
}

}  // namespace nvm::io
