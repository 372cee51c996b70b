// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/fields.hpp"
#include "sim/scene.hpp"

namespace nvm::sim {

/// Builds a Scene from the mappings of scene files. Throws what Fields throws.
class SceneReader {
 public:
  /// Adds the materials and objects of `document`, then its solids, placed objects and route.
  /// `folder`: where relative paths of meshes start; "" for the working directory.
  void add(Fields& document, const std::string& folder);

  Scene take() { return std::move(scene_); }

 private:
  /// Where the solids of a mapping go: a frame, and the start of their names.
  struct Place {
    Pose T_world_local = Pose::Identity();
    std::string prefix;
  };

  void read_materials(Fields& document);
  void read_people(Fields& document);
  void read_route(Fields route);
  Material material_of(Fields& item) const;

  void add_solids(Fields& body, const Place& place);
  void add_object(Fields& item, const Place& place);
  void add_mesh(Fields& item, const Place& place);
  void add_cylinder(Cylinder cylinder, Fields& item, const Place& place);
  void add_box(Box box, Fields& item, const Place& place);
  void add_plate(
      const std::vector<Box>& pieces, Eigen::Index across, Fields& item, const Place& place);

  std::string folder_;
  std::map<std::string, Material> materials_;
  std::map<std::string, config::Value> objects_;
  int object_depth_ = 0;
  Scene scene_;
};

}  // namespace nvm::sim
