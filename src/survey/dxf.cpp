// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/dxf.hpp"

#include <fmt/format.h>

#include <array>

namespace nvm::survey {

namespace {

struct Layer {
  const char* name;
  int color;  ///< of AutoCAD's index
};

constexpr std::array<Layer, 6> kLayers{
    {{"WALLS", 7},
     {"DOORS", 5},
     {"OPENINGS", 4},
     {"FURNITURE", 30},
     {"SINGLE_FACES", 8},
     {"THICKNESS", 1}}};

std::string header(const Plan& plan) {
  return fmt::format(
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$EXTMIN\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n"
      "9\n$EXTMAX\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n0\nENDSEC\n",
      plan.min.x,
      plan.min.y,
      plan.max.x,
      plan.max.y);
}

std::string tables() {
  std::string text = fmt::format(
      "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLTYPE\n70\n1\n0\nLTYPE\n2\nCONTINUOUS\n70\n64\n3\nSolid "
      "line\n72\n65\n73\n0\n40\n0.0\n0\nENDTAB\n0\nTABLE\n2\nLAYER\n70\n{}\n",
      kLayers.size());
  for (const Layer& layer : kLayers) {
    text += fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", layer.name, layer.color);
  }
  return text + "0\nENDTAB\n0\nENDSEC\n";
}

std::string line(const PlanSegment& s, const std::string& layer) {
  return fmt::format(
      "0\nLINE\n8\n{}\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n11\n{:.4f}\n21\n{:.4f}\n31\n0.0\n",
      layer,
      s.from.x,
      s.from.y,
      s.to.x,
      s.to.y);
}

std::string text(const PlanPoint& p, const std::string& content) {
  constexpr double kHeight = 0.15;  // [m]
  return fmt::format(
      "0\nTEXT\n8\nTHICKNESS\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n40\n{}\n1\n{}\n",
      p.x,
      p.y,
      kHeight,
      content);
}

std::string wall_lines(const Survey& survey, const PlanWall& cut) {
  const Wall& wall = (cut.is_body ? survey.bodies : survey.walls)[cut.wall];
  const std::string layer =
      cut.is_body ? "FURNITURE" : (wall.kind == WallKind::kDoor ? "DOORS" : "WALLS");
  std::string lines;
  for (const std::vector<PlanSegment>& face : cut.faces) {
    for (const PlanSegment& segment : face) {
      lines += line(segment, layer);
    }
  }
  for (const PlanSegment& opening : cut.openings) {
    lines += line(opening, "OPENINGS");
  }
  if (!cut.is_body) {
    lines += text(cut.label, fmt::format("{:.0f}", 1e3 * wall.thickness));
  }
  return lines;
}

}  // namespace

std::string plan_dxf(const Survey& survey, const Plan& plan) {
  std::string drawing = header(plan) + tables() + "0\nSECTION\n2\nENTITIES\n";
  for (const PlanSegment& face : plan.faces) {
    drawing += line(face, "SINGLE_FACES");
  }
  for (const PlanWall& wall : plan.walls) {
    drawing += wall_lines(survey, wall);
  }
  return drawing + "0\nENDSEC\n0\nEOF\n";
}

}  // namespace nvm::survey
