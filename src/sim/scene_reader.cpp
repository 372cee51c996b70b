// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/scene_reader.hpp"

#include <array>
#include <filesystem>

#include "io/file/stays_below.hpp"
#include "sim/angles.hpp"
#include "sim/mesh_file.hpp"
#include "sim/solid_fields.hpp"

namespace nvm::sim {
namespace {

constexpr config::Range kShare{0.0, 1.0};

/// The frames of an item's copies, with the ends of their names. Each "repeat" multiplies them.
std::vector<std::pair<Pose, std::string>> read_copies(Fields& item) {
  std::vector<std::pair<Pose, std::string>> copies{{Pose::Identity(), ""}};
  for (Fields& repeat : item.items("repeat")) {
    const auto count = repeat.required<int>("count", {1, 10000});
    const Eigen::Vector3d step = repeat.point("step", 0.0);
    repeat.finish();
    std::vector<std::pair<Pose, std::string>> more;
    for (const auto& [T_local_copy, suffix] : copies) {
      for (int i = 0; i < count; ++i) {
        more.emplace_back(T_local_copy * shift(i * step), suffix + "_" + std::to_string(i + 1));
      }
    }
    copies = std::move(more);
  }
  return copies;
}

/// A list of at least two points; one without a height is as high as the one before.
std::vector<Eigen::Vector3d> read_path(Fields& fields, const std::string& key) {
  const config::Value* value = fields.take(key);
  const auto items = value == nullptr ? std::nullopt : value->items();
  if (!items || items->size() < 2) {
    fields.fail("\"" + key + "\" must be a list of at least two points");
  }
  std::vector<Eigen::Vector3d> path;
  for (const config::Value& item : *items) {
    path.push_back(Fields::to_point(item, path.empty() ? 0.0 : path.back().z()));
  }
  return path;
}

}  // namespace

void SceneReader::add(Fields& document, const std::string& folder) {
  folder_ = folder;
  read_materials(document);
  for (const auto& [name, value] : document.members("objects")) {
    objects_.insert_or_assign(name, value);
  }
  scene_.description = document.optional("description", scene_.description);
  add_solids(document, {});
  read_people(document);
  if (const config::Value* route = document.take("route"); route != nullptr) {
    read_route(Fields(*route));
  }
}

void SceneReader::read_materials(Fields& document) {
  for (const auto& [name, value] : document.members("materials")) {
    Fields fields(value);
    Material& material = materials_[name];
    material.reflectivity = fields.optional("reflectivity", material.reflectivity, kShare);
    material.transmission = fields.optional("transmission", material.transmission, kShare);
    material.mirror = fields.optional("mirror", material.mirror, kShare);
    fields.finish();
  }
}

void SceneReader::read_people(Fields& document) {
  for (Fields& item : document.items("people")) {
    Person& person = scene_.people.emplace_back();
    person.path = read_path(item, "path");
    person.speed = item.optional("speed", person.speed, {0.0, 10.0});
    person.radius = item.optional("radius", person.radius, {0.01, 2.0});
    person.height = item.optional("height", person.height, {0.1, 3.0});
    item.finish();
  }
}

void SceneReader::read_route(Fields route) {
  Route& result = scene_.route;
  result.speed = route.optional("speed", result.speed, {0.5, 1.1});
  result.laps = route.optional("laps", result.laps, {1, 100});
  result.waypoints = read_path(route, "waypoints");
  route.finish();
}

Material SceneReader::material_of(Fields& item) const {
  const config::Value* value = item.take("material");
  if (value == nullptr) {
    return {};
  }
  const auto known = materials_.find(value->text().value_or(""));
  if (known == materials_.end()) {
    value->fail("is not one of the materials");
  }
  return known->second;
}

void SceneReader::add_solids(Fields& body, const Place& place) {
  const auto for_each = [&](const std::string& kind, const auto& add) {
    for (Fields& item : body.items(kind)) {
      const auto name = item.optional<std::string>("name", "");
      const std::string prefix = place.prefix + name;
      for (const auto& [T_local_copy, suffix] : read_copies(item)) {
        add(item, Place{place.T_world_local * T_local_copy, prefix + suffix});
      }
      item.finish();
    }
  };
  for_each("boxes", [&](Fields& item, const Place& at) { add_box(read_box(item), item, at); });
  for_each("hulls", [&](Fields& item, const Place& at) {
    static constexpr std::array<const char*, 6> kSides{
        "_west", "_east", "_south", "_north", "_floor", "_ceiling"};
    const std::vector<Box> boxes = read_hull(item);
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      add_box(boxes[i], item, {at.T_world_local, at.prefix + kSides[i]});
    }
  });
  for_each("cylinders", [&](Fields& item, const Place& at) {
    add_cylinder(read_cylinder(item), item, at);
  });
  for_each("meshes", [&](Fields& item, const Place& at) { add_mesh(item, at); });
  for_each(
      "walls", [&](Fields& item, const Place& at) { add_plate(read_wall(item), 1, item, at); });
  for_each(
      "slabs", [&](Fields& item, const Place& at) { add_plate(read_slab(item), 2, item, at); });
  for_each("place", [&](Fields& item, const Place& at) { add_object(item, at); });
}

void SceneReader::add_box(Box box, Fields& item, const Place& place) {
  box.name = place.prefix;
  box.material = material_of(item);
  box.T_world_box = place.T_world_local * box.T_world_box;
  scene_.boxes.push_back(std::move(box));
}

void SceneReader::add_cylinder(Cylinder cylinder, Fields& item, const Place& place) {
  cylinder.name = place.prefix;
  cylinder.material = material_of(item);
  cylinder.T_world_cylinder = place.T_world_local * cylinder.T_world_cylinder;
  scene_.cylinders.push_back(std::move(cylinder));
}

void SceneReader::add_mesh(Fields& item, const Place& place) {
  const auto file = item.required<std::string>("file");
  if (!io::stays_below(file)) {
    item.fail("the mesh \"" + file + "\" lies outside the folder of the scene");
  }
  const double scale = item.optional("scale", 1.0, {1e-6, 1e6});
  Mesh mesh = read_mesh(
      (std::filesystem::path(folder_) / file).string(),
      scale,
      place.T_world_local * read_placement(item));
  mesh.name = place.prefix;
  mesh.material = material_of(item);
  scene_.meshes.push_back(std::move(mesh));
}

void SceneReader::add_plate(
    const std::vector<Box>& pieces, Eigen::Index across, Fields& item, const Place& place) {
  const bool is_listed = item.optional("listed", true);
  int piece = 0;
  for (const Box& box : pieces) {
    if (is_listed) {
      scene_.wall_pieces.push_back({place.prefix, piece, scene_.boxes.size(), across});
    }
    add_box(box, item, place);
    ++piece;
  }
}

void SceneReader::add_object(Fields& item, const Place& place) {
  constexpr int kMaxDepth = 8;  // objects of objects; more is taken for a circle
  const auto name = item.required<std::string>("object");
  const auto object = objects_.find(name);
  if (object == objects_.end()) {
    item.fail("\"" + name + "\" is not one of the objects");
  }
  if (object_depth_ == kMaxDepth) {
    item.fail("object \"" + name + "\" contains itself");
  }
  const std::string label = place.prefix.empty() ? name : place.prefix;
  Fields body(object->second);
  ++object_depth_;
  add_solids(body, {place.T_world_local * read_placement(item), label + "/"});
  --object_depth_;
  body.finish();
}

}  // namespace nvm::sim
