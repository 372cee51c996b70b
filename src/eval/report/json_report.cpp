// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/json_report.hpp"

#include <nlohmann/json.hpp>

namespace nvm::eval {

namespace {

using json = nlohmann::ordered_json;

constexpr double kMillimetres = 1e3;

json scaled(const std::optional<double>& value, double scale) {
  return value ? json(scale * *value) : json();
}

json to_json(const std::optional<ErrorStatistics>& statistics, double scale = 1.0) {
  if (!statistics) {
    return {};
  }
  return {
      {"count", statistics->count},
      {"rmse", scale * statistics->rmse},
      {"mean", scale * statistics->mean},
      {"median", scale * statistics->median},
      {"max", scale * statistics->max}};
}

json to_json(const RelativeError& error) {
  return {
      {"translation_m", to_json(error.translation)}, {"rotation_deg", to_json(error.rotation_deg)}};
}

json to_json(const Alignment& alignment) {
  const Eigen::Quaterniond q(alignment.T_world_map.linear());
  const Eigen::Vector3d t = alignment.T_world_map.translation();
  return {
      {"translation", {t.x(), t.y(), t.z()}},
      {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
      {"scale", alignment.scale}};
}

json to_json(const std::optional<TrajectoryEvaluation>& trajectory) {
  if (!trajectory) {
    return {};
  }
  return {
      {"poses", trajectory->association.pairs.size()},
      {"unmatched_poses", trajectory->association.unmatched},
      {"interpolated", trajectory->association.interpolates_estimate ? "estimate" : "truth"},
      {"max_gap_s", trajectory->association.max_gap},
      {"seconds", trajectory->seconds},
      {"truth_seconds", trajectory->truth_seconds},
      {"T_world_map", to_json(trajectory->alignment)},
      {"ate_m", to_json(trajectory->absolute)},
      {"axis_rmse_m", trajectory->axis_rmse},
      {"rpe_per_frame", to_json(trajectory->per_frame)},
      {"rpe_per_second", to_json(trajectory->per_second)},
      {"rpe_per_metre", to_json(trajectory->per_metre)}};
}

std::optional<double> relative(const WallEvaluation& wall) {
  return wall.error() ? std::optional(*wall.error() / *wall.true_thickness) : std::nullopt;
}

json to_json(const WallEvaluation& wall) {
  return {
      {"name", wall.name},
      {"seen", wall.is_seen},
      {"true_thickness_mm", scaled(wall.true_thickness, kMillimetres)},
      {"thickness_mm", scaled(wall.thickness, kMillimetres)},
      {"error_mm", scaled(wall.error(), kMillimetres)},
      {"error_percent", scaled(relative(wall), 100.0)},
      {"standard_error_mm", kMillimetres * wall.standard_error},
      {"spread_mm", kMillimetres * wall.spread},
      {"points", wall.points},
      {"side_points", wall.sides.points},
      {"side_purity", scaled(wall.sides.purity(), 1.0)}};
}

json to_json(const std::vector<WallEvaluation>& walls) {
  json list = json::array();
  for (const WallEvaluation& wall : walls) {
    list.push_back(to_json(wall));
  }
  return list;
}

json to_json(const WallSummary& summary) {
  return {
      {"seen", summary.seen},
      {"measured", summary.measured},
      {"absolute_error_mm", to_json(summary.absolute_error, kMillimetres)},
      {"side_points", summary.sides.points},
      {"side_purity", scaled(summary.sides.purity(), 1.0)}};
}

json to_json(const std::optional<Crispness>& crispness) {
  if (!crispness) {
    return {};
  }
  return {
      {"plane_thickness_mm", scaled(crispness->plane_thickness, kMillimetres)},
      {"mean_map_entropy", crispness->mean_map_entropy},
      {"patches", crispness->patches}};
}

json to_json(const MapEvaluation& map) {
  return {
      {"points", map.points},
      {"non_finite_points", map.non_finite},
      {"sides", map.has_normals ? "by normal" : "by position"},
      {"crispness", to_json(map.crispness)},
      {"wall_summary", to_json(summarize(map.walls))},
      {"walls", to_json(map.walls)},
      {"regions", to_json(map.regions)}};
}

json to_json(const std::vector<StageTiming>& timing) {
  json stages = json::object();
  for (const StageTiming& stage : timing) {
    stages[stage.stage] = {{"mean", stage.mean_ms}, {"max", stage.max_ms}};
  }
  return stages;
}

}  // namespace

std::string json_report(const Evaluation& evaluation) {
  json runs = json::array();
  for (const RunEvaluation& run : evaluation.runs) {
    runs.push_back(
        {{"name", run.name},
         {"trajectory", to_json(run.trajectory)},
         {"map", run.has_map ? to_json(run.map) : json()},
         {"cpu", to_json(run.timing)}});
  }
  return json{{"runs", runs}}.dump(2) + "\n";
}

}  // namespace nvm::eval
