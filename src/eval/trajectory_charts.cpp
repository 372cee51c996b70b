// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory_charts.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "eval/chart.hpp"

namespace nvm::eval {

namespace {

constexpr double kMillimetres = 1e3;
constexpr const char* kTruthColor = "#222222";

using Line = std::vector<ChartPoint>;

/// At most about 1500 points, at even steps.
Line thinned(const Line& points) {
  const std::size_t step = 1 + points.size() / 1500;
  Line result;
  for (std::size_t i = 0; i < points.size(); i += step) {
    result.push_back(points[i]);
  }
  return result;
}

Line path_of(const Trajectory& trajectory) {
  Line path;
  for (const StampedPose& stamped : trajectory) {
    path.push_back({stamped.pose.translation().x(), stamped.pose.translation().y()});
  }
  return path;
}

Line path_of(const TrajectoryEvaluation& trajectory) {
  Line path;
  for (const PosePair& pair : trajectory.association.pairs) {
    const Eigen::Vector3d p = trajectory.alignment * pair.T_map_body.translation();
    path.push_back({p.x(), p.y()});
  }
  return path;
}

/// The face from above: its longest horizontal edge.
Line outline(const WallFace& face) {
  const bool along_u =
      face.half_u * face.u.head<2>().norm() > face.half_v * face.v.head<2>().norm();
  const Eigen::Vector3d half =
      along_u ? Eigen::Vector3d(face.half_u * face.u) : Eigen::Vector3d(face.half_v * face.v);
  const Eigen::Vector3d begin = face.center - half;
  const Eigen::Vector3d end = face.center + half;
  return {{begin.x(), begin.y()}, {end.x(), end.y()}};
}

ChartLayout layout_around(const std::vector<Line>& lines) {
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

/// The true trajectory, then the walls.
std::vector<Line> true_paths(const Evaluation& evaluation) {
  std::vector<Line> lines;
  if (evaluation.truth) {
    lines.push_back(path_of(evaluation.truth->trajectory));
    for (const WallPiece& piece : evaluation.truth->walls) {
      lines.push_back(outline(piece.faces[0]));
      lines.push_back(outline(piece.faces[1]));
    }
  }
  return lines;
}

/// One path per run; empty without a trajectory.
std::vector<Line> estimated_paths(const Evaluation& evaluation) {
  std::vector<Line> paths;
  for (const RunEvaluation& run : evaluation.runs) {
    paths.push_back(run.trajectory ? path_of(*run.trajectory) : Line());
  }
  return paths;
}

/// Error over the time since `begin`, one line per run; empty without a trajectory.
std::vector<Line> error_lines(const Evaluation& evaluation, double begin) {
  std::vector<Line> lines;
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

}  // namespace

std::string run_color(std::size_t index) {
  constexpr std::array kColors = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#8c564b"};
  return kColors[index % kColors.size()];
}

std::string trajectory_chart(const Evaluation& evaluation) {
  const std::vector<Line> true_lines = true_paths(evaluation);
  const std::vector<Line> paths = estimated_paths(evaluation);
  std::vector<Line> all = paths;
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

}  // namespace nvm::eval
