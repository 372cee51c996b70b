// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nvm::io {

/// The bytes of a file, of which only the pages that are looked at are read.
class MappedFile {
 public:
  /// Throws std::runtime_error when the file cannot be read.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_ = nullptr;  ///< null when the file is empty
  std::size_t size_ = 0;
};

}  // namespace nvm::io
