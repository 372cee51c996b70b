// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

/// What each file *_target.cpp defines. It must come back for any bytes; whatever else happens is a
/// finding. libFuzzer calls it (`make fuzz`), and replay.cpp with the kept inputs of
/// tests/fuzz/corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nvm::fuzz {

/// Ends the process, which is a finding, unless `holds`.
inline void require(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
  }
}

/// Does `action`, which may refuse its input by a std::runtime_error or std::invalid_argument that
/// says something. Whether it did not refuse.
template <class Action>
bool accepts(const Action& action) {
  try {
    action();
    return true;
  } catch (const std::runtime_error& error) {
    require(*error.what() != '\0', "an error says what is wrong");
  } catch (const std::invalid_argument& error) {
    require(*error.what() != '\0', "an error says what is wrong");
  }
  return false;
}

/// An input, taken from its front; zeros where it has ended.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }

  template <class T>
  T take() {
    T value{};
    const std::size_t count = left_ < sizeof value ? left_ : sizeof value;
    if (count > 0) {
      std::memcpy(&value, data_, count);
      data_ += count;
      left_ -= count;
    }
    return value;
  }

  /// A whole number from 0 to `end` - 1.
  int below(int end) { return take<std::uint8_t>() % end; }

  std::string take_text(std::size_t size) {
    size = left_ < size ? left_ : size;
    std::string text(reinterpret_cast<const char*>(data_), size);
    data_ += size;
    left_ -= size;
    return text;
  }
  std::string rest() { return take_text(left_); }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// A folder for the files of one process, in memory where the system has such a place.
class Folder {
 public:
  Folder() {
    const bool has_memory = std::filesystem::is_directory("/dev/shm");
    path_ =
        (has_memory ? std::string("/dev/shm") : std::filesystem::temp_directory_path().string()) +
        "/nvm_fuzz_XXXXXX";
    require(::mkdtemp(path_.data()) != nullptr, "a temporary folder can be made");
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::string path_;
};

/// The one of this process.
inline const Folder& folder() {
  static const Folder folder;
  return folder;
}

}  // namespace nvm::fuzz
