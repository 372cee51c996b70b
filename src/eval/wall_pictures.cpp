// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/wall_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "eval/chart.hpp"

namespace nvm::eval {

namespace {

constexpr double kMillimetres = 1e3;

std::string section_title(const RunEvaluation& run, const WallEvaluation& wall) {
  if (!wall.thickness) {
    return run.name + ": not found";
  }
  std::string title = fmt::format("{}: {:.2f} mm", run.name, kMillimetres * *wall.thickness);
  if (wall.error()) {
    title += fmt::format(" ({:+.2f})", kMillimetres * *wall.error());
  }
  return title;
}

std::vector<ChartPoint> section_points(const WallEvaluation& wall, int side) {
  std::vector<ChartPoint> points;
  for (const SectionPoint& point : wall.section) {
    if (point.side == side) {
      points.push_back({point.along, kMillimetres * point.across});
    }
  }
  return points;
}

Chart section_chart(const RunEvaluation& run, const WallEvaluation& wall, const AxisRange& along) {
  constexpr double kSurroundings = 60.0;  // [mm]
  const double half_mm =
      0.5 * kMillimetres * wall.true_thickness.value_or(wall.thickness.value_or(0.0));
  ChartLayout layout;
  layout.title = section_title(run, wall);
  layout.x_label = "along the wall [m]";
  layout.y_label = "across [mm]";
  layout.x = along;
  layout.y = {-half_mm - kSurroundings, half_mm + kSurroundings};
  layout.width = 420.0;
  layout.height = 240.0;
  Chart chart(layout);
  const std::array<const char*, 2> colors =
      run.map.has_normals ? std::array{"#1f77b4", "#e4572e"} : std::array{"#888888", "#888888"};
  for (int side = 0; side < 2; ++side) {
    chart.add_dots(section_points(wall, side), {colors[static_cast<std::size_t>(side)], 2.5, ""});
    if (wall.true_thickness) {
      const double face = side == 0 ? half_mm : -half_mm;
      chart.add_line({{along.min, face}, {along.max, face}}, {"#222222", 1.0, ""});
    }
  }
  return chart;
}

/// The same wall of every run, side by side.
WallPicture wall_picture(
    const Evaluation& evaluation, const std::vector<const WallEvaluation*>& wall_of_run) {
  std::vector<double> along;
  for (const WallEvaluation* wall : wall_of_run) {
    for (const SectionPoint& point : wall->section) {
      along.push_back(point.along);
    }
  }
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < wall_of_run.size(); ++i) {
    charts.push_back(section_chart(evaluation.runs[i], *wall_of_run[i], range_of(along)));
  }
  return {wall_of_run[0]->name, side_by_side(charts)};
}

/// All runs' evaluations of the wall (or region) at `index` of the list `member`.
std::vector<const WallEvaluation*> of_all_runs(
    const Evaluation& evaluation,
    std::vector<WallEvaluation> MapEvaluation::*member,
    std::size_t index) {
  std::vector<const WallEvaluation*> walls;
  for (const RunEvaluation& run : evaluation.runs) {
    walls.push_back(&(run.map.*member)[index]);
  }
  return walls;
}

double worst_error(const std::vector<const WallEvaluation*>& wall_of_run) {
  double worst = 0.0;
  for (const WallEvaluation* wall : wall_of_run) {
    worst = std::max(worst, std::abs(wall->error().value_or(std::numeric_limits<double>::max())));
  }
  return worst;
}

/// Indices of the walls to draw, ascending.
std::vector<std::size_t> walls_to_draw(const Evaluation& evaluation, std::size_t max_walls) {
  const std::vector<WallEvaluation>& walls = evaluation.runs[0].map.walls;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (walls[i].is_seen) {
      indices.push_back(i);
    }
  }
  std::stable_sort(indices.begin(), indices.end(), [&](std::size_t a, std::size_t b) {
    return worst_error(of_all_runs(evaluation, &MapEvaluation::walls, a)) >
           worst_error(of_all_runs(evaluation, &MapEvaluation::walls, b));
  });
  indices.resize(std::min(indices.size(), max_walls));
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace

std::vector<WallPicture> wall_pictures(const Evaluation& evaluation, std::size_t max_walls) {
  std::vector<WallPicture> pictures;
  if (evaluation.runs.empty()) {
    return pictures;
  }
  for (const std::size_t index : walls_to_draw(evaluation, max_walls)) {
    pictures.push_back(
        wall_picture(evaluation, of_all_runs(evaluation, &MapEvaluation::walls, index)));
  }
  for (std::size_t i = 0; i < evaluation.runs[0].map.regions.size(); ++i) {
    pictures.push_back(
        wall_picture(evaluation, of_all_runs(evaluation, &MapEvaluation::regions, i)));
  }
  return pictures;
}

}  // namespace nvm::eval
