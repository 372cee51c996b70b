// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <nanobind/stl/string.h>

#include <string>

#include "bind.hpp"
#include "common/kept_memory.hpp"
#include "nvm/version.hpp"

NB_MODULE(_nvm, module) {
  module.doc() = "The compiled part of nvm.";
  module.attr("__version__") = std::to_string(NVM_VERSION_MAJOR) + "." +
                               std::to_string(NVM_VERSION_MINOR) + "." +
                               std::to_string(NVM_VERSION_PATCH);
  module.def(
      "keep_freed_memory",
      &nvm::keep_freed_memory,
      "Let this process keep up to 32 MiB that it freed, for a reader of large messages.");
  nvm::python::bind_voxel_map(module);
  nvm::python::bind_normals(module);
  nvm::python::bind_registration(module);
  nvm::python::bind_scan_stream(module);
  nvm::python::bind_odometry(module);
  nvm::python::bind_survey(module);
}
