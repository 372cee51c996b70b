// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/wall_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "eval/walls/thickness.hpp"

namespace nvm::eval {

namespace {

/// True when the rectangles of two faces overlap, seen along the normal of `a`.
bool overlap(const WallFace& a, const WallFace& b) {
  const Eigen::Vector3d offset = b.center - a.center;
  const auto overlap_along = [&](const Eigen::Vector3d& axis, double half) {
    const double half_b = std::abs(axis.dot(b.u)) * b.half_u + std::abs(axis.dot(b.v)) * b.half_v;
    return std::abs(axis.dot(offset)) < half + half_b;
  };
  return overlap_along(a.u, a.half_u) && overlap_along(a.v, a.half_v);
}

/// `gate`, or half the way to the nearest other face that looks the same way: a door leaf that
/// stands open before a wall must not lend it points.
double gate_between(const WallFace& face, const std::vector<WallPiece>& pieces, double gate) {
  constexpr double kSameSurface = 0.02;  // [m]
  for (const WallPiece& piece : pieces) {
    for (const WallFace& other : piece.faces) {
      const double separation = std::abs(face.plane.distance(other.center));
      const bool looks_alike = other.plane.normal.dot(face.plane.normal) > 0.7;
      if (looks_alike && separation > kSameSurface && overlap(face, other)) {
        gate = std::min(gate, 0.5 * separation);
      }
    }
  }
  return gate;
}

/// The frame in which a wall is drawn.
struct SectionFrame {
  Eigen::Vector3d middle;
  Eigen::Vector3d along;
  Eigen::Vector3d across;
};

SectionFrame section_frame(const WallPiece& piece) {
  const WallFace& face = piece.faces[0];
  const bool along_u = std::abs(std::abs(face.u.z()) - std::abs(face.v.z())) < 0.1
                           ? face.half_u >= face.half_v
                           : std::abs(face.u.z()) < std::abs(face.v.z());
  return {
      0.5 * (piece.faces[0].center + piece.faces[1].center),
      along_u ? face.u : face.v,
      face.plane.normal};
}

SectionFrame section_frame(const RegionFaces& faces) {
  const Eigen::Vector3d across = faces.planes[0].normal;
  const Eigen::Vector3d up =
      std::abs(across.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& points : faces.points) {
    for (const Eigen::Vector3d& p : points) {
      middle += 0.5 * p / static_cast<double>(points.size());
    }
  }
  const double half_way = 0.5 * (faces.planes[0].offset - faces.planes[1].offset);
  middle += (half_way - across.dot(middle)) * across;
  return {middle, up.cross(across).normalized(), across};
}

/// At most 1200 of the points, at even steps.
std::vector<SectionPoint> draw_section(const SidedPoints& points, const SectionFrame& frame) {
  constexpr std::size_t kMaxPoints = 1200;
  const std::size_t step = 1 + (points[0].size() + points[1].size()) / kMaxPoints;
  std::vector<SectionPoint> section;
  for (int side = 0; side < 2; ++side) {
    const auto& own = points[static_cast<std::size_t>(side)];
    for (std::size_t i = 0; i < own.size(); i += step) {
      const Eigen::Vector3d offset = own[i] - frame.middle;
      section.push_back({offset.dot(frame.along), offset.dot(frame.across), side});
    }
  }
  return section;
}

/// Adds `measured` to the weighted mean that `wall` has so far.
void add_measurement(WallEvaluation& wall, const Thickness& measured) {
  const auto weight_before = static_cast<double>(wall.points[0] + wall.points[1]);
  const auto weight =
      static_cast<double>(measured.faces[0].points.size() + measured.faces[1].points.size());
  const double share = weight / (weight_before + weight);
  const double sq_spread =
      0.5 * (std::pow(measured.faces[0].spread, 2) + std::pow(measured.faces[1].spread, 2));
  wall.thickness = (1.0 - share) * wall.thickness.value_or(0.0) + share * measured.value;
  wall.standard_error =
      std::hypot((1.0 - share) * wall.standard_error, share * measured.standard_error);
  wall.spread = std::sqrt((1.0 - share) * wall.spread * wall.spread + share * sq_spread);
  for (std::size_t side = 0; side < 2; ++side) {
    wall.points[side] += measured.faces[side].points.size();
  }
}

void add_piece(
    WallEvaluation& wall,
    const OrientedCloud& cloud,
    const WallPiece& piece,
    const std::array<FaceFitOptions, 2>& fit_options,
    const WallPointOptions& point_options) {
  const SidedPoints points = wall_points(cloud, piece, point_options);
  if (cloud.has_normals()) {
    wall.sides += count_sides(points, piece);
  }
  const auto measured =
      measure_thickness(points, {piece.faces[0].plane, piece.faces[1].plane}, fit_options);
  if (measured) {
    add_measurement(wall, *measured);
  }
  std::vector<SectionPoint> section = draw_section(points, section_frame(piece));
  if (section.size() > wall.section.size()) {
    wall.section = std::move(section);
  }
}

WallEvaluation& wall_named(std::vector<WallEvaluation>& walls, const WallPiece& piece) {
  const auto known = std::find_if(walls.begin(), walls.end(), [&](const WallEvaluation& wall) {
    return wall.name == piece.wall;
  });
  if (known != walls.end()) {
    return *known;
  }
  WallEvaluation wall;
  wall.name = piece.wall;
  wall.true_thickness = piece.thickness;
  wall.is_seen = false;
  walls.push_back(std::move(wall));
  return walls.back();
}

}  // namespace

std::optional<double> WallEvaluation::error() const {
  if (!thickness || !true_thickness) {
    return std::nullopt;
  }
  return *thickness - *true_thickness;
}

std::vector<WallEvaluation> evaluate_walls(
    const OrientedCloud& cloud, const std::vector<WallPiece>& pieces, const WallOptions& options) {
  std::vector<WallEvaluation> walls;
  for (const WallPiece& piece : pieces) {
    WallEvaluation& wall = wall_named(walls, piece);
    if (std::min(piece.faces[0].hits, piece.faces[1].hits) < options.min_hits) {
      continue;
    }
    wall.is_seen = true;
    std::array<FaceFitOptions, 2> fit_options{options.fit, options.fit};
    for (std::size_t side = 0; side < 2; ++side) {
      fit_options[side].gate = gate_between(piece.faces[side], pieces, options.fit.gate);
    }
    add_piece(wall, cloud, piece, fit_options, options.points);
  }
  return walls;
}

WallEvaluation evaluate_region(
    const OrientedCloud& cloud, const Region& region, const WallOptions& options) {
  WallEvaluation wall;
  wall.name = region.name;
  if (region.thickness > 0.0) {
    wall.true_thickness = region.thickness;
  }
  const auto faces = find_faces(cloud, region, options.points.max_normal_angle);
  if (faces) {
    const auto measured =
        measure_thickness(faces->points, faces->planes, {options.fit, options.fit});
    if (measured) {
      add_measurement(wall, *measured);
    }
    wall.section = draw_section(faces->points, section_frame(*faces));
  }
  return wall;
}

}  // namespace nvm::eval
