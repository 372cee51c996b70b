// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// A map file of any bytes is refused, or is a map that can be used and saved as the same file.
#include <array>
#include <vector>

#include "fuzz_target.hpp"
#include "map_audit.hpp"
#include "nvm/map/map_archive.hpp"

namespace {

using nvm::MapArchive;
using nvm::VoxelMap;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kLengthAt = 12;
constexpr std::size_t kBodyAt = 20;
constexpr std::size_t kCapacityAt = 28;
constexpr std::uint64_t kMostVoxels = 4096;  // since large maps take long

template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

Bytes header() {
  nvm::MapOptions options;
  options.capacity = 1;
  Bytes bytes = MapArchive::write(VoxelMap(options));
  bytes.resize(kBodyAt);
  return bytes;
}

/// A file whose length and checksum are right, since no fuzzer guesses them.
Bytes file_with_body(std::uint32_t version, const std::string& body) {
  static const Bytes kHeader = header();
  Bytes bytes = kHeader;
  put(bytes, kVersionAt, version);
  put(bytes, kLengthAt, static_cast<std::uint64_t>(body.size()));
  bytes.insert(bytes.end(), body.begin(), body.end());
  if (body.size() >= 16) {
    std::uint64_t capacity = 0;
    std::memcpy(&capacity, bytes.data() + kCapacityAt, sizeof capacity);
    put(bytes, kCapacityAt, capacity % kMostVoxels);
  }
  const std::uint32_t checksum = nvm::detail::crc32(bytes.data(), bytes.size());
  bytes.resize(bytes.size() + sizeof checksum);
  put(bytes, bytes.size() - sizeof checksum, checksum);
  return bytes;
}

void use(VoxelMap& map) {
  nvm::fuzz::audit(map);
  const std::vector<Eigen::Vector3d> points{{0.1, 0.1, 0.1}, {1e3, -1e3, 0.0}};
  const std::vector<Eigen::Vector3f> normals(2, Eigen::Vector3f::UnitX());
  map.insert(points, normals);
  nvm::fuzz::audit(map);
  map.erase_within(Eigen::Vector3d::Zero(), 1e9);
  nvm::fuzz::audit(map);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nvm::fuzz::Input input(data, size);
  const auto version = 2U + input.take<std::uint8_t>() % 3U;
  const Bytes bytes = file_with_body(version, input.rest());
  nvm::fuzz::accepts([&] {
    VoxelMap map = MapArchive::read(bytes);
    const Bytes again = MapArchive::write(map);
    nvm::fuzz::require(version < 4 || again == bytes, "a map is saved as it was");
    nvm::fuzz::require(
        MapArchive::write(MapArchive::read(again)) == again, "a saved map loads as it is");
    use(map);
  });
  return 0;
}
