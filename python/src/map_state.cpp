// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "map_state.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nvm/map/serialization.hpp"

namespace nvm::python {

namespace {

namespace nb = nanobind;

nb::bytes archived(const SharedMap& self) {
  const auto bytes = self.read([](const VoxelMap& map) { return MapArchive::write(map); });
  return nb::bytes(bytes.data(), bytes.size());
}

[[noreturn]] void refuse(const std::string& problem) {
  throw nb::value_error(("nvm: the state of a map " + problem).c_str());
}

void restore_archive(SharedMap* self, const nb::bytes& archive) {
  const auto* begin = static_cast<const std::uint8_t*>(archive.data());
  const std::vector<std::uint8_t> bytes(begin, begin + archive.size());
  try {
    const nb::gil_scoped_release no_gil;
    new (self) SharedMap(MapArchive::read(bytes));
  } catch (const std::runtime_error& error) {
    refuse(error.what());
  }
}

/// In the __dict__ and the __slots__ of a subclass.
nb::dict attributes_of(nb::handle map) {
  nb::dict found;
  if (nb::hasattr(map, "__dict__")) {
    found.update(nb::cast<nb::dict>(map.attr("__dict__")));
  }
  for (nb::handle slot : nb::module_::import_("copyreg").attr("_slotnames")(map.type())) {
    if (nb::hasattr(map, slot)) {
      found[slot] = nb::getattr(map, slot);
    }
  }
  return found;
}

}  // namespace

nb::object state_of(nb::handle map) {
  if (!nb::isinstance<SharedMap>(map)) {
    throw nb::type_error("nvm: this is no VoxelMap");
  }
  if (!nb::inst_ready(map)) {
    throw std::runtime_error("nvm: a map has no state before its __init__ has run");
  }
  nb::bytes archive = archived(nb::cast<const SharedMap&>(map));
  nb::dict attributes = attributes_of(map);
  if (attributes.size() == 0) {
    return std::move(archive);
  }
  return nb::make_tuple(archive, attributes);
}

void restore(nb::pointer_and_handle<SharedMap> self, nb::handle state) {
  constexpr const char* kForms = "must be bytes, or a pair of bytes and a dict of attributes";
  nb::object archive = nb::borrow(state);
  nb::object attributes = nb::dict();
  if (nb::isinstance<nb::tuple>(state)) {
    if (nb::len(state) != 2) {
      refuse(kForms);
    }
    archive = state[0];
    attributes = state[1];
  }
  if (!nb::isinstance<nb::bytes>(archive) || !nb::isinstance<nb::dict>(attributes)) {
    refuse(kForms);
  }
  try {
    for (const auto& [name, value] : nb::borrow<nb::dict>(attributes)) {
      nb::setattr(self.h, name, value);
    }
  } catch (const nb::python_error& error) {
    refuse(std::string("has attributes that cannot be set: ") + nb::str(error.value()).c_str());
  }
  restore_archive(self.p, nb::borrow<nb::bytes>(archive));  // last: what fails must own nothing
}

}  // namespace nvm::python
