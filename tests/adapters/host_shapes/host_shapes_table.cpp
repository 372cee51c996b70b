// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Prints what the host-shaped odometries make of a sequence with a truth, with the hosts' own maps
// and with nvm's: nvm_host_shapes SEQUENCE [FILTER_SIZE]
#include <cstdlib>
#include <exception>
#include <iostream>

#include "adapters/host_shapes/host_run.hpp"

int main(int argc, char** argv) {
  using namespace nvm::test;
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: " << argv[0] << " SEQUENCE [FILTER_SIZE]\n";
    return 2;
  }
  try {
    for (const HostFamily family :
         {HostFamily::kFastLio, HostFamily::kFasterLio, HostFamily::kCtLio}) {
      HostShape shape = shape_of(family);
      if (argc == 3 && family != HostFamily::kCtLio) {
        shape.filter_size = std::atof(argv[2]);
      }
      for (const HostMapKind kind :
           {HostMapKind::kOwn, HostMapKind::kPatchA, HostMapKind::kPatchB}) {
        std::cout << name(family) << ' ' << name(kind) << ": "
                  << describe(run_host(argv[1], shape, kind)) << std::endl;
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
