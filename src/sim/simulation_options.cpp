// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/schema.hpp"
#include "sim/simulation.hpp"

namespace nvm::sim {
namespace {

using config::Schema;

void bind_motion(Schema& schema, MotionOptions& motion) {
  schema.add("speed", motion.speed, {0.0, 1.1}, "The mean walking speed [m/s]; with 0 the scene's");
  schema.add(
      "still_time",
      motion.still_time,
      {2.5, 60.0},
      "The sensor keeps still for this long at the start [s]");
  schema.add("height", motion.height, {0.1, 3.0}, "The height of the IMU above the floor [m]");
  schema.add(
      "tilt_deg",
      motion.tilt_deg,
      {0.0, 45.0},
      "The mean tilt, in a direction that the seed chooses");
  schema.add("gait", motion.gait, {0.0, 2.0}, "The sway and bob of walking are multiplied by this");
  schema.add(
      "wander", motion.wander, {0.0, 2.0}, "The slow turns of the hand are multiplied by this");
  schema.add(
      "waypoint_jitter",
      motion.waypoint_jitter,
      {0.0, 0.5},
      "Each waypoint is moved by up to this, as the seed chooses [m]");
  schema.add(
      "clearance",
      motion.clearance,
      {0.0, 10.0},
      "The simulation is refused when a surface is nearer to the sensor than this [m]");
}

void bind_lidar(Schema& schema, LidarOptions& lidar) {
  constexpr config::Range kProbability{0.0, 1.0};
  constexpr config::Range kLength{0.0, 1000.0};
  schema.add("scan_rate", lidar.scan_rate, {1.0, 100.0}, "The rate of scans [Hz]");
  schema.add("min_range", lidar.min_range, kLength, "Nothing nearer than this returns [m]");
  schema.add("max_range", lidar.max_range, kLength, "Nothing farther than this returns [m]");
  schema.add("range_noise", lidar.range_noise, kLength, "The standard deviation of a range [m]");
  schema.add(
      "range_noise_per_metre",
      lidar.range_noise_per_metre,
      {0.0, 1.0},
      "That deviation grows with range by this much a metre");
  schema.add(
      "range_noise_per_tangent",
      lidar.range_noise_per_tangent,
      kLength,
      "That deviation grows at slanting incidence by this times tan(angle) [m]");
  schema.add(
      "range_bias_per_tangent",
      lidar.range_bias_per_tangent,
      {-1.0, 1.0},
      "Ranges are longer at slanting incidence by this times tan(angle) [m]");
  schema.add(
      "range_bias_dark",
      lidar.range_bias_dark,
      {-1.0, 1.0},
      "Ranges are longer on dark surfaces by this times 1 - reflectivity [m]");
  schema.add(
      "range_quantum",
      lidar.range_quantum,
      {0.0, 1.0},
      "Ranges are multiples of this [m]; with 0 they are any");
  schema.add(
      "blooming",
      lidar.blooming,
      kProbability,
      "The probability that a shot which passes a bright surface closely returns its range");
  schema.add(
      "mixed_pixels",
      lidar.mixed_pixels,
      kProbability,
      "The probability that a beam which straddles an edge returns a range in between");
  schema.add(
      "outliers", lidar.outliers, kProbability, "The probability of any range up to the true one");
  schema.add("dropouts", lidar.dropouts, kProbability, "The probability that nothing returns");
  schema.add("divergence_deg", lidar.divergence_deg, {0.0, 10.0}, "The full width of the beam");
  schema.add(
      "p_imu_lidar", lidar.p_imu_lidar, {-10.0, 10.0}, "Where the LiDAR is in the IMU frame [m]");
  schema.add(
      "rotation_imu_lidar_deg",
      lidar.rotation_imu_lidar_deg,
      {-360.0, 360.0},
      "The roll, pitch and yaw of the LiDAR in the IMU frame");
}

void bind_triad(Schema& schema, TriadNoise& triad, const std::string& unit) {
  constexpr config::Range kSize{0.0, 100.0};
  schema.add(
      "noise_density",
      triad.noise_density,
      kSize,
      "The density of the white noise [" + unit + "/sqrt(Hz)]");
  schema.add(
      "bias_walk", triad.bias_walk, kSize, "The random walk of the bias [" + unit + "/s/sqrt(Hz)]");
  schema.add(
      "initial_bias",
      triad.initial_bias,
      kSize,
      "The standard deviation of the bias at the start [" + unit + "]");
  schema.add(
      "scale_error", triad.scale_error, {0.0, 0.2}, "The standard deviation of each axis' scale");
  schema.add(
      "misalignment_deg",
      triad.misalignment_deg,
      {0.0, 20.0},
      "The standard deviation of the turn about each axis");
  schema.add(
      "vibration", triad.vibration, kSize, "The amplitude of the carrier's shaking [" + unit + "]");
}

void bind_imu(Schema& schema, ImuOptions& imu) {
  constexpr config::Range kClock{-1.0, 1.0};
  schema.add("rate", imu.rate, {10.0, 10000.0}, "The rate of readings [Hz]");
  schema.add("gravity", imu.gravity, {0.0, 100.0}, "The acceleration of gravity [m/s^2]");
  schema.add(
      "grade",
      imu.grade,
      {0.0, 100.0},
      "All errors of gyroscopes and accelerometers are multiplied by this");
  schema.add(
      "vibration_frequency",
      imu.vibration_frequency,
      {0.0, 10000.0},
      "The carrier shakes at this frequency [Hz]");
  schema.add(
      "clock_offset", imu.clock_offset, kClock, "The stamps of readings are late by this [s]");
  schema.add("clock_jitter", imu.clock_jitter, {0.0, 1.0}, "The standard deviation of a stamp [s]");
  bind_triad(schema.section("gyro", "Gyroscopes"), imu.gyro, "rad/s");
  bind_triad(schema.section("accelerometer", "Accelerometers"), imu.accelerometer, "m/s^2");
}

}  // namespace

SimulationOptions options_for(const std::string& sensor) {
  SimulationOptions options;
  options.sensor = sensor;
  options.lidar = find_sensor(sensor).defaults;
  return options;
}

void bind(Schema& schema, SimulationOptions& options) {
  bind_motion(schema.section("motion", "How the sensor is carried"), options.motion);
  bind_lidar(schema.section("lidar", "How the LiDAR errs"), options.lidar);
  bind_imu(schema.section("imu", "How the IMU errs"), options.imu);
}

}  // namespace nvm::sim
