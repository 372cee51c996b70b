// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "eval/report/timing.hpp"
#include "eval/trajectory/alignment.hpp"
#include "eval/trajectory/trajectory_error.hpp"
#include "eval/walls/crispness.hpp"
#include "eval/walls/wall_evaluation.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::eval {

/// What runs are measured against.
struct Truth {
  Trajectory trajectory;         ///< T_world_body
  std::vector<WallPiece> walls;  ///< none where the truth is a trajectory alone
};

/// Reads a sequence folder (groundtruth.tum and, where walls are known, scene.json), or a TUM file.
/// `time_offset` [s] is added to the times of the trajectory. Throws std::runtime_error, naming the
/// file and what is wrong.
Truth read_truth(const std::string& path, double time_offset = 0.0);

/// What is asked of an evaluation.
struct EvaluationOptions {
  AlignmentKind alignment = AlignmentKind::kSe3;
  std::optional<double> max_gap;  ///< of associate() [s]
  std::vector<Region> regions;    ///< in the world frame; in the map frame without a truth
  WallOptions walls;
};

/// How far a trajectory is from the truth.
struct TrajectoryEvaluation {
  double seconds = 0.0;        ///< that the pairs cover, without the gaps between them
  double truth_seconds = 0.0;  ///< of the truth: what lies beyond the pairs is not judged
  Association association;
  Alignment alignment;
  std::vector<double> errors;         ///< [m], per pair of the association
  ErrorStatistics absolute;           ///< of `errors`
  std::array<double, 3> axis_rmse{};  ///< of their parts along x, y and z of the world [m]
  RelativeError per_frame;
  RelativeError per_second;
  RelativeError per_metre;
};

/// What a map is like.
struct MapEvaluation {
  std::size_t points = 0;
  std::size_t non_finite = 0;
  bool has_normals = false;
  std::optional<Crispness> crispness;
  std::vector<WallEvaluation> walls;
  std::vector<WallEvaluation> regions;
};

/// One run of an odometry.
struct RunEvaluation {
  std::string name;
  std::optional<TrajectoryEvaluation> trajectory;  ///< nothing without a truth
  bool has_map = true;                             ///< else `map` is that of no points
  MapEvaluation map;
  std::vector<StageTiming> timing;  ///< none when the run has no timing.json
};

/// Several runs side by side, against one truth.
struct Evaluation {
  std::optional<Truth> truth;
  std::vector<RunEvaluation> runs;
};

/// The walls of a map in a few numbers.
struct WallSummary {
  std::size_t seen = 0;                           ///< walls that the sensor saw from both sides
  std::size_t measured = 0;                       ///< of these, found in the map
  std::optional<ErrorStatistics> absolute_error;  ///< of the measured walls' thickness [m]
  SideCount sides;                                ///< of all of them together
};

WallSummary summarize(const std::vector<WallEvaluation>& walls);

/// Evaluates a run: a folder with map.ply and trajectory.tum (T_map_body), either of which may lack
/// where it is not needed, or a TUM file. The trajectory, compared with the truth, also tells where
/// the map is in the world: the map is moved by the trajectory's SE(3) alignment (by none with
/// AlignmentKind::kNone) and never scaled. Throws std::runtime_error, naming the file and what is
/// wrong, when a file is missing or malformed or the trajectory cannot be compared with the truth.
RunEvaluation evaluate_run(
    const std::string& run, const std::optional<Truth>& truth, const EvaluationOptions& options);

}  // namespace nvm::eval
