// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace nvm::survey {

namespace {

constexpr double kMillimetres = 1e3;
constexpr double kDegreesPerRadian = 57.29577951308232;

std::vector<std::string> row_of(const std::string& name, const Wall& wall) {
  std::size_t doors = 0;
  for (const Opening& opening : wall.openings) {
    doors += opening.kind == "door" || opening.kind == "passage" ? 1 : 0;
  }
  return {
      name,
      kind_name(wall.kind),
      fmt::format("{:.1f}", kMillimetres * wall.thickness),
      fmt::format("{:.1f}", 1.96 * kMillimetres * wall.thickness_std),
      passes_name(wall.passes),
      fmt::format("{:.2f}", kDegreesPerRadian * wall.angle),
      fmt::format("{:.2f}", wall.length),
      fmt::format("{:.2f}", wall.height),
      fmt::format("{:.1f}", wall.area),
      fmt::format("{}/{}", doors, wall.openings.size() - doors),
      fmt::format("{}/{}", wall.faces[0].points, wall.faces[1].points),
      fmt::format(
          "{:.1f}/{:.1f}", kMillimetres * wall.faces[0].rms, kMillimetres * wall.faces[1].rms),
      fmt::format(
          "{:.1f}/{:.1f}", kMillimetres * wall.faces[0].bow, kMillimetres * wall.faces[1].bow)};
}

Eigen::Vector3d middle(const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : polygon) {
    sum += p / static_cast<double>(polygon.size());
  }
  return sum;
}

std::string csv_row(const std::string& name, const Wall& wall) {
  const Eigen::Vector3d center =
      0.5 * (middle(wall.faces[0].polygon) + middle(wall.faces[1].polygon));
  std::string row = fmt::format(
      "{},{},{:.6f},{:.6f},{},{:.4f},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{}",
      name,
      kind_name(wall.kind),
      wall.thickness,
      wall.thickness_std,
      passes_name(wall.passes),
      kDegreesPerRadian * wall.angle,
      wall.length,
      wall.height,
      wall.area,
      center.x(),
      center.y(),
      center.z(),
      wall.openings.size());
  for (const SurveyFace& face : wall.faces) {
    row += fmt::format(
        ",{:.6f},{:.6f},{:.6f},{:.6f},{},{:.6f},{:.6f}",
        face.plane.normal.x(),
        face.plane.normal.y(),
        face.plane.normal.z(),
        face.plane.offset,
        face.points,
        face.rms,
        face.bow);
  }
  return row + "\n";
}

/// Calls `visit(name, wall)` for walls, then bodies.
template <class Visit>
void for_each_wall(const Survey& survey, const Visit& visit) {
  for (std::size_t i = 0; i < survey.walls.size(); ++i) {
    visit(fmt::format("{}", i), survey.walls[i]);
  }
  for (std::size_t i = 0; i < survey.bodies.size(); ++i) {
    visit(fmt::format("body {}", i), survey.bodies[i]);
  }
}

/// How many characters a text has: bytes of UTF-8 that begin one.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

}  // namespace

std::vector<std::string> table_header() {
  return {
      "wall",
      "kind",
      "thickness [mm]",
      "± 95 % [mm]",
      "passes",
      "angle [°]",
      "length [m]",
      "height [m]",
      "area [m²]",
      "doors/other",
      "points",
      "RMS [mm]",
      "bow [mm]"};
}

std::vector<std::vector<std::string>> table_rows(const Survey& survey) {
  std::vector<std::vector<std::string>> rows;
  for_each_wall(survey, [&](const std::string& name, const Wall& wall) {
    rows.push_back(row_of(name, wall));
  });
  return rows;
}

std::string screen_table(const Survey& survey) {
  std::vector<std::vector<std::string>> rows = table_rows(survey);
  rows.insert(rows.begin(), table_header());
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width_of(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += std::string(widths[i] - width_of(row[i]), ' ') + row[i] + "  ";
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string survey_csv(const Survey& survey) {
  std::string text =
      "wall,kind,thickness,thickness_std,passes,angle_deg,length,height,area,x,y,z,openings";
  for (const int side : {1, 2}) {
    text += fmt::format(",nx{0},ny{0},nz{0},d{0},points{0},rms{0},bow{0}", side);
  }
  text += '\n';
  for_each_wall(
      survey, [&](const std::string& name, const Wall& wall) { text += csv_row(name, wall); });
  return text;
}

}  // namespace nvm::survey
