// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>

#include "nvm/core/target.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/storage/point_chunk.hpp"
#include "nvm/map/storage/stored_normal.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Reads every surface and every point.
struct NoGate {
  bool reads_surface(const PointChunk&) const { return true; }
  bool tests_points(const PointChunk&) const { return false; }
};

/// Reads the surfaces and the points whose normals agree with the query's (spec §3.6).
struct NormalGate {
  StoredNormal normal;
  int min_surface_dot;
  int min_point_dot;
  int all_points_dot;  // a tight surface at a larger dot than this has no point to reject
  bool reads_sightings;

  bool reads_surface(const PointChunk& head) const {
    return dot(head.direction, normal) > min_surface_dot;
  }
  bool tests_points(const PointChunk& head) const {
    return head.tight == 0 || dot(head.direction, normal) <= all_points_dot;
  }
};

/// `gate` with the normal or the sighting of a query.
inline NormalGate gate_for(NormalGate gate, const StoredNormal& normal) {
  gate.reads_sightings = is_sighting(normal);
  gate.normal = gate.reads_sightings ? view_of(normal) : normal;
  return gate;
}

/// The gate of a map with these options, but for the query's normal.
inline NormalGate normal_gate(const MapOptions& options) {
  // Two degrees cover the rounding of the two normals and of the direction.
  constexpr double kRounding = 0.035;
  NormalGate gate{};
  gate.min_surface_dot = dot_threshold(options.max_surface_angle);
  gate.min_point_dot = dot_threshold(options.max_point_angle);
  gate.all_points_dot =
      dot_threshold(std::max(0.0, options.max_point_angle - kTightAngle - kRounding));
  return gate;
}

/// Reads every surface, and the points whose own normals agree with the query's: a facing filter
/// without sides.
struct PointGate : NormalGate {
  explicit PointGate(const NormalGate& gate) : NormalGate(gate) {}
  bool reads_surface(const PointChunk&) const { return true; }
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
