// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/core/option.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/registration/align_options.hpp"
#include "survey/survey_options.hpp"

namespace nvm::python {

// The options whose structs do not list them themselves, as MapOptions does: see
// nvm/core/option.hpp. Their ranges are told by their text.

inline OptionInfo option(const char* name, const char* doc) { return {name, 0.0, 0.0, "", doc}; }

template <class Visitor>
void visit_options(NormalOptions& options, Visitor&& visit) {
  visit(option("min_range", "Nearer points get no normal [m]."), options.min_range);
  visit(option("max_range", "Farther points get no normal [m]."), options.max_range);
  visit(option("min_radius", "Of a neighbourhood at min_range [m]."), options.min_radius);
  visit(option("max_radius", "Of a neighbourhood at max_range [m]."), options.max_radius);
  visit(
      option("min_neighbors", "Points of a neighbourhood at least, with its own, from 3 on."),
      options.min_neighbors);
  visit(
      option("max_linearity", "Share of the first eigenvalue at most, above 1/3 to 1."),
      options.max_linearity);
  visit(
      option("max_surface_variation", "Share of the third eigenvalue at most, above 0 to 1/3."),
      options.max_surface_variation);
  visit(
      option("widening", "Radius of the second try, where neighbours are a line, 1 (none) to 10."),
      options.widening);
}

template <class Visitor>
void visit_options(AlignOptions& options, Visitor&& visit) {
  using Kernel = RobustKernel::Type;
  AssociationOptions& association = options.association;
  visit(option("neighbors", "Of a point at most, 3 to 64."), association.neighbors);
  visit(option("min_neighbors", "Of a point at least, from 3 on."), association.min_neighbors);
  visit(option("max_neighbor_distance", "[m]"), association.max_neighbor_distance);
  visit(
      option("max_plane_distance", "Of a point from its plane [m]."),
      association.max_plane_distance);
  visit(option("planarity_share", "Of the weight, 0 to 1."), association.planarity_share);
  visit(
      option("kernel", "Robust loss"),
      options.kernel.type,
      OptionChoices<Kernel, 3>{
          {{"none", Kernel::kNone}, {"huber", Kernel::kHuber}, {"cauchy", Kernel::kCauchy}}});
  visit(
      option("kernel_scale", "Residual from which the loss takes effect [m]."),
      options.kernel.scale);
  visit(option("max_iterations", "1 to 1000."), options.max_iterations);
  visit(option("converged_rotation", "A smaller step ends it [rad]."), options.converged_rotation);
  visit(
      option("converged_translation", "A smaller step ends it [m]."),
      options.converged_translation);
  visit(option("min_residuals", "Associated points at least, from 6 on."), options.min_residuals);
  visit(
      option("min_observability", "Below it a direction keeps the guess, 0 to 1."),
      options.min_observability);
}

template <class Visitor>
void visit_options(survey::SurveyOptions& options, Visitor&& visit) {
  visit(
      option("patch_size", "Of the cells that faces grow over [m], 0.05 to 2."),
      options.patch_size);
  visit(option("min_area", "Seen from both sides [m^2], 0.1 to 100."), options.min_area);
  visit(option("max_thickness", "Of a wall [m], 0.05 to 2."), options.max_thickness);
  visit(option("min_thickness", "Of a wall [m], 0 to 0.1."), options.min_thickness);
  visit(option("max_gap", "That a face goes on behind [m], 0 to 20."), options.max_gap);
  visit(option("plan_height", "Above the floor [m], -100 to 100."), options.plan_height);
  visit(
      option("drift", "Standard deviation of the pose between two passes [m], 0 to 1."),
      options.drift);
}

}  // namespace nvm::python
