// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/estimator_schema.hpp"

namespace nvm::lio {

using config::Schema;

namespace {

/// Which neighbours of a point make its plane: of AssociationOptions and MeasurementOptions.
template <class Options>
void bind_neighbors(Schema& schema, Options& options) {
  schema.add(
      "neighbors",
      options.neighbors,
      {3.0, 64.0},
      "A plane is fitted to at most this many neighbours of a point");
  schema.add(
      "min_neighbors",
      options.min_neighbors,
      {3.0, 64.0},
      "A plane is fitted to at least this many neighbours of a point");
  schema.add(
      "max_neighbor_distance",
      options.max_neighbor_distance,
      kPositive,
      "Neighbours of a point are at most this far from it [m]");
  schema.add(
      "max_plane_distance",
      options.max_plane_distance,
      kPositive,
      "A point is matched with a plane that is at most this far from it [m]");
}

void bind_align(Schema& schema, AlignOptions& align) {
  AssociationOptions& association = align.association;
  bind_neighbors(schema, association);
  schema.add(
      "planarity_share",
      association.planarity_share,
      kShare,
      "This share of a residual's weight is its planarity (alpha)");
  schema.add("kernel_scale", align.kernel.scale, kPositive, "The scale of the robust loss [m]");
  schema.add(
      "max_iterations",
      align.max_iterations,
      {1.0, 1000.0},
      "A scan takes at most this many iterations");
  schema.add(
      "min_residuals",
      align.min_residuals,
      {6.0, 1e6},
      "A scan takes at least this many residuals");
  schema.add(
      "min_observability",
      align.min_observability,
      kShare,
      "A direction of the pose is observed when at least this share of the information is about "
      "it");
}

}  // namespace

void bind_filter(Schema& schema, PipelineOptions& options) {
  MeasurementOptions& m = options.measurement;
  bind_neighbors(schema, m);
  schema.add(
      "max_plane_deviation",
      m.max_plane_deviation,
      kPositive,
      "Neighbours lie at most this far off their plane [m]");
  schema.add_angle(
      "max_normal_angle_deg",
      m.max_normal_angle,
      {0.1, 90.0},
      "The normal of a point is within this angle of its plane's");
  schema.add(
      "min_planarity",
      m.min_planarity,
      kShare,
      "The neighbours of a point are at least this planar (a2D)");
  schema.add(
      "range_deviation",
      m.range_deviation,
      kPositive,
      "The standard deviation of a return along its beam [m]");
  schema.add(
      "beam_deviation",
      m.beam_deviation,
      kPositive,
      "The standard deviation of a return across its beam [rad]");
  schema.add("huber", m.huber, kPositive, "Residuals beyond this pull less [standard deviations]");
  schema.add(
      "correlation",
      m.correlation,
      {1.0, 1e6},
      "This many residuals count as one, since neighbours err together");
  schema.add(
      "min_residuals", m.min_residuals, {6.0, 1e6}, "An update takes at least this many residuals");
  schema.add(
      "min_observability",
      m.min_observability,
      kShare,
      "A direction of the pose is observed when at least this share of the information is about "
      "it");
  IterationOptions& iteration = options.iteration;
  schema.add(
      "max_iterations",
      iteration.max_iterations,
      {1.0, 50.0},
      "An update takes at most this many iterations");
  schema.add(
      "converged_translation",
      iteration.max_converged_translation,
      kPositive,
      "Iterations end when the position moves by less than this [m]");
  schema.add(
      "converged_rotation",
      iteration.max_converged_rotation,
      kPositive,
      "Iterations end when the rotation changes by less than this [rad]");
}

void bind_optimization(Schema& schema, PipelineOptions& options) {
  bind_align(schema, options.align);
  schema.add_choice<Coupling>(
      "coupling",
      options.coupling,
      {{"tight", Coupling::kTight}, {"loose", Coupling::kLoose}},
      "How optimisation and IMU come together; that of ct_lio_continuous is always tight");
  schema.add(
      "residual_deviation",
      options.residual_deviation,
      kPositive,
      "With coupling: tight, the standard deviation of a point from its plane [m]");
  PoseObservation& observation = options.observation;
  schema.add(
      "translation_deviation",
      observation.translation_deviation,
      kPositive,
      "With coupling: loose, the standard deviation of an optimised position [m]");
  schema.add(
      "rotation_deviation",
      observation.rotation_deviation,
      kPositive,
      "With coupling: loose, the standard deviation of an optimised rotation [rad]");
}

void bind_lidar_only(Schema& schema, LidarOdometryOptions& lidar_only) {
  bind_align(schema, lidar_only.align);
  schema.add(
      "min_confident_share",
      lidar_only.min_confident_share,
      kShare,
      "Other starts are searched when less than this share of a scan fits");
  schema.add(
      "max_confident_motion",
      lidar_only.max_confident_motion,
      kPositive,
      "Other starts are searched when the alignment moves a scan by more than this [m]");
  schema.add(
      "max_weak_duration",
      lidar_only.max_weak_duration,
      kNotNegative,
      "The velocity holds for this long without a believed scan [s]");
  StartSearchOptions& search = lidar_only.search;
  schema.add(
      "search_voxel_size",
      search.voxel_size,
      {0.1, 10.0},
      "The edge of a voxel of the coarse map for that search [m]");
  schema.add(
      "search_keypoint_spacing",
      search.keypoint_spacing,
      kPositive,
      "Keypoints of that search are about this far apart [m]");
  schema.add_angle("search_turn_deg", search.turn, {0.0, 180.0}, "Starts are turned by up to this");
}

}  // namespace nvm::lio
