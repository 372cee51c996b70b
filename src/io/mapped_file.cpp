// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>

#include "io/file.hpp"

namespace nvm::io {

MappedFile::MappedFile(const std::string& path) {
  open_to_read(path);  // throws what is wrong
  size_ = std::filesystem::file_size(path);
  if (size_ == 0) {
    return;
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
  ::close(file);
  if (data_ == MAP_FAILED) {
    fail(path, "cannot be read");
  }
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) {
    ::munmap(data_, size_);
  }
}

}  // namespace nvm::io
