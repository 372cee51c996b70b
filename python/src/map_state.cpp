// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "map_state.hpp"

#include <nanobind/stl/pair.h>

#include <cstdint>
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

void restore_archive(SharedMap* self, const nb::bytes& archive) {
  const auto* begin = static_cast<const std::uint8_t*>(archive.data());
  const std::vector<std::uint8_t> bytes(begin, begin + archive.size());
  const nb::gil_scoped_release no_gil;
  new (self) SharedMap(MapArchive::read(bytes));
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
  nb::bytes archive = archived(nb::cast<const SharedMap&>(map));
  nb::dict attributes = attributes_of(map);
  if (attributes.size() == 0) {
    return std::move(archive);
  }
  return nb::make_tuple(archive, attributes);
}

void restore(nb::pointer_and_handle<SharedMap> self, nb::handle state) {
  if (!nb::isinstance<nb::tuple>(state)) {
    restore_archive(self.p, nb::cast<nb::bytes>(state));
    return;
  }
  const auto [archive, attributes] = nb::cast<std::pair<nb::bytes, nb::dict>>(state);
  restore_archive(self.p, archive);
  for (const auto& [name, value] : attributes) {
    nb::setattr(self.h, name, value);
  }
}

}  // namespace nvm::python
