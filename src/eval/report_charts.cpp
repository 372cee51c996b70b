// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "eval/chart.hpp"

namespace nvm::eval {

namespace {

constexpr double kMillimetres = 1e3;
constexpr const char* kTruthColor = "#222222";

/// At most about 1500 points, at even steps.
std::vector<ChartPoint> thinned(const std::vector<ChartPoint>& points) {
  const std::size_t step = 1 + points.size() / 1500;
  std::vector<ChartPoint> result;
  for (std::size_t i = 0; i < points.size(); i += step) {
    result.push_back(points[i]);
  }
  return result;
}

std::vector<ChartPoint> path_of(const Trajectory& trajectory) {
  std::vector<ChartPoint> path;
  for (const StampedPose& stamped : trajectory) {
    path.push_back({stamped.pose.translation().x(), stamped.pose.translation().y()});
  }
  return path;
}

std::vector<ChartPoint> path_of(const TrajectoryEvaluation& trajectory) {
  std::vector<ChartPoint> path;
  for (const PosePair& pair : trajectory.association.pairs) {
    const Eigen::Vector3d p = trajectory.alignment * pair.T_map_body.translation();
    path.push_back({p.x(), p.y()});
  }
  return path;
}

/// The face from above: its longest horizontal edge.
std::vector<ChartPoint> outline(const WallFace& face) {
  const bool along_u =
      face.half_u * face.u.head<2>().norm() > face.half_v * face.v.head<2>().norm();
  const Eigen::Vector3d half =
      along_u ? Eigen::Vector3d(face.half_u * face.u) : Eigen::Vector3d(face.half_v * face.v);
  const Eigen::Vector3d begin = face.center - half;
  const Eigen::Vector3d end = face.center + half;
  return {{begin.x(), begin.y()}, {end.x(), end.y()}};
}

ChartLayout layout_around(const std::vector<std::vector<ChartPoint>>& lines) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (const auto& line : lines) {
    for (const ChartPoint& point : line) {
      xs.push_back(point.x);
      ys.push_back(point.y);
    }
  }
  ChartLayout layout;
  layout.x = range_of(xs);
  layout.y = range_of(ys);
  return layout;
}

std::string run_class(std::size_t run) { return fmt::format("run run-{}", run); }

/// The runs that have a trajectory, as (run, line).
std::vector<std::vector<ChartPoint>> error_lines(const Evaluation& evaluation, double begin) {
  std::vector<std::vector<ChartPoint>> lines;
  for (const RunEvaluation& run : evaluation.runs) {
    auto& line = lines.emplace_back();
    for (std::size_t i = 0; run.trajectory && i < run.trajectory->errors.size(); ++i) {
      line.push_back(
          {run.trajectory->association.pairs[i].time - begin,
           kMillimetres * run.trajectory->errors[i]});
    }
  }
  return lines;
}

std::string section_title(const RunEvaluation& run, const WallEvaluation& wall) {
  if (!wall.thickness) {
    return run.name + ": not found";
  }
  std::string title = fmt::format("{}: {:.1f} mm", run.name, kMillimetres * *wall.thickness);
  if (wall.error()) {
    title += fmt::format(" ({:+.1f})", kMillimetres * *wall.error());
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
      chart.add_line({{along.min, face}, {along.max, face}}, {kTruthColor, 1.0, ""});
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

std::string run_color(std::size_t index) {
  constexpr std::array kColors = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#8c564b"};
  return kColors[index % kColors.size()];
}

std::string trajectory_chart(const Evaluation& evaluation) {
  std::vector<std::vector<ChartPoint>> paths;
  for (const RunEvaluation& run : evaluation.runs) {
    paths.push_back(run.trajectory ? path_of(*run.trajectory) : std::vector<ChartPoint>());
  }
  std::vector<std::vector<ChartPoint>> true_lines;
  if (evaluation.truth) {
    true_lines.push_back(path_of(evaluation.truth->trajectory));
    for (const WallPiece& piece : evaluation.truth->walls) {
      true_lines.push_back(outline(piece.faces[0]));
      true_lines.push_back(outline(piece.faces[1]));
    }
  }
  std::vector<std::vector<ChartPoint>> all = paths;
  all.insert(all.end(), true_lines.begin(), true_lines.end());
  ChartLayout layout = layout_around(all);
  layout.title = "Trajectories and walls from above";
  layout.x_label = "x [m]";
  layout.y_label = "y [m]";
  layout.height = 480.0;
  layout.is_metric = true;
  Chart chart(layout);
  for (const auto& line : true_lines) {
    chart.add_line(thinned(line), {kTruthColor, 1.0, ""});
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    chart.add_line(thinned(paths[i]), {run_color(i), 1.5, run_class(i)});
  }
  return chart.svg();
}

std::string error_chart(const Evaluation& evaluation) {
  const double begin = evaluation.truth && !evaluation.truth->trajectory.empty()
                           ? evaluation.truth->trajectory.front().time
                           : 0.0;
  const auto lines = error_lines(evaluation, begin);
  ChartLayout layout = layout_around(lines);
  layout.title = "Position error over time";
  layout.x_label = "time from the start [s]";
  layout.y_label = "error [mm]";
  layout.y.min = 0.0;
  Chart chart(layout);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    chart.add_line(thinned(lines[i]), {run_color(i), 1.5, run_class(i)});
  }
  return chart.svg();
}

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
