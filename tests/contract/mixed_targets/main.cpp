// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Units for two instruction sets in one program, each of which must run its own code. Prints a hash
// of what the plain unit does: map and normals, or with "map" the map alone, which is for
// processors that know no other instructions. With "both" the maps of the two units must be equal.
#include <cstdio>
#include <cstring>

#include "contract/mixed_targets/work.hpp"

namespace {

std::uint32_t hash(const nvm::test::Work& work) {
  std::uint32_t hash = nvm::detail::crc32(work.map.data(), work.map.size());
  for (const Eigen::Vector3f& normal : work.normals) {
    unsigned char bytes[3 * sizeof(float)];
    std::memcpy(bytes, normal.data(), sizeof(bytes));
    hash = 31 * hash + nvm::detail::crc32(bytes, sizeof(bytes));
  }
  return hash;
}

}  // namespace

int main(int argc, char** argv) {
  const bool only_map = argc > 1 && std::strcmp(argv[1], "map") == 0;
  const bool both = argc > 1 && std::strcmp(argv[1], "both") == 0;
  nvm::VoxelMap shared;
  const nvm::test::Work plain = nvm::test::plain_work(shared, !only_map);
  std::size_t valid = 0;
  for (const Eigen::Vector3f& normal : plain.normals) {
    valid += normal.isZero() ? 0U : 1U;
  }
  bool ok = plain.neighbors > 10'000 && (only_map || valid > 500);
  if (both) {
    const nvm::test::Work avx2 = nvm::test::avx2_work(shared, true);
    ok = ok && avx2.map == plain.map && avx2.normals.size() == plain.normals.size();
  }
  std::printf("%08x %zu neighbours\n", hash(plain), plain.neighbors);
  return ok ? 0 : 1;
}
