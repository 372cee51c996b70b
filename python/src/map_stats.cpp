// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>

#include "bind.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::python {

namespace {

constexpr char kInsertStatsDoc[] = R"(What became of the points of an insertion.

Attributes
----------
stored : int
too_close : int
    To a point of the same surface (min_point_distance); with max_merged_points they moved it.
surface_full : int
    points_per_surface was reached.
no_normal : int
    Zero, non-finite or not of unit length.
non_finite : int
    A coordinate was NaN or infinite.
out_of_range : int
    Beyond +-2**20 voxels.
map_full : int
    No room even after evicting every other voxel.
new_voxels, evicted_voxels, evicted_points : int)";

constexpr char kMapStatsDoc[] = R"(What a map holds.

Attributes
----------
points, voxels : int
two_sided_voxels : int
    Voxels that hold points of both faces.
surfaces : int
    Faces in voxels: one or two of each.
memory_bytes : int)";

/// "<nvm.MapStats: points 12, voxels 3>", without what is zero.
std::string counted(
    const char* name, std::initializer_list<std::pair<const char*, std::size_t>> counts) {
  std::string text;
  for (const auto& [what, count] : counts) {
    if (count > 0) {
      text += (text.empty() ? ": " : ", ") + std::string(what) + " " + std::to_string(count);
    }
  }
  return "<nvm." + std::string(name) + text + ">";
}

std::string described_insertion(const InsertStats& stats) {
  return counted(
      "InsertStats",
      {{"stored", stats.stored},
       {"too_close", stats.too_close},
       {"surface_full", stats.surface_full},
       {"no_normal", stats.no_normal},
       {"non_finite", stats.non_finite},
       {"out_of_range", stats.out_of_range},
       {"map_full", stats.map_full},
       {"new_voxels", stats.new_voxels},
       {"evicted_voxels", stats.evicted_voxels},
       {"evicted_points", stats.evicted_points}});
}

std::string described_map(const MapStats& stats) {
  return counted(
      "MapStats",
      {{"points", stats.points},
       {"voxels", stats.voxels},
       {"two_sided_voxels", stats.two_sided_voxels},
       {"surfaces", stats.surfaces},
       {"memory_bytes", stats.memory_bytes}});
}

}  // namespace

void bind_map_stats(nanobind::module_& module) {
  namespace nb = nanobind;
  nb::class_<InsertStats>(module, "InsertStats", kInsertStatsDoc)
      .def_ro("stored", &InsertStats::stored)
      .def_ro("too_close", &InsertStats::too_close)
      .def_ro("surface_full", &InsertStats::surface_full)
      .def_ro("no_normal", &InsertStats::no_normal)
      .def_ro("non_finite", &InsertStats::non_finite)
      .def_ro("out_of_range", &InsertStats::out_of_range)
      .def_ro("map_full", &InsertStats::map_full)
      .def_ro("new_voxels", &InsertStats::new_voxels)
      .def_ro("evicted_voxels", &InsertStats::evicted_voxels)
      .def_ro("evicted_points", &InsertStats::evicted_points)
      .def("__repr__", &described_insertion);
  nb::class_<MapStats>(module, "MapStats", kMapStatsDoc)
      .def_ro("points", &MapStats::points)
      .def_ro("voxels", &MapStats::voxels)
      .def_ro("two_sided_voxels", &MapStats::two_sided_voxels)
      .def_ro("surfaces", &MapStats::surfaces)
      .def_ro("memory_bytes", &MapStats::memory_bytes)
      .def("__repr__", &described_map);
}

}  // namespace nvm::python
