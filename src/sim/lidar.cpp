// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/lidar.hpp"

#include <algorithm>
#include <cmath>

#include "sim/angles.hpp"
#include "sim/people.hpp"

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
    const Shot aim{
        index * shots + shot,
        result.scan.t_begin + static_cast<double>(dt),
        T_world_lidar.translation(),
        T_world_lidar.linear() * firing.direction};
    if (const auto hit = shoot(aim)) {
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
std::optional<Lidar::Return> Lidar::shoot(const Shot& shot) const {
  Random random(seed_, Stream::kLidar, shot.index);
  Random luck(seed_, Stream::kLidarLuck, shot.index);
  const double pass = random.uniform();
  const bool is_lost = random.uniform() < options_.dropouts;
  const bool is_outlier = random.uniform() < options_.outliers;
  const bool may_mix = random.uniform() < options_.mixed_pixels;
  const double share = random.uniform();
  const auto echo = hear(shot, pass, luck);
  if (is_lost || !echo) {
    return std::nullopt;
  }
  Return result;
  result.range = measured_range(*echo, random);
  result.intensity = kFullIntensity * echo->reflectivity * echo->cosine;
  result.truth = echo->truth;
  if (may_mix) {
    if (const auto mixed = mixed_range(*echo, shot, random)) {
      result.range = *mixed;
      result.truth.origin = Origin::kMixedPixel;
    }
  }
  if (luck.uniform() < options_.blooming) {
    if (const auto bright = bright_range(shot, luck)) {
      result.range = *bright;
      result.truth.origin = Origin::kBlooming;
    }
  }
  if (is_outlier) {
    result.range = share * echo->range;
    result.truth.origin = Origin::kOutlier;
  }
  if (options_.range_quantum > 0.0) {
    result.range = options_.range_quantum * std::round(result.range / options_.range_quantum);
  }
  if (result.range < options_.min_range || result.range > options_.max_range) {
    return std::nullopt;
  }
  return result;
}

/// Follows the light over mirrors to what throws it back, and takes all of its way for straight, as
/// the sensor does.
std::optional<Lidar::Echo> Lidar::hear(const Shot& shot, double pass, Random& luck) const {
  constexpr int kMostMirrors = 3;
  constexpr double kOffTheMirror = 1e-6;  // [m]
  Shot ray = shot;
  double before = 0.0;
  for (int mirrors = 0; mirrors <= kMostMirrors; ++mirrors) {
    auto echo = first_surface(ray, pass);
    if (!echo) {
      return std::nullopt;
    }
    const double range = echo->range;
    echo->range += before;
    if (mirrors > 0) {
      echo->truth.origin = Origin::kMirror;
    }
    if (echo->mirror <= luck.uniform()) {
      return echo;
    }
    before += range;
    ray.origin += range * ray.direction + kOffTheMirror * echo->normal;
    ray.direction -= 2.0 * ray.direction.dot(echo->normal) * echo->normal;
  }
  return std::nullopt;
}

std::optional<Lidar::Echo> Lidar::first_surface(const Shot& ray, double pass) const {
  constexpr double kClothes = 0.4;  // reflectivity
  const auto hit = world_.rays.cast(ray.origin, ray.direction, options_.max_range + 1.0, pass);
  const auto person = meet_people(world_.scene.people, ray.time, ray.origin, ray.direction);
  const auto cosine = [&](const Eigen::Vector3d& normal) {
    return std::abs(normal.dot(ray.direction));
  };
  if (person && (!hit || person->range < hit->range)) {
    return Echo{
        person->range,
        person->normal,
        cosine(person->normal),
        kClothes,
        0.0,
        {Origin::kPerson, {}}};
  }
  if (!hit) {
    return std::nullopt;
  }
  const Material& material = object_material(world_.scene, hit->surface.object);
  return Echo{
      hit->range,
      hit->normal,
      cosine(hit->normal),
      material.reflectivity,
      material.mirror,
      {Origin::kSurface, hit->surface}};
}

double Lidar::measured_range(const Echo& echo, Random& random) const {
  const double c = std::max(echo.cosine, kMinCosine);
  const double tangent = std::sqrt(std::max(0.0, 1.0 - c * c)) / c;
  const double sigma = std::hypot(
      options_.range_noise,
      options_.range_noise_per_metre * echo.range,
      options_.range_noise_per_tangent * tangent);
  const double bias = options_.range_bias_per_tangent * tangent +
                      options_.range_bias_dark * (1.0 - echo.reflectivity);
  return echo.range + bias + sigma * random.gaussian();
}

/// A range between the surface that the beam's centre hits and one that its rim hits, when they are
/// farther apart than a slanting surface would be.
std::optional<double> Lidar::mixed_range(const Echo& echo, const Shot& shot, Random& random) const {
  constexpr double kMinGap = 0.1;  // [m]
  const Shot rim = beside(shot, 0.5 * rad(options_.divergence_deg), random);
  const auto other = world_.rays.cast(rim.origin, rim.direction, options_.max_range + 1.0);
  if (!other || std::abs(other->range - echo.range) < kMinGap) {
    return std::nullopt;
  }
  return echo.range + random.uniform() * (other->range - echo.range);
}

/// The range of a bright surface close to where the beam goes: its light floods the detector.
std::optional<double> Lidar::bright_range(const Shot& shot, Random& random) const {
  constexpr double kBright = 0.9;  // reflectivity
  constexpr double kReachDeg = 1.0;
  const auto near = first_surface(beside(shot, rad(kReachDeg) * random.uniform(), random), 1.0);
  if (!near || near->reflectivity < kBright) {
    return std::nullopt;
  }
  return measured_range(*near, random);
}

Lidar::Shot Lidar::beside(const Shot& shot, double offset, Random& random) {
  const double angle = random.uniform(0.0, 2.0 * M_PI);
  const Eigen::Vector3d side = shot.direction.unitOrthogonal();
  const Eigen::Vector3d outward =
      std::cos(angle) * side + std::sin(angle) * shot.direction.cross(side);
  return {shot.index, shot.time, shot.origin, (shot.direction + offset * outward).normalized()};
}

}  // namespace nvm::sim
