// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/drawing_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace nvm::eval {

namespace {

using json = nlohmann::ordered_json;

/// `length` [m] to the tenth of a millimetre, which no picture shows.
double rounded(double length) { return std::round(1e4 * length) / 1e4; }

json from_above(const Eigen::Vector3d& p) { return {rounded(p.x()), rounded(p.y())}; }

json path_of(const Trajectory& trajectory) {
  json path = json::array();
  for (const StampedPose& stamped : trajectory) {
    path.push_back(from_above(stamped.pose.translation()));
  }
  return path;
}

json path_of(const TrajectoryEvaluation& trajectory) {
  json path = json::array();
  for (const PosePair& pair : trajectory.association.pairs) {
    path.push_back(from_above(trajectory.alignment * pair.T_map_body.translation()));
  }
  return path;
}

/// The face from above: its longest horizontal edge.
json edge_of(const WallFace& face) {
  const bool along_u =
      face.half_u * face.u.head<2>().norm() > face.half_v * face.v.head<2>().norm();
  const Eigen::Vector3d half =
      along_u ? Eigen::Vector3d(face.half_u * face.u) : Eigen::Vector3d(face.half_v * face.v);
  return {from_above(face.center - half), from_above(face.center + half)};
}

json to_json(const Truth& truth) {
  json walls = json::array();
  for (const WallPiece& piece : truth.walls) {
    walls.push_back(edge_of(piece.faces[0]));
    walls.push_back(edge_of(piece.faces[1]));
  }
  return {{"path", path_of(truth.trajectory)}, {"walls", walls}};
}

/// Time since `begin` [s] and distance [m] of each pair.
json errors_of(const TrajectoryEvaluation& trajectory, double begin) {
  json errors = json::array();
  for (std::size_t i = 0; i < trajectory.errors.size(); ++i) {
    const double time = trajectory.association.pairs[i].time - begin;
    errors.push_back({rounded(time), trajectory.errors[i]});
  }
  return errors;
}

json sections_of(const std::vector<WallEvaluation>& walls) {
  json sections = json::array();
  for (const WallEvaluation& wall : walls) {
    json points = json::array();
    for (const SectionPoint& point : wall.section) {
      points.push_back({rounded(point.along), rounded(point.across), point.side});
    }
    sections.push_back(points);
  }
  return sections;
}

json to_json(const RunEvaluation& run, double begin) {
  return {
      {"path", run.trajectory ? path_of(*run.trajectory) : json()},
      {"errors", run.trajectory ? errors_of(*run.trajectory, begin) : json()},
      {"walls", sections_of(run.map.walls)},
      {"regions", sections_of(run.map.regions)}};
}

}  // namespace

std::string drawing_json(const Evaluation& evaluation) {
  const bool has_begin = evaluation.truth && !evaluation.truth->trajectory.empty();
  const double begin = has_begin ? evaluation.truth->trajectory.front().time : 0.0;
  json runs = json::array();
  for (const RunEvaluation& run : evaluation.runs) {
    runs.push_back(to_json(run, begin));
  }
  const json truth = evaluation.truth ? to_json(*evaluation.truth) : json();
  return json{{"truth", truth}, {"runs", runs}}.dump() + "\n";
}

}  // namespace nvm::eval
