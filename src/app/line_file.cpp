// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/line_file.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/file/file.hpp"

namespace nvm::app {

namespace {

std::string last_error() { return std::generic_category().message(errno); }

}  // namespace

LineFile::LineFile(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
  if (!stream_) {
    io::fail(path_, "cannot be written: " + last_error());
  }
}

void LineFile::append(const std::string& lines) {
  if (stream_ << lines << std::flush) {
    size_ += lines.size();
    return;
  }
  const std::string problem = last_error();
  stream_.close();
  std::error_code ignored;
  std::filesystem::resize_file(path_, size_, ignored);
  io::fail(path_, "cannot be written: " + problem);
}

}  // namespace nvm::app
