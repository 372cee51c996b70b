// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// A scan or map of any bytes is refused, or read: as a scan in order of time, and as a map that can
// be written and read again.
#include <array>

#include "fuzz_target.hpp"
#include "io/result/map_cloud.hpp"
#include "sequence_check.hpp"

namespace {

constexpr std::array<const char*, 3> kNames{"scan.ply", "scan.pcd", "scan.bin"};

void read_map(const std::string& path) {
  const nvm::io::MapCloud cloud = nvm::io::read_map_cloud(path);
  const std::string copy = nvm::fuzz::folder().path("copy.ply");
  nvm::io::write_map_cloud(copy, cloud);
  const nvm::io::MapCloud again = nvm::io::read_map_cloud(copy);
  nvm::fuzz::require(again.positions.size() == cloud.positions.size(), "a copy has all points");
  nvm::fuzz::require(again.sides == cloud.sides, "a copy has the same sides");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nvm::fuzz::Input input(data, size);
  const std::string name = kNames[static_cast<std::size_t>(input.below(3))];
  const std::string path = nvm::fuzz::folder().write(name, input.rest());
  nvm::fuzz::accepts([&] { nvm::fuzz::read_all(*nvm::io::open_sequence(path)); });
  nvm::fuzz::accepts([&] { read_map(path); });
  std::filesystem::remove(path);
  return 0;
}
