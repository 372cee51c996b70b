// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "batch_query.hpp"
#include "bind.hpp"
#include "given_values.hpp"
#include "map_state.hpp"
#include "nvm/map/serialization.hpp"
#include "options.hpp"
#include "shared_map.hpp"
#include "threads.hpp"
#include "voxel_map_docs.hpp"

namespace nvm::python {

namespace {

using namespace nb::literals;

MapColumns columns_of(const SharedMap& self) {
  return self.read([](const VoxelMap& map) { return map.options().columns; });
}

InsertStats insert(
    SharedMap& self,
    nb::handle points,
    nb::handle normals,
    nb::handle T_map_scan,
    nb::handle intensity,
    nb::handle time,
    nb::handle color,
    nb::handle label) {
  const Vectors positions(points, "points");
  const Pose pose = pose_from(T_map_scan, "T_map_scan");
  const GivenValues values(intensity, time, color, label, columns_of(self), positions.size());
  if (normals.is_none()) {
    return self.write([&](VoxelMap& map) { return map.insert_unsided(positions, pose, values); });
  }
  const Vectors directions(normals, "normals");
  require_same_size(directions.size(), "normals", positions.size(), "points");
  return self.write([&](VoxelMap& map) { return map.insert(positions, directions, pose, values); });
}

nb::tuple nearest(
    const SharedMap& self,
    nb::handle points,
    nb::handle normals,
    const Integer& k,
    double max_distance,
    const Integer& rings,
    const Integer& threads) {
  constexpr std::size_t kWorthThreads = 4096;
  constexpr int kMostRings = 1 << 22;  // from one end of any map to the other
  const auto count = static_cast<std::size_t>(k.from("k", 1, kMaxNeighbors));
  require(max_distance >= 0.0, "max_distance", max_distance, "zero or more [m]");
  const Vectors positions(points, "points");
  std::optional<Vectors> directions;
  if (!normals.is_none()) {
    directions.emplace(normals, "normals");
    require_same_size(directions->size(), "normals", positions.size(), "points");
  }
  Answers answers = answer(
      self,
      positions,
      directions ? &*directions : nullptr,
      {count, max_distance, Gate::kSurfaces, static_cast<int>(rings.from("rings", 1, kMostRings))},
      make_executor(threads, positions.size(), kWorthThreads));
  return nb::make_tuple(
      to_array(std::move(answers.distances), positions.size(), count),
      to_array(std::move(answers.rows), positions.size(), count),
      to_array(std::move(answers.counts), positions.size()));
}

void require_radius(double radius) { require(radius >= 0.0, "radius", radius, "zero or more [m]"); }

Array<std::int64_t> within(const SharedMap& self, nb::handle center, double radius) {
  require_radius(radius);
  const Eigen::Vector3d middle = vector_from(center, "center");
  return to_array(self.read([&](const VoxelMap& map) {
    const auto rows = self.rows(map);
    std::vector<std::int64_t> found;
    map.for_each_within(middle, std::min(radius, 1e9), [&](const Neighbor& point) {
      found.push_back((*rows)[point.id]);
    });
    std::sort(found.begin(), found.end());
    return found;
  }));
}

Array<double> points_of(const SharedMap& self) {
  return to_array(
      self.read([](const VoxelMap& map) {
        std::vector<double> values;
        values.reserve(3 * map.size());
        SharedMap::for_each(map, [&](const Neighbor& point) {
          values.insert(values.end(), point.position.data(), point.position.data() + 3);
        });
        return values;
      }),
      3);
}

Array<float> normals_of(const SharedMap& self) {
  return to_array(self.read([](const VoxelMap& map) {
    std::vector<Eigen::Vector3f> normals;
    normals.reserve(map.size());
    SharedMap::for_each(map, [&](const Neighbor& p) { normals.push_back(map.normal(p.id)); });
    return normals;
  }));
}

Array<std::uint8_t> sides_of(const SharedMap& self) {
  return to_array(self.read([](const VoxelMap& map) {
    std::vector<std::uint8_t> sides;
    sides.reserve(map.size());
    SharedMap::for_each(map, [&](const Neighbor& point) {
      sides.push_back(static_cast<std::uint8_t>(map.side(point.id)));
    });
    return sides;
  }));
}

nb::object column_of(const SharedMap& self, const std::string& name) {
  const auto values = self.read([](const VoxelMap& map) {
    std::vector<PointValues> values;
    values.reserve(map.size());
    SharedMap::for_each(map, [&](const Neighbor& p) { values.push_back(map.values(p.id)); });
    return values;
  });
  return column_array(values, columns_of(self), name);
}

std::string described(const SharedMap& self) {
  const MapStats stats = self.read([](const VoxelMap& map) { return map.stats(); });
  return "<nvm.VoxelMap: " + std::to_string(stats.points) + " points in " +
         std::to_string(stats.voxels) + " voxels, " + std::to_string(stats.two_sided_voxels) +
         " of them with two sides>";
}

void bind_erasing(nb::class_<SharedMap>& map) {
  map.def(
         "erase_box",
         [](SharedMap& self, nb::handle min, nb::handle max) {
           const Eigen::Vector3d low = vector_from(min, "min"), high = vector_from(max, "max");
           return self.write([&](VoxelMap& m) { return m.erase_box(low, high); });
         },
         "min"_a.none(),
         "max"_a.none(),
         "Erase the points of the box from `min` to `max` (3,) [m], inclusive; return how many.")
      .def(
          "erase_within",
          [](SharedMap& self, nb::handle center, double radius) {
            require_radius(radius);
            const Eigen::Vector3d middle = vector_from(center, "center");
            return self.write([&](VoxelMap& m) { return m.erase_within(middle, radius); });
          },
          "center"_a.none(),
          "radius"_a,
          "Erase the points at most `radius` [m] from `center` (3,) [m]; return how many.")
      .def(
          "erase_voxels_beyond",
          [](SharedMap& self, nb::handle center, double radius) {
            require_radius(radius);
            const Eigen::Vector3d middle = vector_from(center, "center");
            return self.write([&](VoxelMap& m) { return m.erase_voxels_beyond(middle, radius); });
          },
          "center"_a.none(),
          "radius"_a,
          "Erase the voxels whose centre is farther than `radius` [m] from `center` (3,) [m]; "
          "return how many points.")
      .def(
          "clear",
          [](SharedMap& self) { self.write([](VoxelMap& m) { return m.clear(); }); },
          "Erase everything.");
}

void bind_contents(nb::class_<SharedMap>& map) {
  map.def(
         "__len__",
         [](const SharedMap& self) {
           return self.read([](const VoxelMap& m) { return m.size(); });
         })
      .def_prop_ro(
          "points", &points_of, nb::rv_policy::automatic, "(N, 3) float64 [m], map frame: a copy.")
      .def_prop_ro(
          "normals",
          &normals_of,
          nb::rv_policy::automatic,
          "(N, 3) float32, unit length; zero where there is none: a copy.")
      .def_prop_ro(
          "sides",
          &sides_of,
          nb::rv_policy::automatic,
          "(N,) uint8: 0 front of its voxel, 1 back: a copy.")
      .def("column", &column_of, "name"_a, kColumnDoc)
      .def_prop_ro(
          "options",
          [](const SharedMap& self) {
            return to_dict(self.read([](const VoxelMap& m) { return m.options(); }));
          },
          "dict: the options that the map was made with.")
      .def(
          "stats",
          [](const SharedMap& self) {
            return self.read([](const VoxelMap& m) { return m.stats(); });
          },
          "Count what the map holds.")
      .def("__repr__", &described);
}

void bind_files(nb::class_<SharedMap>& map, nb::module_& module) {
  map.def(
         "save",
         [](const SharedMap& self, nb::handle path) {
           const std::string name = path_from(path);
           self.read([&](const VoxelMap& m) { save_map(m, name); });
         },
         "path"_a,
         "Write the map to a file, bit by bit. RuntimeError when that fails.")
      .def("__getstate__", &state_of)
      .def("__setstate__", &restore, "state"_a.none());
  module.def(
      "load",
      [](nb::handle path) {
        const std::string name = path_from(path);
        const nb::gil_scoped_release no_gil;
        if (std::filesystem::is_directory(name)) {
          throw std::runtime_error("nvm: " + name + ": is a folder; name the map.nvm in it");
        }
        return new SharedMap(load_map(name));  // Python owns it
      },
      "path"_a,
      "Read a map that `VoxelMap.save` or ``nvm run`` wrote. RuntimeError, with what is wrong, "
      "when "
      "the file is no such map.");
}

}  // namespace

void bind_voxel_map(nb::module_& module) {
  bind_map_stats(module);
  nb::class_<SharedMap> map(module, "VoxelMap", documented<MapOptions>(kVoxelMapDoc));
  map.def(
         "__init__",
         [](SharedMap* self, const nb::kwargs& options) {
           new (self) SharedMap(VoxelMap(options_from<MapOptions>(options)));
         },
         "options"_a)
      .def(
          "insert",
          &insert,
          "points"_a.none(),
          "normals"_a.none(),
          "T_map_scan"_a = nb::none(),
          nb::kw_only(),
          "intensity"_a = nb::none(),
          "time"_a = nb::none(),
          "color"_a = nb::none(),
          "label"_a = nb::none(),
          kInsertDoc)
      .def(
          "nearest",
          &nearest,
          "points"_a.none(),
          "normals"_a = nb::none(),
          "k"_a = 5,
          "max_distance"_a = 1.0,
          nb::kw_only(),
          "rings"_a = 1,
          "threads"_a = 0,
          kNearestDoc)
      .def("within", &within, "center"_a.none(), "radius"_a, kWithinDoc);
  bind_erasing(map);
  bind_contents(map);
  bind_files(map, module);
}

}  // namespace nvm::python
