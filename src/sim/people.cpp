// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/people.hpp"

#include <algorithm>
#include <cmath>

#include "sim/angles.hpp"

namespace nvm::sim {
namespace {

double length_of(const std::vector<Eigen::Vector3d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i] - path[i - 1]).norm();
  }
  return length;
}

Cylinder body_of(const Person& person, double time) {
  Cylinder body;
  body.radius = person.radius;
  body.half_height = 0.5 * person.height;
  const Eigen::Vector3d middle = body.half_height * Eigen::Vector3d::UnitZ();
  body.T_world_cylinder = shift(place_of(person, time) + middle);
  return body;
}

}  // namespace

Eigen::Vector3d place_of(const Person& person, double time) {
  const double length = length_of(person.path);
  if (length <= 0.0) {
    return person.path.front();
  }
  const double walked = std::fmod(person.speed * time, 2.0 * length);
  double left = std::min(walked, 2.0 * length - walked);
  for (std::size_t i = 1; i < person.path.size(); ++i) {
    const Eigen::Vector3d leg = person.path[i] - person.path[i - 1];
    const double leg_length = leg.norm();
    if (left < leg_length) {
      return person.path[i - 1] + left / leg_length * leg;
    }
    left -= leg_length;
  }
  return person.path.back();
}

std::optional<Entry> meet_people(
    const std::vector<Person>& people,
    double time,
    const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction) {
  std::optional<Entry> nearest;
  for (const Person& person : people) {
    const auto entry = enter_cylinder(body_of(person, time), origin, direction);
    if (entry && (!nearest || entry->range < nearest->range)) {
      nearest = entry;
    }
  }
  return nearest;
}

}  // namespace nvm::sim
