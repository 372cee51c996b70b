// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <utility>

#include "nvm/map/map_options.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::python {

struct OptionText {
  const char* name;
  const char* doc;
};

template <class Enum, std::size_t kCount>
using Choices = std::array<std::pair<const char*, Enum>, kCount>;

// visit_options(options, visit) calls visit({name, doc}, member) for each option, and
// visit({name, doc}, member, choices) for those that are chosen by name.

template <class Visitor>
void visit_options(MapOptions& options, Visitor&& visit) {
  using Text = OptionText;
  visit(Text{"voxel_size", "Edge of a voxel [m], 0.01 to 100."}, options.voxel_size);
  visit(Text{"capacity", "Voxels at most, 1 to 2**26."}, options.capacity);
  visit(Text{"max_bytes", "Memory at most; 0: what capacity needs."}, options.max_bytes);
  visit(
      Text{"points_per_surface", "Points of a surface at most, 1 to 120."},
      options.points_per_surface);
  visit(
      Text{"min_point_distance", "Between points of a surface [m], 0 to 2 voxel_size."},
      options.min_point_distance);
  visit(
      Text{"space_across_voxels", "Whether that also holds between voxels."},
      options.space_across_voxels);
  visit(
      Text{"max_merged_points", "Points that a stored one becomes the mean plane of, 1 to 255."},
      options.max_merged_points);
  visit(Text{"max_surfaces", "Surfaces of a voxel, 1 to 8."}, options.max_surfaces);
  visit(
      Text{"surface_rule", "Which surface takes a point: 'paper', 'smallest_angle'."},
      options.surface_rule,
      Choices<SurfaceRule, 2>{
          {{"paper", SurfaceRule::kPaper}, {"smallest_angle", SurfaceRule::kSmallestAngle}}});
  visit(
      Text{"max_surface_angle", "Of a point or query to a surface [rad], 0 to pi."},
      options.max_surface_angle);
  visit(
      Text{"max_point_angle", "Of a neighbour's normal to the query's [rad], 0 to pi."},
      options.max_point_angle);
  visit(
      Text{"eviction", "What leaves a full map: 'lru', 'radius'."},
      options.eviction,
      Choices<Eviction, 2>{{{"lru", Eviction::kLeastRecentlyUsed}, {"radius", Eviction::kRadius}}});
  visit(
      Text{"eviction_radius", "With eviction='radius' [m], at least voxel_size."},
      options.eviction_radius);
}

template <class Visitor>
void visit_options(NormalOptions& options, Visitor&& visit) {
  using Text = OptionText;
  visit(Text{"min_range", "Nearer points get no normal [m]."}, options.min_range);
  visit(Text{"max_range", "Farther points get no normal [m]."}, options.max_range);
  visit(Text{"min_radius", "Of a neighbourhood at min_range [m]."}, options.min_radius);
  visit(Text{"max_radius", "Of a neighbourhood at max_range [m]."}, options.max_radius);
  visit(
      Text{"min_neighbors", "Points of a neighbourhood at least, with its own, from 3 on."},
      options.min_neighbors);
  visit(
      Text{"max_linearity", "Share of the first eigenvalue at most, above 1/3 to 1."},
      options.max_linearity);
  visit(
      Text{"max_surface_variation", "Share of the third eigenvalue at most, above 0 to 1/3."},
      options.max_surface_variation);
  visit(
      Text{"widening", "Radius of the second try, where neighbours are a line, 1 (none) to 10."},
      options.widening);
}

template <class Visitor>
void visit_options(AlignOptions& options, Visitor&& visit) {
  using Text = OptionText;
  using Kernel = RobustKernel::Type;
  AssociationOptions& association = options.association;
  visit(Text{"neighbors", "Of a point at most, 3 to 64."}, association.neighbors);
  visit(Text{"min_neighbors", "Of a point at least, from 3 on."}, association.min_neighbors);
  visit(Text{"max_neighbor_distance", "[m]"}, association.max_neighbor_distance);
  visit(
      Text{"max_plane_distance", "Of a point from its plane [m]."}, association.max_plane_distance);
  visit(Text{"planarity_share", "Of the weight, 0 to 1."}, association.planarity_share);
  visit(
      Text{"kernel", "Robust loss: 'none', 'huber', 'cauchy'."},
      options.kernel.type,
      Choices<Kernel, 3>{
          {{"none", Kernel::kNone}, {"huber", Kernel::kHuber}, {"cauchy", Kernel::kCauchy}}});
  visit(
      Text{"kernel_scale", "Residual from which the loss takes effect [m]."}, options.kernel.scale);
  visit(Text{"max_iterations", "1 to 1000."}, options.max_iterations);
  visit(Text{"converged_rotation", "A smaller step ends it [rad]."}, options.converged_rotation);
  visit(
      Text{"converged_translation", "A smaller step ends it [m]."}, options.converged_translation);
  visit(Text{"min_residuals", "Associated points at least, from 6 on."}, options.min_residuals);
  visit(
      Text{"min_observability", "Below it a direction keeps the guess, 0 to 1."},
      options.min_observability);
}

}  // namespace nvm::python
