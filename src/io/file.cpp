// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file.hpp"

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace nvm::io {

void fail(const std::string& path, const std::string& problem) {
  throw std::runtime_error(path + ": " + problem);
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    fail(path, std::string("cannot be read: ") + std::strerror(file ? EISDIR : errno));
  }
  std::string bytes(std::filesystem::file_size(path), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    fail(path, "cannot be read to its end");
  }
  return bytes;
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

AtomicFile::AtomicFile(const std::string& path)
    : path_(path),
      temporary_(path + ".part" + std::to_string(::getpid())),
      stream_(temporary_, std::ios::binary) {
  if (!stream_) {
    fail(path, std::string("cannot be written: ") + std::strerror(errno));
  }
}

AtomicFile::~AtomicFile() {
  if (stream_.is_open()) {
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
}

void AtomicFile::commit() {
  if (!stream_.flush()) {
    fail(path_, std::string("cannot be written: ") + std::strerror(errno));
  }
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) {
    fail(path_, "cannot be written: " + error.message());
  }
  stream_.close();
}

}  // namespace nvm::io
