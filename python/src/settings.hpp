// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

namespace nvm::python {

/// Settings as config::Schema reads them: YAML has JSON within it.
inline std::string as_json(nanobind::handle settings) {
  using namespace nanobind::literals;
  const nanobind::object number =
      nanobind::module_::import_("builtins").attr("float");  // of numpy's numbers
  return nanobind::cast<std::string>(
      nanobind::module_::import_("json").attr("dumps")(settings, "default"_a = number));
}

}  // namespace nvm::python
