// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/file.hpp"

#include <cctype>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace nvm::io {
namespace {

/// What the system says of the call that failed last.
std::string last_error() { return std::generic_category().message(errno); }

}  // namespace

void fail(const std::string& path, const std::string& problem) {
  throw std::runtime_error(path + ": " + problem);
}

std::ifstream open_to_read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    fail(path, "cannot be read: " + last_error());
  }
  if (std::filesystem::is_directory(path)) {
    fail(path, "cannot be read: is a folder");
  }
  return file;
}

std::string read_file(const std::string& path) {
  std::ifstream file = open_to_read(path);
  std::string bytes(std::filesystem::file_size(path), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    fail(path, "cannot be read to its end");
  }
  return bytes;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

std::string quote(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string quoted = "'";
  for (const char c : text.substr(0, kMaxLength)) {
    quoted += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  }
  return quoted + (text.size() > kMaxLength ? "...'" : "'");
}

}  // namespace nvm::io
