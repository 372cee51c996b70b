// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/pending_path.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <random>
#include <string_view>
#include <system_error>

#include "io/file/file.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".part-";
constexpr std::size_t kLetters = 8;

std::string random_letters() {
  constexpr std::string_view kAlphabet = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string letters;
  for (std::size_t i = 0; i < kLetters; ++i) {
    letters += kAlphabet[random() % kAlphabet.size()];
  }
  return letters;
}

/// Makes an empty file or folder; false when there is one already.
bool make(const std::string& path, PendingPath::Kind kind) {
  constexpr mode_t kFileMode = 0666;  // less the user's mask, as any other program's files
  constexpr mode_t kFolderMode = 0777;
  if (kind == PendingPath::Kind::kFolder) {
    return ::mkdir(path.c_str(), kFolderMode) == 0;
  }
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kFileMode);
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  return descriptor >= 0;
}

int open_to_read_only(const std::string& path) {
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

bool is_temporary_of(std::string_view name, std::string_view temporary) {
  if (temporary.size() != name.size() + kMark.size() + kLetters ||
      temporary.substr(0, name.size()) != name ||
      temporary.substr(name.size(), kMark.size()) != kMark) {
    return false;
  }
  const std::string_view letters = temporary.substr(name.size() + kMark.size());
  return std::all_of(letters.begin(), letters.end(), [](unsigned char c) {
    return std::isdigit(c) != 0 || std::islower(c) != 0;
  });
}

/// Whether nobody holds it; not so where the file system knows no locks.
bool is_abandoned(const std::string& path) {
  const int descriptor = open_to_read_only(path);
  if (descriptor < 0) {
    return false;
  }
  const bool is_free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  ::close(descriptor);
  return is_free;
}

/// Puts a file, or a folder with all that is in it, on the disk.
void flush_all(const std::string& path) {
  std::error_code is_file;
  for (fs::recursive_directory_iterator entry(path, is_file), end; entry != end; ++entry) {
    flush_to_disk(entry->path().string());
  }
  flush_to_disk(path);
}

/// `path` without a slash at its end, which would put the temporary name inside.
std::string trimmed(std::string path) {
  while (path.size() > 1 && path.back() == '/') {
    path.pop_back();
  }
  return path;
}

}  // namespace

PathLock::PathLock(const std::string& path) : descriptor_(open_to_read_only(path)) {
  if (descriptor_ >= 0) {
    ::flock(descriptor_, LOCK_EX);
  }
}

PathLock::~PathLock() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

PendingPath::PendingPath(const std::string& path, Kind kind) : path_(trimmed(path)) {
  if (kind == Kind::kFolder) {
    std::error_code error;
    fs::create_directories(folder_of(path_), error);
    if (error) {
      fail(folder_of(path_).string(), "cannot be made: " + error.message());
    }
  }
  for (bool is_made = false; !is_made;) {
    temporary_ = path_ + std::string(kMark) + random_letters();
    is_made = make(temporary_, kind);
    if (!is_made && errno != EEXIST) {
      fail(path_, "cannot be written: " + std::generic_category().message(errno));
    }
  }
  lock_.emplace(temporary_);
}

PendingPath::~PendingPath() {
  if (!is_committed_) {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  }
}

void PendingPath::commit() {
  flush_all(temporary_);
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) {
    fail(path_, "cannot be written: " + error.message());
  }
  is_committed_ = true;
  flush_to_disk(folder_of(path_).string());
}

AtomicFile::AtomicFile(const std::string& path)
    : pending_(path, PendingPath::Kind::kFile), stream_(pending_.temporary(), std::ios::binary) {}

void AtomicFile::commit() {
  stream_.close();
  if (!stream_) {
    fail(
        pending_.path(),
        "cannot be written" +
            (errno == 0 ? "; is the disk full?" : ": " + std::generic_category().message(errno)));
  }
  pending_.commit();
}

std::vector<std::string> leftovers_of(const std::string& path) {
  const fs::path own(trimmed(path));
  std::vector<std::string> leftovers;
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(own), error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_temporary_of(own.filename().string(), entry->path().filename().string()) &&
        is_abandoned(entry->path().string())) {
      leftovers.push_back(entry->path().string());
    }
  }
  std::sort(leftovers.begin(), leftovers.end());
  return leftovers;
}

void flush_to_disk(const std::string& path) {
  const int descriptor = open_to_read_only(path);
  const bool is_flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
  // Some file systems cannot flush a folder, and say so.
  const int problem = is_flushed || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  if (problem != 0) {
    fail(path, "cannot be written: " + std::generic_category().message(problem));
  }
}

}  // namespace nvm::io
