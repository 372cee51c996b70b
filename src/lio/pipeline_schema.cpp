// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/schema.hpp"
#include "lio/pipeline_options.hpp"

namespace nvm::lio {

namespace {

using config::Range;
using config::Schema;

constexpr Range kShare{0.0, 1.0};
constexpr Range kPositive{1e-12, 1e12};
constexpr Range kNotNegative{0.0, 1e12};

/// A key for each option that it visits; angles are written in degrees.
struct OptionBinder {
  Schema& schema;

  template <class Value>
  void operator()(const OptionInfo& info, Value& value) const {
    schema.add(info.name, value, {info.min, info.max}, documentation(info));
  }
  void operator()(const OptionInfo& info, double& value) const {
    if (std::string(info.unit) == "rad") {
      constexpr double kDegrees = 57.29577951308232;
      const Range range{info.min * kDegrees, info.max * kDegrees};
      schema.add_angle(std::string(info.name) + "_deg", value, range, info.doc);
    } else {
      schema.add(info.name, value, {info.min, info.max}, documentation(info));
    }
  }
  void operator()(const OptionInfo& info, bool& value) const {
    schema.add(info.name, value, info.doc);
  }
  template <class Enum, std::size_t kCount>
  void operator()(
      const OptionInfo& info, Enum& value, const OptionChoices<Enum, kCount>& choices) const {
    schema.add_choice<Enum>(info.name, value, {choices.begin(), choices.end()}, info.doc);
  }

