// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/fields.hpp"
#include "sim/rectangle_cut.hpp"
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
  using CopyFunction = std::function<void(const Place&)>;

  void add_solids(Fields& body, const Place& place);
  void add_box(Fields& item, const Place& place);
  void add_hull(Fields& item, const Place& place);
  void add_cylinder(Fields& item, const Place& place);
  void add_mesh(Fields& item, const Place& place);
  void add_wall(Fields& item, const Place& place);
  void add_slab(Fields& item, const Place& place);
  void add_object(Fields& item, const Place& place);
  void add_pieces(const std::vector<Box>& pieces, Eigen::Index axis, bool is_listed);
  void read_route(Fields route);
  Material material_of(Fields& item) const;
  static void for_each_copy(Fields& item, const Place& place, const CopyFunction& add);

  std::string folder_;
  std::map<std::string, Material> materials_;
  std::map<std::string, config::Value> objects_;
  int object_depth_ = 0;
  Scene scene_;
};

}  // namespace nvm::sim
