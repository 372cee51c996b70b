// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/plan_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nvm::survey {

namespace {

constexpr const char* kStyle = R"(<style>
text { font: 11px sans-serif; fill: #222; text-anchor: middle; paint-order: stroke; stroke: #fff; stroke-width: 3px; }
line { stroke: #222; stroke-width: 1.4; stroke-linecap: round; }
.single { stroke: #8a8a8a; stroke-width: 1; }
.body { stroke: #9a7b4f; stroke-width: 1; }
.opening { stroke: #2b7bba; stroke-width: 1; stroke-dasharray: 4 3; }
.fill { stroke: none; fill: #d9d4cc; }
.fill.door { fill: #bcd7ee; }
.wall:hover .fill { fill: #f3b562; }
</style>
)";

/// Pixels of a plan, y downwards.
class Paper {
 public:
  explicit Paper(const Plan& plan) : plan_(plan) {
    constexpr double kLargest = 1600.0;  // [px]
    constexpr double kUsual = 60.0;      // [px/m]
    const double extent = std::max({plan.max.x - plan.min.x, plan.max.y - plan.min.y, 1.0});
    scale_ = std::min(kUsual, kLargest / extent);
  }

  double width() const { return 2.0 * kMargin + scale_ * (plan_.max.x - plan_.min.x); }
  double height() const { return 2.0 * kMargin + scale_ * (plan_.max.y - plan_.min.y); }
  double x(const PlanPoint& p) const { return kMargin + scale_ * (p.x - plan_.min.x); }
  double y(const PlanPoint& p) const { return kMargin + scale_ * (plan_.max.y - p.y); }

  std::string line(const PlanSegment& s, const std::string& css_class) const {
    return fmt::format(
        "<line class=\"{}\" x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"/>\n",
        css_class,
        x(s.from),
        y(s.from),
        x(s.to),
        y(s.to));
  }

  /// A bar of one metre in the lower left corner.
  std::string scale_bar() const {
    const double bottom = height() - 10.0;
    return fmt::format(
        "<line x1=\"10\" y1=\"{0:.1f}\" x2=\"{1:.1f}\" y2=\"{0:.1f}\"/>\n"
        "<text x=\"{2:.1f}\" y=\"{3:.1f}\">1 m</text>\n",
        bottom,
        10.0 + scale_,
        10.0 + 0.5 * scale_,
        bottom - 4.0);
  }

 private:
  static constexpr double kMargin = 40.0;  // [px]
  const Plan& plan_;
  double scale_;
};

/// The area between two segments of opposite directions.
std::string fill(
    const Paper& paper, const PlanSegment& a, const PlanSegment& b, const std::string& kind) {
  return fmt::format(
      "<path class=\"fill {}\" d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}L{:.2f} {:.2f}L{:.2f} {:.2f}Z\"/>\n",
      kind,
      paper.x(a.from),
      paper.y(a.from),
      paper.x(a.to),
      paper.y(a.to),
      paper.x(b.from),
      paper.y(b.from),
      paper.x(b.to),
      paper.y(b.to));
}

/// The segment of `others` whose middle is nearest to that of `segment`; null without any.
const PlanSegment* nearest(const PlanSegment& segment, const std::vector<PlanSegment>& others) {
  const auto distance = [&](const PlanSegment& other) {
    return std::hypot(
        other.from.x + other.to.x - segment.from.x - segment.to.x,
        other.from.y + other.to.y - segment.from.y - segment.to.y);
  };
  const auto best = std::min_element(
      others.begin(), others.end(), [&](const PlanSegment& a, const PlanSegment& b) {
        return distance(a) < distance(b);
      });
  return best == others.end() ? nullptr : &*best;
}

std::string wall_group(const Survey& survey, const Paper& paper, const PlanWall& cut) {
  const Wall& wall = (cut.is_body ? survey.bodies : survey.walls)[cut.wall];
  std::string group = fmt::format(
      "<g class=\"wall\" id=\"{}-{}\">\n<title>{} {}: {:.1f} ± {:.1f} mm</title>\n",
      cut.is_body ? "body" : "wall",
      cut.wall,
      kind_name(wall.kind),
      cut.wall,
      1e3 * wall.thickness,
      1.96e3 * wall.thickness_std);
  for (const PlanSegment& segment : cut.faces[0]) {
    const PlanSegment* other = nearest(segment, cut.faces[1]);
    if (other != nullptr && !cut.is_body) {
      group += fill(paper, segment, *other, kind_name(wall.kind));
    }
  }
  for (const std::vector<PlanSegment>& face : cut.faces) {
    for (const PlanSegment& segment : face) {
      group += paper.line(segment, cut.is_body ? "body" : "face");
    }
  }
  for (const PlanSegment& opening : cut.openings) {
    group += paper.line(opening, "opening");
  }
  if (!cut.is_body) {
    group += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{:.0f}</text>\n",
        paper.x(cut.label),
        paper.y(cut.label) - 6.0,
        1e3 * wall.thickness);
  }
  return group + "</g>\n";
}

}  // namespace

std::string plan_svg(const Survey& survey, const Plan& plan) {
  const Paper paper(plan);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n{2}",
      paper.width(),
      paper.height(),
      kStyle);
  for (const PlanSegment& face : plan.faces) {
    svg += paper.line(face, "single");
  }
  for (const PlanWall& wall : plan.walls) {
    svg += wall_group(survey, paper, wall);
  }
  return svg + paper.scale_bar() + "</svg>\n";
}

}  // namespace nvm::survey
