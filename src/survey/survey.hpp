// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "eval/walls/oriented_plane.hpp"
#include "io/result/map_cloud.hpp"
#include "survey/sightings.hpp"
#include "survey/survey_options.hpp"

namespace nvm::survey {

/// A closed line in the map's frame [m], without its first point again at the end.
using Polygon = std::vector<Eigen::Vector3d>;

/// A planar surface as a list has it; map frame. Seen from where its normal points to, its outline
/// runs counter-clockwise.
struct SurveyFace {
  eval::OrientedPlane plane;   ///< {p : normal . p = offset}
  Polygon polygon;             ///< outline of the largest part, gaps like doors included
  std::vector<Polygon> parts;  ///< outlines of further parts
  std::size_t points = 0;      ///< of the map, that lie on it
  double area = 0.0;           ///< that they cover [m²]
  double rms = 0.0;            ///< of their distances to the plane [m]
  double bow = 0.0;  ///< largest distance of their mean over half a metre to the plane [m]
};

/// What two faces back to back are taken for, by their shape.
enum class WallKind {
  kWall,       ///< upright and taller than 1.9 m
  kPartition,  ///< upright and lower
  kDoor,       ///< upright, at most 7 cm thick, with the edges of a door leaf
  kSlab,       ///< level, 4 m² or more
  kPanel,      ///< level and smaller, as a table's top
  kSloped,     ///< neither upright nor level
  kColumn,     ///< not much wider than thick
  kFurniture,  ///< thick and low, or a front before a wall that is thinner beside it
};

/// The name of `kind` in files: "wall", "partition", ...
std::string kind_name(WallKind kind);

/// Whether the sensor saw both sides of a wall in one go.
enum class Passes {
  kUnknown,  ///< without keyframes, or when they do not show a side
  kOne,      ///< it went from one side to the other within 10 s
  kTwo,
};

/// The name of `passes` in files: "unknown", "one", "two".
std::string passes_name(Passes passes);

/// A region within a wall's outline that neither side shows.
struct Opening {
  std::string kind;    ///< "door" from the floor, "passage" over all the height, "window", or "gap"
  Polygon polygon;     ///< on the first face
  double width = 0.0;  ///< [m]
  double height = 0.0;
};

/// Two faces that look away from each other, back to back.
struct Wall {
  WallKind kind = WallKind::kWall;
  double thickness = 0.0;      ///< [m]
  double thickness_std = 0.0;  ///< standard uncertainty of `thickness` [m]; ± 1.96 of it is 95 %
  bool is_bent = false;  ///< a face leaves its plane by 5 mm and more: curved, or badly mapped
  double angle = 0.0;    ///< between the faces' planes [rad]
  double area = 0.0;     ///< seen from both sides [m²]
  double length = 0.0;   ///< level extent of what was seen from both sides [m]
  double height = 0.0;   ///< the other extent [m]
  Passes passes = Passes::kUnknown;
  double time_between = 0.0;  ///< sightings of one side and the other, at least [s]; 0 if unknown
  std::array<SurveyFace, 2> faces;
  std::vector<Opening> openings;
};

/// What is in a map.
struct Survey {
  std::vector<Wall> walls;                        ///< all but the next
  std::vector<Wall> bodies;                       ///< columns and furniture
  std::vector<SurveyFace> faces;                  ///< single ones of min_area or more
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector
  double floor = 0.0;          ///< lowest level face, along `up` [m]; or the lowest point
  double noise = 0.0;          ///< of the points on their faces, about [m]
  double inflation = 1.0;      ///< variance of a mean over what independent points would give
  double bend = 0.0;           ///< of faces beyond the noise, RMS over half a metre [m]
  double jitter = 0.0;         ///< standard deviation of a keyframe's pose [m]; 0 without keyframes
  double drift = 0.0;          ///< and of what all keyframes of a pass share [m]
  double patch_size = 0.0;     ///< that faces were grown with [m]
  double rounding = 0.0;       ///< of the coordinates, when all are float32 numbers [m]; else 0
  bool is_inside_out = false;  ///< normals seem to point into the walls: nothing here is right
  std::size_t left_out = 0;    ///< points without position or normal, or far from all others
};

/// Finds the walls in the points of `map`: planar faces grown from points and normals, joined
/// across gaps, and paired back to back where both sides were seen. Deterministic. Throws
/// std::invalid_argument for bad options and when no point has a normal.
///
/// `thickness_std` holds what the map itself can tell: noise, and what faces are bent by. An error
/// that all points of one side share, as a drift between two passes, leaves no trace in the map;
/// `keyframes` of the run that made it tell of it, and which sides were seen in one pass.
/// options.drift adds what else is known of it.
Survey survey_walls(
    const io::MapCloud& map,
    const SurveyOptions& options,
    const KeyframeSource& keyframes = nullptr);

}  // namespace nvm::survey