  static std::string documentation(const OptionInfo& info) {
    return *info.unit == '\0' ? info.doc : std::string(info.doc) + " [" + info.unit + "]";
  }
};

void bind_map(Schema& schema, PipelineOptions& options) {
  schema.add_choice<MapType>(
      "type",
      options.map_type,
      {{"nvm", MapType::kNvm},
       {"voxel", MapType::kVoxel},
       {"facing", MapType::kFacing},
       {"reject", MapType::kReject},
       {"kdtree", MapType::kKdTree}},
      "Kind of map: two-sided, without normals, with a filter in or after the query, k-d tree");
  visit_options(options.map, OptionBinder{schema});
}

void bind_normals(Schema& schema, NormalOptions& normals) {
  schema.add("min_radius", normals.min_radius, {0.001, 1000.0}, "Neighbourhood at min_range [m]");
  schema.add("max_radius", normals.max_radius, {0.001, 1000.0}, "Neighbourhood at max_range [m]");
  schema.add("min_range", normals.min_range, {0.0, 1e4}, "Where the radius begins to grow [m]");
  schema.add("max_range", normals.max_range, {0.0, 1e4}, "Where it stops to grow [m]");
  schema.add(
      "widening",
      normals.widening,
      {1.0, 10.0},
      "Larger radius where neighbours are a line; 1: no");
  schema.add("min_neighbors", normals.min_neighbors, {3.0, 1e6}, "Points of a neighbourhood");
  schema.add("max_linearity", normals.max_linearity, {0.334, 1.0}, "First eigenvalue's share");
  schema.add(
      "max_surface_variation", normals.max_surface_variation, {0.0, 0.334}, "Third one's share");
}

void bind_imu(Schema& schema, InertialOptions& inertial) {
  ImuNoise& noise = inertial.imu_noise;
  schema.add("gyro_noise", noise.gyro, kPositive, "[rad/s/sqrt(Hz)]");
  schema.add("accel_noise", noise.accel, kPositive, "[m/s^2/sqrt(Hz)]");
  schema.add("gyro_bias_walk", noise.gyro_bias, kPositive, "[rad/s^2/sqrt(Hz)]");
  schema.add("accel_bias_walk", noise.accel_bias, kPositive, "[m/s^3/sqrt(Hz)]");
  schema.add(
      "max_gap",
      inertial.max_imu_gap,
      kNotNegative,
      "Longest time between readings [s]; 0: four times the usual one");
  ImuInputOptions& input = inertial.imu_input;
  schema.add("gyro_scale", input.gyro_scale, "Makes rad/s of the readings; 0: by the data");
  schema.add("accel_scale", input.accel_scale, "Makes m/s^2, -1: wrong sign; 0: by the data");
  schema.add("time_offset", input.time_offset, "Added to the IMU's times [s]");
  InitializerOptions& initializer = inertial.initializer;
  schema.add("still_duration", initializer.still_duration, {0.2, 10.0}, "Stillness at start [s]");
  schema.add("max_still_gyro", initializer.max_still_gyro, kPositive, "[rad/s]");
  schema.add("max_still_accel", initializer.max_still_accel, kPositive, "[m/s^2]");
  schema.add("max_still_rate", initializer.max_still_rate, kPositive, "[rad/s]");
  schema.add(
      "moving_start_after",
      initializer.moving_start_after,
      "A moving sensor starts without the IMU after this long [s]; negative: never");
  schema.add("gravity", initializer.gravity, {1.0, 30.0}, "[m/s^2]");
}

void bind_lidar(Schema& schema, InertialOptions& inertial) {
  schema.add(
      "min_range", inertial.returns.min_range, kNotNegative, "Nearer returns are dropped [m]");
  schema.add("max_range", inertial.returns.max_range, kPositive, "Farther ones too [m]");
  schema.add(
      "max_points",
      inertial.returns.max_count,
      {100.0, 1e8},
      "Used of a scan, about; a larger one is thinned where it is densest");
  schema.add(
      "extrinsic_translation_deviation",
      inertial.extrinsic_translation_deviation,
      kNotNegative,
      "How unsure it is [m]; 0: not estimated");
  schema.add(
      "extrinsic_rotation_deviation",
      inertial.extrinsic_rotation_deviation,
      kNotNegative,
      "How unsure it is [rad]; 0: not estimated");
}

void bind_matching(Schema& schema, PipelineOptions& options) {
  InertialOptions& inertial = options.inertial;
  schema.add(
      "max_plane_offset",
      inertial.max_plane_offset,
      kNotNegative,
      "Points move onto their neighbourhood's plane by at most this [m]; 0: never");
  schema.add("keypoint_spacing", inertial.keypoints.spacing, kPositive, "[m]");
  schema.add("max_keypoints", inertial.keypoints.max_count, {10.0, 1e5}, "Per scan");
  schema.add("min_inlier_share", inertial.min_inlier_share, kShare, "Of a frame to be believed");
  schema.add("max_weak_duration", inertial.max_weak_duration, kNotNegative, "Until lost [s]");
}

void bind_filter(Schema& schema, PipelineOptions& options) {
  MeasurementOptions& m = options.measurement;
  schema.add("neighbors", m.neighbors, {3.0, 64.0}, "Of a point, at most");
  schema.add("min_neighbors", m.min_neighbors, {3.0, 64.0}, "Of a point, at least");
  schema.add("max_neighbor_distance", m.max_neighbor_distance, kPositive, "[m]");
  schema.add("max_plane_distance", m.max_plane_distance, kPositive, "[m]");
  schema.add("max_plane_deviation", m.max_plane_deviation, kPositive, "[m]");
  schema.add_angle("max_normal_angle_deg", m.max_normal_angle, {0.1, 90.0}, "Plane to point");
  schema.add("min_planarity", m.min_planarity, kShare, "Of a plane (a2D)");
  schema.add("range_deviation", m.range_deviation, kPositive, "Of a return along the beam [m]");
  schema.add("beam_deviation", m.beam_deviation, kPositive, "Of a return across it [rad]");
  schema.add("huber", m.huber, kPositive, "Residuals beyond pull less [standard deviations]");
  schema.add("correlation", m.correlation, {1.0, 1e6}, "Residuals that count as one");
  schema.add("min_residuals", m.min_residuals, {6.0, 1e6}, "Of an update");
  schema.add("min_observability", m.min_observability, kShare, "Of a direction of the pose");
  IterationOptions& iteration = options.iteration;
  schema.add("max_iterations", iteration.max_iterations, {1.0, 50.0}, "Of an update");
  schema.add("converged_translation", iteration.max_converged_translation, kPositive, "[m]");
  schema.add("converged_rotation", iteration.max_converged_rotation, kPositive, "[rad]");
}

void bind_align(Schema& schema, AlignOptions& align) {
  AssociationOptions& association = align.association;
  schema.add("neighbors", association.neighbors, {3.0, 64.0}, "Of a point, at most");
  schema.add("min_neighbors", association.min_neighbors, {3.0, 64.0}, "Of a point, at least");
  schema.add("max_neighbor_distance", association.max_neighbor_distance, kPositive, "[m]");
  schema.add("max_plane_distance", association.max_plane_distance, kPositive, "[m]");
  schema.add("planarity_share", association.planarity_share, kShare, "Of the weight (alpha)");
  schema.add("kernel_scale", align.kernel.scale, kPositive, "Of the robust loss [m]");
  schema.add("max_iterations", align.max_iterations, {1.0, 1000.0}, "Of a scan");
  schema.add("min_residuals", align.min_residuals, {6.0, 1e6}, "Of a scan");
  schema.add("min_observability", align.min_observability, kShare, "Of a direction");
}

void bind_optimization(Schema& schema, PipelineOptions& options) {
  bind_align(schema, options.align);
  schema.add_choice<Coupling>(
      "coupling",
      options.coupling,
      {{"tight", Coupling::kTight}, {"loose", Coupling::kLoose}},
      "Of optimisation and IMU; ct_lio_continuous: always tight");
  schema.add(
      "residual_deviation", options.residual_deviation, kPositive, "With coupling: tight [m]");
  PoseObservation& observation = options.observation;
  schema.add("translation_deviation", observation.translation_deviation, kPositive, "Loose [m]");
  schema.add("rotation_deviation", observation.rotation_deviation, kPositive, "Loose [rad]");
}

void bind_lidar_only(Schema& schema, LidarOdometryOptions& lidar_only) {
  bind_align(schema, lidar_only.align);
  schema.add(
      "min_confident_share",
      lidar_only.min_confident_share,
      kShare,
      "Other starts are searched when less of a scan fits");
  schema.add(
      "max_confident_motion",
      lidar_only.max_confident_motion,
      kPositive,
      "Or when the alignment moves it by more [m]");
  schema.add(
      "max_weak_duration",
      lidar_only.max_weak_duration,
      kNotNegative,
      "How long the velocity holds without a believed frame [s]");
  StartSearchOptions& search = lidar_only.search;
  schema.add("search_voxel_size", search.voxel_size, {0.1, 10.0}, "Of the coarse map [m]");
  schema.add("search_keypoint_spacing", search.keypoint_spacing, kPositive, "[m]");
  schema.add_angle("search_turn_deg", search.turn, {0.0, 180.0}, "How far starts are turned");
}

}  // namespace

void bind(Schema& schema, PipelineOptions& options) {
  schema.add_choice<PipelineType>(
      "pipeline",
      options.type,
      {{"auto", PipelineType::kAutomatic},
       {"fast_lio", PipelineType::kFastLio},
       {"ct_lio", PipelineType::kCtLio},
       {"ct_lio_continuous", PipelineType::kCtLioContinuous},
       {"lidar_only", PipelineType::kLidarOnly}},
      "How poses are estimated");
  schema.add("threads", options.threads, {1.0, 256.0}, "Threads; the result does not depend on it");
  bind_map(schema.section("map", "The map"), options);
  bind_normals(schema.section("normals", "Normals of a scan"), options.inertial.normals);
  bind_imu(schema.section("imu", "The IMU"), options.inertial);
  bind_lidar(schema.section("lidar", "The LiDAR"), options.inertial);
  bind_matching(schema.section("matching", "Keypoints, and when to believe a frame"), options);
  bind_filter(schema.section("fast_lio", "Iterated Kalman filter"), options);
  bind_optimization(schema.section("ct_lio", "Scan-to-map optimisation"), options);
  bind_lidar_only(schema.section("lidar_only", "Odometry without an IMU"), options.lidar_only);
}

}  // namespace nvm::lio
