// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/median.hpp"
#include "eval/walls/oriented_cloud.hpp"
#include "io/file/file.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace nvm::eval {

namespace {

namespace fs = std::filesystem;

Trajectory shifted(Trajectory trajectory, double time_offset) {
  for (StampedPose& stamped : trajectory) {
    stamped.time += time_offset;
  }
  return trajectory;
}

/// Without the times where one of the trajectories has a gap.
double covered_seconds(const std::vector<PosePair>& pairs, double max_gap) {
  constexpr double kSteps = 1.5;
  std::vector<double> steps;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    steps.push_back(pairs[i].time - pairs[i - 1].time);
  }
  if (steps.empty()) {
    return 0.0;
  }
  const double longest = std::max(max_gap, kSteps * median(std::vector<double>(steps)));
  return std::accumulate(steps.begin(), steps.end(), 0.0, [&](double sum, double step) {
    return step > longest ? sum : sum + step;
  });
}

TrajectoryEvaluation evaluate_trajectory(
    const std::string& path, const Trajectory& truth, const EvaluationOptions& options) {
  TrajectoryEvaluation result;
  const Trajectory estimate = io::read_tum(path);
  result.association = associate(estimate, truth, options.max_gap);
  const std::vector<PosePair>& pairs = result.association.pairs;
  if (pairs.empty()) {
    io::fail(path, why_unmatched(estimate, truth));
  }
  result.seconds = covered_seconds(pairs, result.association.max_gap);
  result.truth_seconds = truth.back().time - truth.front().time;
  try {
    result.alignment = align(pairs, options.alignment);
  } catch (const std::runtime_error& error) {
    io::fail(path, error.what());
  }
  result.errors = position_errors(pairs, result.alignment);
  result.absolute = *summarize(result.errors);
  result.axis_rmse = axis_rmse(pairs, result.alignment);
  result.per_frame = relative_error(pairs, StepUnit::kFrame);
  result.per_second = relative_error(pairs, StepUnit::kSecond);
  result.per_metre = relative_error(pairs, StepUnit::kMetre);
  return result;
}

MapEvaluation evaluate_map(
    const OrientedCloud& cloud,
    const std::vector<WallPiece>& walls,
    const EvaluationOptions& options) {
  MapEvaluation result;
  result.points = cloud.points.size();
  result.non_finite = cloud.non_finite;
  result.has_normals = cloud.has_normals();
  result.crispness = measure_crispness(cloud);
  result.walls = evaluate_walls(cloud, walls, options.walls);
  for (const Region& region : options.regions) {
    result.regions.push_back(evaluate_region(cloud, region, options.walls));
  }
  return result;
}

/// Where the map of a run is in the world.
Pose map_pose(const TrajectoryEvaluation& trajectory, AlignmentKind kind) {
  return kind == AlignmentKind::kSim3
             ? align(trajectory.association.pairs, AlignmentKind::kSe3).T_world_map
             : trajectory.alignment.T_world_map;
}

/// Throws std::runtime_error when a run without a map is asked for what only a map has.
void check_map_is_needless(
    const std::string& path, bool has_truth, const EvaluationOptions& options) {
  if (!has_truth) {
    io::fail(path, "is missing, and without a truth there is nothing else to judge");
  }
  if (!options.regions.empty()) {
    io::fail(path, "is missing, and regions are parts of it");
  }
}

/// The last part of a path that has a name: "out/nvm/" is "nvm".
std::string folder_name(const std::string& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

Truth read_truth(const std::string& path, double time_offset) {
  if (!fs::exists(path)) {
    io::fail(path, "does not exist");
  }
  if (!fs::is_directory(path)) {
    return {shifted(io::read_tum(path), time_offset), {}};
  }
  const std::string scene = (fs::path(path) / "scene.json").string();
  return {
      shifted(io::read_tum((fs::path(path) / "groundtruth.tum").string()), time_offset),
      fs::exists(scene) ? read_walls(scene) : std::vector<WallPiece>()};
}

WallSummary summarize(const std::vector<WallEvaluation>& walls) {
  WallSummary summary;
  std::vector<double> errors;
  for (const WallEvaluation& wall : walls) {
    summary.seen += wall.is_seen ? 1 : 0;
    summary.measured += wall.thickness ? 1 : 0;
    summary.sides += wall.sides;
    if (wall.error()) {
      errors.push_back(std::abs(*wall.error()));
    }
  }
  summary.absolute_error = summarize(std::move(errors));
  return summary;
}

RunEvaluation evaluate_run(
    const std::string& run, const std::optional<Truth>& truth, const EvaluationOptions& options) {
  const bool is_trajectory = fs::exists(run) && !fs::is_directory(run);
  const fs::path folder = is_trajectory ? fs::path(run).parent_path() : fs::path(run);
  const std::string map = (folder / "map.ply").string();
  RunEvaluation result;
  result.name = is_trajectory ? fs::path(run).stem().string() : folder_name(run);
  result.has_map = !is_trajectory && fs::exists(map);
  OrientedCloud cloud;
  if (result.has_map) {
    cloud = read_oriented_cloud(map);
  } else {
    check_map_is_needless(map, truth.has_value(), options);
  }
  if (!is_trajectory) {
    result.timing = read_timing((folder / "timing.json").string());
  }
  if (truth) {
    result.trajectory = evaluate_trajectory(
        is_trajectory ? run : (folder / "trajectory.tum").string(), truth->trajectory, options);
    cloud = transformed(std::move(cloud), map_pose(*result.trajectory, options.alignment));
  }
  result.map = evaluate_map(cloud, truth ? truth->walls : std::vector<WallPiece>(), options);
  return result;
}

}  // namespace nvm::eval
