// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/schema.hpp"
#include "sim/simulation.hpp"

namespace nvm::sim {
namespace {

using config::Schema;

void bind_motion(Schema& schema, MotionOptions& motion) {
  schema.add("speed", motion.speed, {0.0, 1.1}, "Mean walking speed [m/s]; 0: the scene's");
  schema.add("still_time", motion.still_time, {2.5, 60.0}, "Stillness at the start [s]");
  schema.add("height", motion.height, {0.1, 3.0}, "Of the IMU above the floor [m]");
  schema.add("tilt_deg", motion.tilt_deg, {0.0, 45.0}, "Mean tilt, in a direction by the seed");
  schema.add("gait", motion.gait, {0.0, 2.0}, "Scale of the sway and bob of walking");
  schema.add("wander", motion.wander, {0.0, 2.0}, "Scale of the slow turns of the hand");
  schema.add(
      "waypoint_jitter",
      motion.waypoint_jitter,
      {0.0, 0.5},
      "Each waypoint is moved by up to this, by the seed [m]");
  schema.add(
      "clearance",
      motion.clearance,
      {0.0, 10.0},
      "From the sensor to any surface, else the simulation is refused [m]");
}

void bind_lidar(Schema& schema, LidarOptions& lidar) {
  constexpr config::Range kProbability{0.0, 1.0};
  constexpr config::Range kLength{0.0, 1000.0};
  schema.add("scan_rate", lidar.scan_rate, {1.0, 100.0}, "[Hz]");
  schema.add("min_range", lidar.min_range, kLength, "[m]");
  schema.add("max_range", lidar.max_range, kLength, "[m]");
  schema.add("range_noise", lidar.range_noise, kLength, "Standard deviation [m]");
  schema.add(
      "range_noise_per_metre", lidar.range_noise_per_metre, {0.0, 1.0}, "More of it at long range");
  schema.add(
      "range_noise_per_tangent",
      lidar.range_noise_per_tangent,
      kLength,
      "More of it at slanting incidence: times tan(angle) [m]");
  schema.add(
      "range_bias_per_tangent",
      lidar.range_bias_per_tangent,
      {-1.0, 1.0},
      "Longer at slanting incidence, by this times tan(angle) [m]");
  schema.add(
      "range_bias_dark",
      lidar.range_bias_dark,
      {-1.0, 1.0},
      "Longer on dark surfaces, by this times 1 - reflectivity [m]");
  schema.add(
      "range_quantum", lidar.range_quantum, {0.0, 1.0}, "Ranges are multiples of it [m]; 0: any");
  schema.add(
      "blooming",
      lidar.blooming,
      kProbability,
      "Probability that a shot which passes a bright surface closely returns its range");
  schema.add(
      "mixed_pixels",
      lidar.mixed_pixels,
      kProbability,
      "Probability that a beam which straddles an edge returns a range in between");
  schema.add(
      "outliers", lidar.outliers, kProbability, "Probability of any range up to the true one");
  schema.add("dropouts", lidar.dropouts, kProbability, "Probability that nothing returns");
  schema.add("divergence_deg", lidar.divergence_deg, {0.0, 10.0}, "Full width of the beam");
  schema.add("p_imu_lidar", lidar.p_imu_lidar, {-10.0, 10.0}, "The LiDAR in the IMU frame [m]");
  schema.add(
      "rotation_imu_lidar_deg",
      lidar.rotation_imu_lidar_deg,
      {-360.0, 360.0},
      "Roll, pitch and yaw of the LiDAR in the IMU frame");
}

void bind_triad(Schema& schema, TriadNoise& triad, const std::string& unit) {
  constexpr config::Range kSize{0.0, 100.0};
  schema.add("noise_density", triad.noise_density, kSize, "White noise [" + unit + "/sqrt(Hz)]");
  schema.add("bias_walk", triad.bias_walk, kSize, "Walk of the bias [" + unit + "/s/sqrt(Hz)]");
  schema.add(
      "initial_bias",
      triad.initial_bias,
      kSize,
      "Standard deviation of the bias at the start [" + unit + "]");
  schema.add(
      "scale_error", triad.scale_error, {0.0, 0.2}, "Standard deviation of the scale per axis");
  schema.add(
      "misalignment_deg",
      triad.misalignment_deg,
      {0.0, 20.0},
      "Standard deviation of the turn about each axis");
  schema.add(
      "vibration", triad.vibration, kSize, "Amplitude of the carrier's shaking [" + unit + "]");
}

void bind_imu(Schema& schema, ImuOptions& imu) {
  constexpr config::Range kClock{-1.0, 1.0};
  schema.add("rate", imu.rate, {10.0, 10000.0}, "[Hz]");
  schema.add("gravity", imu.gravity, {0.0, 100.0}, "[m/s^2]");
  schema.add("grade", imu.grade, {0.0, 100.0}, "Factor of all errors of gyro and accelerometer");
  schema.add("vibration_frequency", imu.vibration_frequency, {0.0, 10000.0}, "[Hz]");
  schema.add("clock_offset", imu.clock_offset, kClock, "Its stamps are late by this [s]");
  schema.add("clock_jitter", imu.clock_jitter, {0.0, 1.0}, "Standard deviation of a stamp [s]");
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
