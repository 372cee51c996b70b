// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/pending_files.hpp"

#include <filesystem>
#include <vector>

#include "io/file/file.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

/// `path`, which can be that of a file.
const std::string& checked(const std::string& path) {
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder)) {
    fail(path, "cannot be written: there is no folder " + folder.string() + "; make it first");
  }
  if (fs::is_directory(path)) {
    fail(path, "cannot be written: is a folder; give another name");
  }
  return path;
}

}  // namespace

PendingFiles::PendingFiles(const std::string& path)
    : path_(checked(path)), folder_(path, PendingPath::Kind::kFolder) {}

std::string PendingFiles::temporary() const {
  return (fs::path(folder_.temporary()) / fs::path(path_).filename()).string();
}

void PendingFiles::commit() {
  std::vector<std::string> others;
  for (const auto& entry : fs::directory_iterator(folder_.temporary())) {
    const std::string name = entry.path().filename().string();
    flush_to_disk(entry.path().string());
    if (name != fs::path(path_).filename()) {
      checked((folder_of(path_) / name).string());
      others.push_back(name);
    }
  }
  fs::remove(path_);
  for (const std::string& name : others) {
    fs::rename(fs::path(folder_.temporary()) / name, folder_of(path_) / name);
  }
  fs::rename(temporary(), path_);
  flush_to_disk(folder_of(path_).string());
}

}  // namespace nvm::io
