// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/sensor_model.hpp"

#include <cmath>
#include <stdexcept>

#include "sim/angles.hpp"

namespace nvm::sim {
namespace {

Eigen::Vector3d spherical(double azimuth, double elevation) {
  return {
      std::cos(elevation) * std::cos(azimuth),
      std::cos(elevation) * std::sin(azimuth),
      std::sin(elevation)};
}

/// A wave of period 1 that goes straight from -1 to 1 and back.
double triangle_wave(double phase) { return 4.0 * std::abs(phase - std::floor(phase + 0.5)) - 1.0; }

Firing spinning(const SensorModel& sensor, std::size_t shot, double scan_rate) {
  const std::size_t lasers = sensor.elevations_deg.size();
  const std::size_t laser = shot % lasers;
  const std::size_t column = shot / lasers;
  const std::size_t columns = sensor.shots_per_scan(scan_rate) / lasers;
  const double column_time =
      static_cast<double>(column) / (static_cast<double>(columns) * scan_rate);
  Firing firing;
  firing.dt = column_time + static_cast<double>(laser) * sensor.laser_delay;
  firing.direction =
      spherical(M_PI - 2.0 * M_PI * scan_rate * firing.dt, rad(sensor.elevations_deg[laser]));
  firing.ring = static_cast<std::uint16_t>(laser);
  return firing;
}

/// The rates are no simple multiples of each other or of a scan, so that scans do not repeat.
Eigen::Vector3d nodding(const SensorModel& sensor, double time, double line) {
  constexpr double kTurns = 26.18;  // [Hz]
  constexpr double kNods = 411.37;  // [Hz]
  constexpr double kMinElevation = rad(-7.0);
  constexpr double kMaxElevation = rad(52.0);
  const double offset = line / sensor.lines;
  const double nod = triangle_wave(kNods * time + 0.618 * offset);
  const double elevation =
      0.5 * (kMinElevation + kMaxElevation) + 0.5 * (kMaxElevation - kMinElevation) * nod;
  return spherical(2.0 * M_PI * (kTurns * time + offset), elevation);
}

/// Two prisms of equal strength that turn against each other.
Eigen::Vector3d rosette(const SensorModel& sensor, double time, double line) {
  constexpr double kFirstPrism = 121.57;   // [Hz]
  constexpr double kSecondPrism = -77.73;  // [Hz]
  constexpr double kHalfAngle = rad(35.2);
  constexpr double kLineSpacing = rad(1.36);
  const double first = 2.0 * M_PI * kFirstPrism * time;
  const double second = 2.0 * M_PI * kSecondPrism * time;
  const double azimuth = 0.5 * kHalfAngle * (std::cos(first) + std::cos(second));
  const double elevation = 0.5 * kHalfAngle * (std::sin(first) + std::sin(second));
  return spherical(azimuth, elevation + kLineSpacing * (line - 0.5 * (sensor.lines - 1)));
}

/// `count` elevations from `top_deg` down to -`top_deg`.
std::vector<double> even_elevations(int count, double top_deg) {
  std::vector<double> elevations;
  elevations.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    elevations.push_back(top_deg - 2.0 * top_deg * i / (count - 1));
  }
  return elevations;
}

SensorModel ouster(const std::string& name, int lasers, double top_deg, double max_range) {
  SensorModel sensor;
  sensor.name = name;
  sensor.description = "spinning, " + std::to_string(lasers) + " lasers, 1024 columns at 10 Hz";
  sensor.elevations_deg = even_elevations(lasers, top_deg);
  sensor.points_per_second = 10240.0 * lasers;
  sensor.defaults.min_range = 0.3;
  sensor.defaults.max_range = max_range;
  sensor.defaults.divergence_deg = 0.2;
  sensor.defaults.p_imu_lidar = {-0.0063, 0.0118, 0.0285};
  sensor.defaults.rotation_imu_lidar_deg = {0.0, 0.0, 180.0};
  return sensor;
}

SensorModel mid360() {
  SensorModel sensor;
  sensor.name = "mid360";
  sensor.description = "Livox Mid-360 like: non-repetitive, 360 x 59 degrees, 200 000 shots/s";
  sensor.pattern = ScanPattern::kNodding;
  sensor.lines = 4;
  sensor.points_per_second = 200000.0;
  sensor.defaults.max_range = 40.0;
  sensor.defaults.divergence_deg = 0.2;
  sensor.defaults.p_imu_lidar = {-0.011, -0.0233, 0.0441};
  return sensor;
}

SensorModel avia() {
  SensorModel sensor;
  sensor.name = "avia";
  sensor.description = "Livox Avia like: non-repetitive, 70 x 77 degrees ahead, 240 000 shots/s";
  sensor.pattern = ScanPattern::kRosette;
  sensor.lines = 6;
  sensor.points_per_second = 240000.0;
  sensor.defaults.min_range = 0.5;
  sensor.defaults.max_range = 190.0;
  sensor.defaults.divergence_deg = 0.16;
  sensor.defaults.p_imu_lidar = {0.0417, 0.0233, -0.0284};
  return sensor;
}

/// Lasers in the order in which the VLP-16 fires them; a sequence takes 55.296 us.
SensorModel vlp16() {
  SensorModel sensor;
  sensor.name = "vlp16";
  sensor.description = "Velodyne VLP-16 like: spinning, 16 lasers, 1800 columns at 10 Hz";
  for (int i = 0; i < 16; ++i) {
    sensor.elevations_deg.push_back(i % 2 == 0 ? i - 15 : i);
  }
  sensor.laser_delay = 2.304e-6;
  sensor.points_per_second = 288000.0;
  sensor.defaults.min_range = 0.5;
  sensor.defaults.divergence_deg = 0.18;
  sensor.defaults.p_imu_lidar = {0.02, -0.01, 0.09};
  return sensor;
}

}  // namespace

std::size_t SensorModel::shots_per_scan(double scan_rate) const {
  const std::size_t group = pattern == ScanPattern::kSpinning ? elevations_deg.size() : 1;
  const double groups = points_per_second / (static_cast<double>(group) * scan_rate);
  return group * static_cast<std::size_t>(std::llround(groups));
}

Firing SensorModel::firing(std::size_t scan, std::size_t shot, double scan_rate) const {
  if (pattern == ScanPattern::kSpinning) {
    return spinning(*this, shot, scan_rate);
  }
  Firing firing;
  firing.dt = static_cast<double>(shot) / points_per_second;
  firing.ring = static_cast<std::uint16_t>(shot % static_cast<std::size_t>(lines));
  const double time = static_cast<double>(scan) / scan_rate + firing.dt;
  firing.direction = pattern == ScanPattern::kNodding ? nodding(*this, time, firing.ring)
                                                      : rosette(*this, time, firing.ring);
  return firing;
}

const std::vector<SensorModel>& sensor_models() {
  static const std::vector<SensorModel> models{
      mid360(),
      avia(),
      vlp16(),
      ouster("os0_32", 32, 45.0, 50.0),
      ouster("os0_128", 128, 45.0, 50.0),
      ouster("os1_64", 64, 22.5, 120.0)};
  return models;
}

const SensorModel& find_sensor(const std::string& name) {
  std::string known;
  for (const SensorModel& sensor : sensor_models()) {
    if (sensor.name == name) {
      return sensor;
    }
    known += " " + sensor.name;
  }
  throw std::invalid_argument("no sensor \"" + name + "\": the known ones are" + known);
}

}  // namespace nvm::sim
