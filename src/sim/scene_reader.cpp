// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/scene_reader.hpp"

#include <filesystem>

#include "sim/mesh_file.hpp"

namespace nvm::sim {
namespace {

constexpr config::Range kPositive{1e-4, 1e4};
constexpr config::Range kShare{0.0, 1.0};
constexpr config::Range kCount{1, 10000};

/// Rotation by roll, pitch and yaw [deg] about the fixed x, y and z axes.
Eigen::Matrix3d rotation_from_deg(const Eigen::Vector3d& angles_deg) {
  const Eigen::Vector3d angles = angles_deg * (M_PI / 180.0);
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Pose make_pose(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  Pose pose = Pose::Identity();
  pose.linear() = R;
  pose.translation() = t;
  return pose;
}

/// Reads two opposite corners, the first of which must be below the second on all axes.
std::pair<Eigen::Vector3d, Eigen::Vector3d> corners(Fields& item, double max_z_if_missing) {
  const Eigen::Vector3d min = item.point("min", 0.0);
  const Eigen::Vector3d max = item.point("max", max_z_if_missing);
  if ((max - min).minCoeff() <= 0.0) {
    item.fail("\"max\" must be greater than \"min\" on every axis");
  }
  return {min, max};
}

Eigen::Matrix3d rotation_of(Fields& item) {
  return rotation_from_deg(
      item.optional<Eigen::Vector3d>("rotation_deg", Eigen::Vector3d::Zero(), {-360.0, 360.0}));
}

/// Boxes for the rectangles `pieces` of a plate. `T_world_plate` has the plate in the plane of two
/// of its axes, u and v, centred on the third, the one across.
std::vector<Box> plate_boxes(
    const std::vector<Rectangle>& pieces,
    double thickness,
    Eigen::Index across,
    const Pose& T_world_plate,
    const Box& prototype) {
  const Eigen::Index u = across == 0 ? 1 : 0;
  const Eigen::Index v = across == 2 ? 1 : 2;
  std::vector<Box> boxes;
  for (const Rectangle& piece : pieces) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    center[u] = 0.5 * (piece.min_u + piece.max_u);
    center[v] = 0.5 * (piece.min_v + piece.max_v);
    Box box = prototype;
    box.half_size[across] = 0.5 * thickness;
    box.half_size[u] = 0.5 * (piece.max_u - piece.min_u);
    box.half_size[v] = 0.5 * (piece.max_v - piece.min_v);
    box.T_world_box = T_world_plate * make_pose(Eigen::Matrix3d::Identity(), center);
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

void SceneReader::add(Fields& document, const std::string& folder) {
  folder_ = folder;
  for (const auto& [name, value] : document.members("materials")) {
    Fields fields(value);
    Material& material = materials_[name];
    material.reflectivity = fields.optional("reflectivity", material.reflectivity, kShare);
    material.transmission = fields.optional("transmission", material.transmission, kShare);
    fields.finish();
  }
  for (const auto& [name, value] : document.members("objects")) {
    objects_.insert_or_assign(name, value);
  }
  scene_.description = document.optional("description", scene_.description);
  add_solids(document, {});
  if (const config::Value* route = document.take("route"); route != nullptr) {
    read_route(Fields(*route));
  }
}

void SceneReader::add_solids(Fields& body, const Place& place) {
  using Adder = void (SceneReader::*)(Fields&, const Place&);
  static const std::vector<std::pair<std::string, Adder>> kKinds{
      {"boxes", &SceneReader::add_box},
      {"hulls", &SceneReader::add_hull},
      {"cylinders", &SceneReader::add_cylinder},
      {"meshes", &SceneReader::add_mesh},
      {"walls", &SceneReader::add_wall},
      {"slabs", &SceneReader::add_slab},
      {"place", &SceneReader::add_object}};
  for (const auto& [kind, add] : kKinds) {
    for (Fields& item : body.items(kind)) {
      const std::string name = item.optional<std::string>("name", "");
      const Place named{place.T_world_local, place.prefix + name};
      for_each_copy(
          item, named, [&, adder = add](const Place& copy) { (this->*adder)(item, copy); });
      item.finish();
    }
  }
}

void SceneReader::for_each_copy(Fields& item, const Place& place, const CopyFunction& add) {
  std::vector<Place> copies{place};
  for (Fields& repeat : item.items("repeat")) {
    const int count = repeat.required<int>("count", kCount);
    const Eigen::Vector3d step = repeat.point("step", 0.0);
    repeat.finish();
    std::vector<Place> more;
    for (const Place& copy : copies) {
      for (int i = 0; i < count; ++i) {
        Pose T_world_local = copy.T_world_local * make_pose(Eigen::Matrix3d::Identity(), i * step);
        more.push_back({T_world_local, copy.prefix + "_" + std::to_string(i + 1)});
      }
    }
    copies = std::move(more);
  }
  for (const Place& copy : copies) {
    add(copy);
  }
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

void SceneReader::add_box(Fields& item, const Place& place) {
  Box box;
  box.name = place.prefix;
  box.material = material_of(item);
  Eigen::Vector3d center;
  if (item.has("min")) {
    const auto [min, max] = corners(item, 0.0);
    center = 0.5 * (min + max);
    box.half_size = 0.5 * (max - min);
  } else {
    center = item.required<Eigen::Vector3d>("center");
    box.half_size = 0.5 * item.required<Eigen::Vector3d>("size", kPositive);
  }
  box.T_world_box = place.T_world_local * make_pose(rotation_of(item), center);
  scene_.boxes.push_back(box);
}

void SceneReader::add_hull(Fields& item, const Place& place) {
  const auto [min, max] = corners(item, 0.0);
  const double thickness = item.optional("thickness", 0.3, kPositive);
  const Material material = material_of(item);
  const Eigen::Vector3d center = 0.5 * (min + max);
  const Eigen::Vector3d half_size = 0.5 * (max - min);
  static const std::array<const char*, 6> kSides{
      "west", "east", "south", "north", "floor", "ceiling"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const double sign = side == 0 ? -1.0 : 1.0;
      Box box;
      box.name = place.prefix + "_" + kSides[face_index(axis, side)];
      box.material = material;
      box.half_size = half_size + Eigen::Vector3d::Constant(thickness);
      box.half_size[axis] = 0.5 * thickness;
      Eigen::Vector3d box_center = center;
      box_center[axis] += sign * (half_size[axis] + 0.5 * thickness);
      box.T_world_box = place.T_world_local * make_pose(Eigen::Matrix3d::Identity(), box_center);
      scene_.boxes.push_back(box);
    }
  }
}

void SceneReader::add_cylinder(Fields& item, const Place& place) {
  Cylinder cylinder;
  cylinder.name = place.prefix;
  cylinder.material = material_of(item);
  cylinder.radius = item.required<double>("radius", kPositive);
  cylinder.half_height = 0.5 * item.required<double>("height", kPositive);
  const Eigen::Vector3d bottom = item.point("bottom", 0.0);
  const Eigen::Matrix3d R = rotation_of(item);
  cylinder.T_world_cylinder =
      place.T_world_local * make_pose(R, bottom + R.col(2) * cylinder.half_height);
  scene_.cylinders.push_back(cylinder);
}

void SceneReader::add_mesh(Fields& item, const Place& place) {
  const std::filesystem::path file = item.required<std::string>("file");
  const double scale = item.optional("scale", 1.0, kPositive);
  const Eigen::Vector3d at = item.point("at", 0.0);
  const Pose T_world_mesh = place.T_world_local * make_pose(rotation_of(item), at);
  Mesh mesh = read_mesh((std::filesystem::path(folder_) / file).string(), scale, T_world_mesh);
  mesh.name = place.prefix;
  mesh.material = material_of(item);
  scene_.meshes.push_back(std::move(mesh));
}

void SceneReader::add_wall(Fields& item, const Place& place) {
  const Eigen::Vector3d from = item.point("from", 0.0);
  const Eigen::Vector3d along = item.point("to", 0.0) - from;
  const double length = along.norm();
  const double bottom = item.optional("bottom", 0.0, {-1000.0, 1000.0});
  const Rectangle whole{0.0, length, bottom, bottom + item.required<double>("height", kPositive)};
  if (length < 1e-3 || along.z() != 0.0) {
    item.fail("\"from\" and \"to\" must be two points [x, y]");
  }
  std::vector<Rectangle> openings;
  for (Fields& opening : item.items("openings")) {
    const double start = opening.required<double>("from");
    const double end = opening.required<double>("to", {start, length});
    const double sill = opening.optional("bottom", 0.0, {0.0, 100.0});
    const double top = opening.optional("top", 2.05, {sill, 100.0});
    openings.push_back({start, end, bottom + sill, bottom + top});
    opening.finish();
  }
  const double yaw_deg = std::atan2(along.y(), along.x()) * 180.0 / M_PI;
  const Pose T_local_wall = make_pose(rotation_from_deg({0.0, 0.0, yaw_deg}), from);
  Box prototype;
  prototype.name = place.prefix;
  prototype.material = material_of(item);
  const double thickness = item.required<double>("thickness", kPositive);
  add_pieces(
      plate_boxes(
          cut_openings(whole, openings),
          thickness,
          1,
          place.T_world_local * T_local_wall,
          prototype),
      1,
      item.optional("listed", true));
}

void SceneReader::add_slab(Fields& item, const Place& place) {
  const Eigen::Vector3d min = item.point("min", 0.0);
  const Eigen::Vector3d max = item.point("max", 0.0);
  if ((max - min).head<2>().minCoeff() <= 0.0) {
    item.fail("\"max\" must be greater than \"min\" in x and y");
  }
  std::vector<Rectangle> openings;
  for (Fields& opening : item.items("openings")) {
    const Eigen::Vector3d low = opening.point("min", 0.0);
    const Eigen::Vector3d high = opening.point("max", 0.0);
    openings.push_back({low.x(), high.x(), low.y(), high.y()});
    opening.finish();
  }
  Box prototype;
  prototype.name = place.prefix;
  prototype.material = material_of(item);
  const double thickness = item.required<double>("thickness", kPositive);
  const double middle = item.required<double>("top") - 0.5 * thickness;
  const Pose T_local_slab =
      make_pose(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, middle));
  const Rectangle whole{min.x(), max.x(), min.y(), max.y()};
  add_pieces(
      plate_boxes(
          cut_openings(whole, openings),
          thickness,
          2,
          place.T_world_local * T_local_slab,
          prototype),
      2,
      item.optional("listed", true));
}

void SceneReader::add_pieces(const std::vector<Box>& pieces, Eigen::Index axis, bool is_listed) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (is_listed) {
      scene_.wall_pieces.push_back(
          {pieces[i].name, static_cast<int>(i), scene_.boxes.size(), axis});
    }
    scene_.boxes.push_back(pieces[i]);
  }
}

void SceneReader::add_object(Fields& item, const Place& place) {
  constexpr int kMaxDepth = 8;  // objects of objects; more is taken for a circle
  const std::string name = item.required<std::string>("object");
  const auto object = objects_.find(name);
  if (object == objects_.end()) {
    item.fail("\"" + name + "\" is not one of the objects");
  }
  if (object_depth_ == kMaxDepth) {
    item.fail("object \"" + name + "\" contains itself");
  }
  const Eigen::Vector3d at = item.point("at", 0.0);
  const double yaw_deg = item.optional("yaw_deg", 0.0, {-360.0, 360.0});
  Pose T_world_object = place.T_world_local * make_pose(rotation_from_deg({0.0, 0.0, yaw_deg}), at);
  ++object_depth_;
  Fields body(object->second);
  const std::string label = place.prefix.empty() ? name : place.prefix;
  add_solids(body, {T_world_object, label + "/"});
  body.finish();
  --object_depth_;
}

void SceneReader::read_route(Fields route) {
  scene_.route.speed = route.optional("speed", scene_.route.speed, {0.1, 3.0});
  scene_.route.laps = route.optional("laps", scene_.route.laps, {1, 100});
  const config::Value* waypoints = route.take("waypoints");
  const auto items = waypoints == nullptr ? std::nullopt : waypoints->items();
  if (!items || items->size() < 2) {
    route.fail("\"waypoints\" must be a list of at least two points");
  }
  scene_.route.waypoints.clear();
  for (const config::Value& item : *items) {
    const double floor = scene_.route.waypoints.empty() ? 0.0 : scene_.route.waypoints.back().z();
    scene_.route.waypoints.push_back(Fields::to_point(item, floor));
  }
  route.finish();
}

}  // namespace nvm::sim
