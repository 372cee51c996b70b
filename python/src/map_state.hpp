// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>

#include "shared_map.hpp"

namespace nvm::python {

/// What pickle and copy keep of a map: the bytes of its file; of a subclass in Python that has
/// attributes of its own, a pair of the bytes and a dict of them. Throws std::runtime_error for a
/// map that was never made.
nanobind::object state_of(nanobind::handle map);

/// Makes a map of what state_of() gave. Throws ValueError for anything else.
void restore(nanobind::pointer_and_handle<SharedMap> self, nanobind::handle state);

}  // namespace nvm::python
