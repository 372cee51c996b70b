// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// A bag of any bytes is refused, or gives scans and IMU samples in order of time.
#include "fuzz_target.hpp"
#include "sequence_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nvm::fuzz::Input input(data, size);
  const std::string path = nvm::fuzz::folder().write("fuzzed.bag", input.rest());
  nvm::fuzz::accepts([&] { nvm::fuzz::read_all(*nvm::io::open_sequence(path)); });
  std::filesystem::remove(path);
  return 0;
}
