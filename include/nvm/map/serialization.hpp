// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

#include "nvm/core/target.hpp"
#include "nvm/map/map_archive.hpp"
#include "nvm/map/map_image.hpp"
#include "nvm/map/storage/image_file.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm {
inline namespace NVM_TARGET {}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

#if defined(__unix__) || defined(__APPLE__)
inline constexpr const char* kCreate = "wbx";  // refuses a file that exists
#else
inline constexpr const char* kCreate = "wb";
#endif

/// Opens a file beside `path` that nobody else writes to, and says which in `name`. Null when that
/// is impossible.
template <class = void>
File create_beside(const std::string& path, std::string& name) {
  constexpr int kMostLeftovers = 100;  // of programs that were killed while they wrote
  std::FILE* file = nullptr;
  for (int i = 0; i < kMostLeftovers && file == nullptr; ++i) {
    name = path + (i == 0 ? "" : "." + std::to_string(i)) + ".part";
    file = std::fopen(name.c_str(), kCreate);
  }
  return File(file);
}

/// Has the bytes reach the disk before whatever follows, where that can be asked for.
inline bool flush_to_disk(std::FILE* file) {
#if defined(__unix__) || defined(__APPLE__)
  return std::fflush(file) == 0 && fsync(fileno(file)) == 0;
#else
  return std::fflush(file) == 0;
#endif
}

/// Has `write(FILE*)`, which returns whether it succeeded, fill a file that takes the place of
/// `path` when it is whole and on the disk. Throws std::runtime_error, naming the path.
template <class Write>
void replace_file(const std::string& path, const Write& write) {
  std::string temporary;
  File file = create_beside(path, temporary);
  if (file.get() == nullptr) {
    throw std::runtime_error(path + ": cannot be written");
  }
  bool ok = write(file.get()) && flush_to_disk(file.get());
  ok = std::fclose(file.release()) == 0 && ok;
  if (!ok || std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove(temporary.c_str());
    throw std::runtime_error(path + ": cannot be written");
  }
}

/// Throws std::runtime_error unless the bytes of a map can be read back.
template <class = void>
void check_archive(const std::vector<std::uint8_t>& bytes, const std::string& path) {
  try {
    MapArchive::read(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": not written, because the map " + error.what());
  } catch (const std::bad_alloc&) {
    // No memory for a second map: better a map that nobody has checked than none.
  }
}

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {

/// Writes `map` to `path`: to a temporary file beside it first, and only once it is known that it
/// can be read back, so that no broken map is ever left there. Throws std::runtime_error, naming
/// the path, when it cannot be written.
template <class = void>
void save_map(const VoxelMap& map, const std::string& path) {
  const std::vector<std::uint8_t> bytes = MapArchive::write(map);
  detail::check_archive(bytes, path);
  detail::replace_file(path, [&bytes](std::FILE* file) {
    return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  });
}

/// Writes an image of `map` to `path`: the map as it lies in memory, for this build of nvm and
/// processors like this one. What is to be kept, or sent to others, is what save_map() writes.
/// Throws std::runtime_error, naming the path, when it cannot be written.
template <class = void>
void save_map_image(const VoxelMap& map, const std::string& path) {
  detail::replace_file(path, [&map](std::FILE* file) { return MapImage::write(map, file); });
}

/// The map that save_map() or save_map_image() wrote, bit by bit. An image is mapped into memory
/// instead of read: it is there in milliseconds, and all programs that load it share its pages.
/// What one of them changes, and the voxels that its queries mark as used, are its own; the file
/// never changes, and must not be cut off meanwhile (save_map_image() replaces it). Where files
/// cannot be mapped it is read. Throws std::runtime_error, naming the path and what is wrong, when
/// the file cannot be read, is truncated, corrupt or something else, or is an image of another
/// build or for another processor.
template <class = void>
VoxelMap load_map(const std::string& path) {
  try {
    const detail::ImageFile file(path);
    return MapImage::is_image(file) ? MapImage::read(file) : MapArchive::read(file.contents());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace NVM_TARGET
}  // namespace nvm
