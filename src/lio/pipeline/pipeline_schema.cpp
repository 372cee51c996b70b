// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/schema.hpp"
#include "lio/pipeline/estimator_schema.hpp"
#include "lio/pipeline/pipeline_options.hpp"

namespace nvm::lio {

namespace {

using config::Range;
using config::Schema;

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
      "What kind of map: nvm has two sides, voxel knows no normals, facing and reject filter by "
      "normals in and after the query, kdtree is a k-d tree of bare points");
  visit_options(options.map, OptionBinder{schema});
}

void bind_normals(Schema& schema, NormalOptions& normals) {
  schema.add_choice<NormalMethod>(
      "method",
      normals.method,
      {{"block_tree", NormalMethod::kBlockTree}, {"per_cell", NormalMethod::kPerCell}},
      "Whether each point has a neighbourhood of its own, or those of a cell share one, which is "
      "several times as fast and coarser");
  schema.add(
      "cell_size",
      normals.cell_size,
      {0.001, 1000.0},
      "Edge of a cell, where method is per_cell [m]");
  schema.add(
      "min_radius",
      normals.min_radius,
      {0.001, 1000.0},
      "The radius of a neighbourhood at min_range [m]");
  schema.add(
      "max_radius",
      normals.max_radius,
      {0.001, 1000.0},
      "The radius of a neighbourhood at max_range [m]");
  schema.add(
      "min_range", normals.min_range, {0.0, 1e4}, "The range where the radius begins to grow [m]");
  schema.add(
      "max_range", normals.max_range, {0.0, 1e4}, "The range where the radius stops to grow [m]");
  schema.add(
      "widening",
      normals.widening,
      {1.0, 10.0},
      "The radius is this much larger where neighbours form a line; with 1 it is not");
  schema.add(
      "min_neighbors",
      normals.min_neighbors,
      {3.0, 1e6},
      "A neighbourhood has at least this many points");
  schema.add(
      "max_linearity",
      normals.max_linearity,
      {0.334, 1.0},
      "A plane's first eigenvalue has at most this share of their sum; more is a line");
  schema.add(
      "max_surface_variation",
      normals.max_surface_variation,
      {0.0, 0.334},
      "A plane's third eigenvalue has at most this share of their sum; more is a volume");
}

void bind_imu(Schema& schema, InertialOptions& inertial) {
  ImuNoise& noise = inertial.imu_noise;
  schema.add(
      "gyro_noise",
      noise.gyro,
      kNotNegative,
      "The noise density of the gyroscope [rad/s/sqrt(Hz)]; 0: learned from its readings");
  schema.add(
      "accel_noise",
      noise.accel,
      kNotNegative,
      "The noise density of the accelerometer [m/s^2/sqrt(Hz)]; 0: learned from its readings");
  schema.add(
      "gyro_bias_walk",
      noise.gyro_bias,
      kPositive,
      "The random walk of the gyroscope's bias [rad/s^2/sqrt(Hz)]");
  schema.add(
      "gyro_scale_noise",
      noise.gyro_scale,
      kNotNegative,
      "The noise density of the gyroscope for each rad/s that it turns [1/sqrt(Hz)]");
  schema.add(
      "accel_bias_walk",
      noise.accel_bias,
      kPositive,
      "The random walk of the accelerometer's bias [m/s^3/sqrt(Hz)]");
  schema.add(
      "max_gap",
      inertial.max_imu_gap,
      kNotNegative,
      "Readings farther apart than this leave a gap [s]; with 0, four times the usual step");
  ImuInputOptions& input = inertial.imu_input;
  schema.add(
      "gyro_scale",
      input.gyro_scale,
      "Angular rates times this are in rad/s; with 0 the data tell");
  schema.add(
      "accel_scale",
      input.accel_scale,
      "Accelerations times this are in m/s^2, so -1 mends a wrong sign; with 0 the data tell");
  schema.add("time_offset", input.time_offset, "This is added to the IMU's times [s]");
  schema.add(
      "learn_time_offset",
      input.learns_time_offset,
      "The rest of it is learned from the turns of scans and gyroscope");
  schema.add(
      "learn_rotation",
      input.learns_rotation,
      "So is a rotation of T_imu_lidar that is off by degrees");
  InitializerOptions& initializer = inertial.initializer;
  schema.add(
      "still_duration",
      initializer.still_duration,
      {0.2, 10.0},
      "The IMU must be still for this long at the start [s]");
  schema.add(
      "max_still_gyro",
      initializer.max_still_gyro,
      kPositive,
      "Still means that angular rates scatter by at most this [rad/s]");
  schema.add(
      "max_still_accel",
      initializer.max_still_accel,
      kPositive,
      "Still means that accelerations scatter by at most this [m/s^2]");
  schema.add(
      "max_still_rate",
      initializer.max_still_rate,
      kPositive,
      "Still means that the mean angular rate is at most this [rad/s]");
  schema.add(
      "moving_start_after",
      initializer.moving_start_after,
      "A moving sensor starts without the IMU after this long [s]; when negative, never");
  schema.add("gravity", initializer.gravity, {1.0, 30.0}, "The acceleration of gravity [m/s^2]");
}

void bind_lidar(Schema& schema, InertialOptions& inertial) {
  schema.add(
      "min_range",
      inertial.returns.min_range,
      kNotNegative,
      "Returns nearer than this are left out [m]");
  schema.add(
      "max_range",
      inertial.returns.max_range,
      kPositive,
      "Returns farther than this are left out [m]");
  schema.add(
      "max_points",
      inertial.returns.max_count,
      {100.0, 1e8},
      "A scan of more points is thinned to about as many where it is densest");
  schema.add(
      "extrinsic_translation_deviation",
      inertial.extrinsic_translation_deviation,
      kNotNegative,
      "How unsure the translation of T_imu_lidar is [m]; with 0 it is not estimated");
  schema.add(
      "extrinsic_rotation_deviation",
      inertial.extrinsic_rotation_deviation,
      kNotNegative,
      "How unsure the rotation of T_imu_lidar is [rad]; with 0 it is not estimated");
}

void bind_matching(Schema& schema, PipelineOptions& options) {
  InertialOptions& inertial = options.inertial;
  schema.add(
      "max_plane_offset",
      inertial.max_plane_offset,
      kNotNegative,
      "Points move onto the plane of their neighbourhood by at most this [m]; with 0 they stay");
  schema.add(
      "keypoint_spacing",
      inertial.keypoints.spacing,
      kPositive,
      "Keypoints are about this far apart [m]");
  schema.add(
      "max_keypoints",
      inertial.keypoints.max_count,
      {10.0, 1e5},
      "A scan has at most this many keypoints");
  schema.add(
      "min_keypoints",
      inertial.keypoints.min_count,
      {0.0, 1e5},
      "The spacing is halved, up to three times, until a scan has this many keypoints");
  schema.add(
      "min_inlier_share",
      inertial.min_inlier_share,
      kShare,
      "A scan is believed when at least this share of it fits the map");
  schema.add(
      "max_weak_duration",
      inertial.max_weak_duration,
      kNotNegative,
      "After this long without a believed scan the pose is lost [s]");
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
  schema.add(
      "threads",
      options.threads,
      {1.0, 256.0},
      "How many threads work; the result does not depend on it");
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
