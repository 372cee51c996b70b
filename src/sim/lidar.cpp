// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/lidar.hpp"

#include <algorithm>
#include <cmath>

#include "sim/angles.hpp"

namespace nvm::sim {
namespace {

constexpr double kFullIntensity = 255.0;  ///< of a white surface seen head-on
constexpr double kMinCosine = 0.1;        ///< of the incidence, where its noise stops growing

}  // namespace

Lidar::Lidar(
    const SensorModel& sensor, const LidarOptions& options, const World& world, std::uint64_t seed)
    : sensor_(sensor),
      options_(options),
      world_(world),
      seed_(seed),
      T_imu_lidar_(
          make_pose(euler_rotation_deg(options.rotation_imu_lidar_deg), options.p_imu_lidar)) {}

SimulatedScan Lidar::scan(std::size_t index) const {
  const std::size_t shots = sensor_.shots_per_scan(options_.scan_rate);
  SimulatedScan result;
  result.scan.t_begin = static_cast<double>(index) / options_.scan_rate;
  result.scan.t_end = static_cast<double>(index + 1) / options_.scan_rate;
  result.scan.points.reserve(shots);
  result.truth.reserve(shots);
  for (std::size_t shot = 0; shot < shots; ++shot) {
    const Firing firing = sensor_.firing(index, shot, options_.scan_rate);
    const auto dt = static_cast<float>(firing.dt);
    const Pose T_world_lidar =
        world_.motion.pose(result.scan.t_begin + static_cast<double>(dt)) * T_imu_lidar_;
    Random random(seed_, Stream::kLidar, index * shots + shot);
    const auto hit =
        shoot(T_world_lidar.translation(), T_world_lidar.linear() * firing.direction, random);
    if (hit) {
      const Eigen::Vector3f p = (hit->range * firing.direction).cast<float>();
      result.scan.points.push_back(
          {p.x(), p.y(), p.z(), static_cast<float>(hit->intensity), dt, firing.ring});
      result.truth.push_back(hit->truth);
    }
  }
  return result;
}

/// Draws its random numbers in a fixed order, whatever the options, so that runs that differ in one
/// option share the rest.
std::optional<Lidar::Return> Lidar::shoot(
    const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, Random& random) const {
  const double pass = random.uniform();
  const bool is_lost = random.uniform() < options_.dropouts;
  const bool is_outlier = random.uniform() < options_.outliers;
  const bool may_mix = random.uniform() < options_.mixed_pixels;
  const double share = random.uniform();
  const auto hit = world_.rays.cast(origin, direction, options_.max_range + 1.0, pass);
  if (is_lost || !hit) {
    return std::nullopt;
  }
  const double cosine = std::abs(hit->normal.dot(direction));
  Return result;
  result.range = measured_range(*hit, cosine, random);
  result.intensity =
      kFullIntensity * object_material(world_.scene, hit->surface.object).reflectivity * cosine;
  result.truth.surface = hit->surface;
  if (may_mix) {
    if (const auto mixed = mixed_range(*hit, origin, direction, random)) {
      result.range = *mixed;
      result.truth.origin = Origin::kMixedPixel;
    }
  }
  if (is_outlier) {
    result.range = share * hit->range;
    result.truth.origin = Origin::kOutlier;
  }
  if (result.range < options_.min_range || result.range > options_.max_range) {
    return std::nullopt;
  }
  return result;
}

double Lidar::measured_range(const RayHit& hit, double cosine, Random& random) const {
  const double c = std::max(cosine, kMinCosine);
  const double tangent = std::sqrt(std::max(0.0, 1.0 - c * c)) / c;
  const double sigma = std::hypot(
      options_.range_noise,
      options_.range_noise_per_metre * hit.range,
      options_.range_noise_per_tangent * tangent);
  return hit.range + sigma * random.gaussian();
}

/// A range between the surface that the beam's centre hits and one that its rim hits, when they are
/// farther apart than a slanting surface would be.
std::optional<double> Lidar::mixed_range(
    const RayHit& hit,
    const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction,
    Random& random) const {
  constexpr double kMinGap = 0.1;  // [m]
  const double rim = 0.5 * rad(options_.divergence_deg);
  const double angle = random.uniform(0.0, 2.0 * M_PI);
  const Eigen::Vector3d side = direction.unitOrthogonal();
  const Eigen::Vector3d offset = std::cos(angle) * side + std::sin(angle) * direction.cross(side);
  const auto other =
      world_.rays.cast(origin, (direction + rim * offset).normalized(), options_.max_range + 1.0);
  if (!other || std::abs(other->range - hit.range) < kMinGap) {
    return std::nullopt;
  }
  return hit.range + random.uniform() * (other->range - hit.range);
}

}  // namespace nvm::sim
