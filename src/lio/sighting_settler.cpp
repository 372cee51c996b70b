// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/sighting_settler.hpp"

#include "nvm/map/sighting.hpp"
#include "nvm/registration/settle_sightings.hpp"

namespace nvm::lio {

namespace {

AssociationOptions settling_options() {
  AssociationOptions options;
  options.neighbors = 8;
  options.max_neighbor_distance = 0.6;
  options.max_plane_distance = 0.05;  // what lies farther off lies on something else
  return options;
}

}  // namespace

SightingSettler::SightingSettler(double spacing, const Executor& executor)
    : options_(settling_options()), executor_(executor), cubes_(spacing) {}

void SightingSettler::settle(
    const LioMap& map,
    const Pose& T_map_scan,
    std::vector<Eigen::Vector3f>& points,
    std::vector<Eigen::Vector3f>& normals) {
  chosen_.clear();
  cubes_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_sighting(normals[i]) &&
        cubes_.insert(points[i].cast<double>()) == VoxelSet::Insertion::kNewCell) {
      chosen_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  settle_sightings(map, T_map_scan, chosen_, options_, points, normals, executor_);
}

}  // namespace nvm::lio
