// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/walk.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/random.hpp"

namespace nvm::sim {
namespace {

constexpr double kRestTime = 2.0;         ///< standing at the end [s]
constexpr double kSpeedVariation = 0.08;  ///< of the mean speed
constexpr double kSpeedFrequency = 0.07;  ///< of that variation [Hz]

/// The route's waypoints over all laps, each moved by up to `jitter` in x and y.
std::vector<Eigen::Vector3d> corners_of(const Route& route, double jitter, std::uint64_t seed) {
  const std::vector<Eigen::Vector3d>& waypoints = route.waypoints;
  const bool is_closed = (waypoints.front() - waypoints.back()).norm() < 1e-9;
  if (route.laps > 1 && !is_closed) {
    throw std::invalid_argument("a route of several laps must end where it begins");
  }
  std::vector<Eigen::Vector3d> corners;
  for (int lap = 0; lap < route.laps; ++lap) {
    for (std::size_t i = lap == 0 ? 0 : 1; i < waypoints.size(); ++i) {
      Random random(seed, Stream::kRoute, corners.size());
      const double dx = random.uniform(-jitter, jitter);
      const double dy = random.uniform(-jitter, jitter);
      corners.emplace_back(waypoints[i] + Eigen::Vector3d(dx, dy, 0.0));
    }
  }
  return corners;
}

/// Headings of the segments, each within pi of the one before.
std::vector<double> headings_of(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<double> headings;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Eigen::Vector3d step = corners[i + 1] - corners[i];
    const double heading = std::atan2(step.y(), step.x());
    const double previous = headings.empty() ? 0.0 : headings.back();
    headings.push_back(previous + std::remainder(heading - previous, 2.0 * M_PI));
  }
  return headings;
}

}  // namespace

Walk::Walk(const Route& route, const MotionOptions& options, std::uint64_t seed, double lead)
    : start_time_(options.still_time + lead),
      speed_(options.speed > 0.0 ? options.speed : route.speed),
      speed_phase_(Random(seed, Stream::kGait, 0).uniform(0.0, 2.0 * M_PI)) {
  if (route.waypoints.size() < 2) {
    throw std::invalid_argument("the scene has no route: it needs two waypoints at least");
  }
  corners_ = corners_of(route, options.waypoint_jitter, seed);
  headings_ = headings_of(corners_);
  distances_.push_back(0.0);
  for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
    const double length = (corners_[i + 1] - corners_[i]).norm();
    if (length < 0.1) {
      throw std::invalid_argument("waypoints of a route must be at least 0.1 m apart");
    }
    distances_.push_back(distances_.back() + length);
  }
}

double Walk::duration() const {
  return start_time_ + distances_.back() / (speed_ * (1.0 - kSpeedVariation)) + kRestTime;
}

double Walk::distance(double time) const {
  const double walked = std::max(0.0, time - start_time_);
  const double rate = 2.0 * M_PI * kSpeedFrequency;
  const double variation =
      kSpeedVariation / rate * (std::cos(speed_phase_) - std::cos(rate * walked + speed_phase_));
  return std::min(speed_ * (walked + variation), distances_.back());
}

std::size_t Walk::segment(double distance) const {
  const auto next = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, distance);
  return static_cast<std::size_t>(next - distances_.begin()) - 1;
}

Eigen::Vector3d Walk::position(double time) const {
  const double s = distance(time);
  const std::size_t i = segment(s);
  const double share = (s - distances_[i]) / (distances_[i + 1] - distances_[i]);
  return corners_[i] + share * (corners_[i + 1] - corners_[i]);
}

double Walk::heading(double time) const { return headings_[segment(distance(time))]; }

double Walk::activity(double time) const {
  return time > start_time_ && distance(time) < distances_.back() ? 1.0 : 0.0;
}

}  // namespace nvm::sim
