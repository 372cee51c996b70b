// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/coplanar.hpp"
#include "survey/directions.hpp"
#include "survey/face.hpp"
#include "survey/inside_out.hpp"
#include "survey/pairing.hpp"
#include "survey/patch_grid.hpp"
#include "survey/pose_evidence.hpp"
#include "survey/region_growth.hpp"
#include "survey/region_shadows.hpp"
#include "survey/wall_builder.hpp"
#include "survey/wall_thickness.hpp"

namespace nvm::survey {

namespace {

/// Patches of options.patch_size, or of the next doubled size that holds three points in most.
PatchGrid make_grid(const SurveyCloud& cloud, double size) {
  constexpr double kLargest = 2.0;  // [m]
  constexpr double kMinMean = 3.0;  // [points]
  for (;;) {
    PatchGrid grid(cloud, size);
    const auto points = static_cast<double>(cloud.positions.size());
    if (points / static_cast<double>(grid.patches().size()) >= kMinMean || 2.0 * size > kLargest) {
      return grid;
    }
    size *= 2.0;
  }
}

std::vector<Face> find_faces(
    const SurveyCloud& cloud,
    const PatchGrid& grid,
    const Directions& directions,
    const SurveyOptions& options) {
  const double noise = grid.noise();
  const GrowthGates gates{
      std::clamp(4.0 * noise, 0.015, 0.06), std::clamp(4.0 * noise, 0.012, 0.06)};
  constexpr double kCellsPerPatch = 2.5;
  std::vector<Face> faces;
  std::vector<PlanarRegion> regions =
      join_coplanar(grid, grow_regions(grid, gates), {options.max_gap, noise});
  drop_shadows(grid, noise, regions);
  for (const PlanarRegion& region : regions) {
    if (auto face = make_face(cloud, grid, region, directions, grid.size() / kCellsPerPatch)) {
      faces.push_back(std::move(*face));
    }
  }
  return faces;
}

/// Pairs that could be measured, and what came out.
struct MeasuredPairs {
  std::vector<FacePair> pairs;
  std::vector<WallThickness> walls;
};

MeasuredPairs measure_pairs(
    const SurveyCloud& cloud, const std::vector<Face>& faces, const SurveyOptions& options) {
  MeasuredPairs result;
  for (FacePair& pair : pair_faces(faces, options)) {
    const auto wall = measure_wall(cloud, faces, pair);
    // Thinner than its noise: the points of one surface, some with normals turned around.
    if (wall &&
        wall->value > std::max(options.min_thickness, std::hypot(wall->rms[0], wall->rms[1]))) {
      result.pairs.push_back(std::move(pair));
      result.walls.push_back(*wall);
    }
  }
  return result;
}

/// How the residuals of all walls hang together.
BlockScatter pooled_scatter(const std::vector<WallThickness>& walls) {
  BlockScatter all;
  for (const WallThickness& wall : walls) {
    all += wall.scatter;
  }
  return all;
}

double lowest_level(
    const SurveyCloud& cloud, const std::vector<Face>& faces, const Eigen::Vector3d& up) {
  constexpr double kLevel = 0.98;
  constexpr double kMinArea = 2.0;  // [m²]
  double lowest = std::numeric_limits<double>::infinity();
  for (const Face& face : faces) {
    if (face.plane.normal.dot(up) > kLevel && face.seen.area() > kMinArea) {
      lowest = std::min(lowest, face.frame.origin.dot(up));
    }
  }
  if (std::isinf(lowest)) {
    for (const Eigen::Vector3d& p : cloud.positions) {
      lowest = std::min(lowest, p.dot(up));
    }
  }
  return lowest + cloud.origin.dot(up);
}

/// Half of how far the faces of `wall` leave their planes [m], when that is far: it is not known
/// then where on them the thickness is wanted.
double bending(const Wall& wall, double noise) {
  const double bow = std::max(wall.faces[0].bow, wall.faces[1].bow);
  return bow > std::max(0.005, 4.0 * noise) ? 0.5 * bow : 0.0;
}

/// The variance of `wall` [m²]: noise, as far as it is alike over half a metre; once for each side
/// what its pass shifts it by. That is what faces are bent by, or what sightings in different
/// passes differ by, whichever is more: a drift within a pass bends, one between passes does not.
double sq_uncertainty(const WallThickness& wall, const Survey& survey) {
  constexpr double kPriorBlocks = 20.0;  // how many of a wall's own outweigh those of all walls
  const double inflation = std::max(1.0, wall.scatter.inflation(survey.inflation, kPriorBlocks));
  const double sq_rounding = survey.rounding * survey.rounding / 12.0;
  return inflation * wall.sq_noise +
         2.0 * (std::pow(std::max(survey.bend, survey.drift), 2) + sq_rounding);
}

/// What keyframes tell of a wall.
void judge_passes(const WallSightings& sightings, Wall& wall) {
  const double seconds = time_between_sides(sightings);
  if (std::isfinite(seconds)) {
    wall.time_between = seconds;
    wall.passes = seconds < kPassGap ? Passes::kOne : Passes::kTwo;
  }
}

/// What is known of the map's points, before walls are made of them.
Survey survey_of(
    const SurveyCloud& cloud,
    const PatchGrid& grid,
    const std::vector<Face>& faces,
    const MeasuredPairs& measured,
    const Eigen::Vector3d& up) {
  constexpr double kIndependentBlocks = 8.0;  // what is believed before anything is seen
  Survey survey;
  survey.up = up;
  survey.floor = lowest_level(cloud, faces, up);
  survey.noise = grid.noise();
  const BlockScatter scatter = pooled_scatter(measured.walls);
  survey.inflation = std::max(1.0, scatter.inflation(1.0, kIndependentBlocks));
  survey.bend = std::sqrt(scatter.sq_bend());
  survey.patch_size = grid.size();
  survey.left_out = cloud.left_out;
  survey.rounding = cloud.rounding;
  return survey;
}

}  // namespace

std::string kind_name(WallKind kind) {
  constexpr std::array<const char*, 8> kNames{
      "wall", "partition", "door", "slab", "panel", "sloped", "column", "furniture"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string passes_name(Passes passes) {
  constexpr std::array<const char*, 3> kNames{"unknown", "one", "two"};
  return kNames[static_cast<std::size_t>(passes)];
}

Survey survey_walls(
    const io::MapCloud& map, const SurveyOptions& options, const KeyframeSource& keyframes) {
  options.validate();
  const SurveyCloud cloud = survey_cloud(map);
  const PatchGrid grid = make_grid(cloud, options.patch_size);
  const Directions directions = find_directions(grid);
  const std::vector<Face> faces = find_faces(cloud, grid, directions, options);
  const MeasuredPairs measured = measure_pairs(cloud, faces, options);
  Survey survey = survey_of(cloud, grid, faces, measured, directions.up);
  survey.is_inside_out = is_inside_out(faces, directions.up, options, !measured.pairs.empty());
  std::vector<WallSightings> sightings(measured.pairs.size());
  if (keyframes) {
    sightings = find_sightings(cloud, faces, measured.pairs, keyframes);
  }
  const PoseEvidence poses(sightings, survey.noise);
  survey.jitter = std::sqrt(poses.sq_jitter());
  survey.drift = std::sqrt(poses.sq_drift());
  WallBuilder builder(cloud, faces, measured.pairs, directions.up, options);
  for (std::size_t i = 0; i < measured.pairs.size(); ++i) {
    Wall wall = builder.wall(i, measured.walls[i]);
    judge_passes(sightings[i], wall);
    const double bend = bending(wall, survey.noise);
    wall.is_bent = bend > 0.0;
    wall.thickness_std = std::sqrt(
        sq_uncertainty(measured.walls[i], survey) + bend * bend + poses.sq_shift(sightings[i][0]) +
        poses.sq_shift(sightings[i][1]) + options.drift * options.drift);
    const bool is_body = wall.kind == WallKind::kColumn || wall.kind == WallKind::kFurniture;
    (is_body ? survey.bodies : survey.walls).push_back(std::move(wall));
  }
  survey.faces = builder.single_faces();
  return survey;
}

}  // namespace nvm::survey
