// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/plan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace nvm::survey {

namespace {

class Cutter {
 public:
  Cutter(const Eigen::Vector3d& up, double height) : up_(up), height_(height) {
    x_ = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
    y_ = up.cross(x_);
  }

  /// The parts of the cut that lie within `polygon`, a plane with this normal.
  std::vector<PlanSegment> cut(const Polygon& polygon, const Eigen::Vector3d& normal) const {
    constexpr double kMinSine = 0.3;  // flatter planes have no line in a plan
    const Eigen::Vector3d line = up_.cross(normal);
    std::vector<PlanSegment> segments;
    if (line.norm() < kMinSine) {
      return segments;
    }
    std::vector<Eigen::Vector3d> crossings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector3d& a = polygon[i];
      const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
      const double below_a = a.dot(up_) - height_;
      const double below_b = b.dot(up_) - height_;
      if ((below_a < 0.0) != (below_b < 0.0)) {
        crossings.push_back(a + below_a / (below_a - below_b) * (b - a));
      }
    }
    std::sort(crossings.begin(), crossings.end(), [&](const auto& a, const auto& b) {
      return a.dot(line) < b.dot(line);
    });
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      segments.push_back({flat(crossings[i + 1]), flat(crossings[i])});
    }
    return segments;
  }

  std::vector<PlanSegment> cut(const SurveyFace& face) const {
    std::vector<PlanSegment> segments = cut(face.polygon, face.plane.normal);
    for (const Polygon& part : face.parts) {
      for (const PlanSegment& segment : cut(part, face.plane.normal)) {
        segments.push_back(segment);
      }
    }
    return segments;
  }

 private:
  PlanPoint flat(const Eigen::Vector3d& p) const { return {x_.dot(p), y_.dot(p)}; }

  Eigen::Vector3d up_;
  Eigen::Vector3d x_;
  Eigen::Vector3d y_;
  double height_;
};

double length(const PlanSegment& s) { return std::hypot(s.to.x - s.from.x, s.to.y - s.from.y); }

/// The share of `segment` from its start at which `p` is nearest.
double position_on(const PlanSegment& segment, const PlanPoint& p) {
  const double dx = segment.to.x - segment.from.x;
  const double dy = segment.to.y - segment.from.y;
  const double square = std::max(dx * dx + dy * dy, 1e-12);
  return ((p.x - segment.from.x) * dx + (p.y - segment.from.y) * dy) / square;
}

/// `segment` without what the openings, along the same line, cut out of it.
std::vector<PlanSegment> without(
    const PlanSegment& segment, const std::vector<PlanSegment>& openings) {
  std::vector<std::array<double, 2>> gaps;
  for (const PlanSegment& opening : openings) {
    const double a = position_on(segment, opening.from);
    const double b = position_on(segment, opening.to);
    gaps.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(gaps.begin(), gaps.end());
  const auto at = [&](double share) {
    return PlanPoint{
        segment.from.x + share * (segment.to.x - segment.from.x),
        segment.from.y + share * (segment.to.y - segment.from.y)};
  };
  std::vector<PlanSegment> rest;
  double begin = 0.0;
  for (const auto& gap : gaps) {
    if (gap[0] > begin) {
      rest.push_back({at(begin), at(std::min(gap[0], 1.0))});
    }
    begin = std::clamp(gap[1], begin, 1.0);
  }
  if (begin < 1.0) {
    rest.push_back({at(begin), segment.to});
  }
  return rest;
}

PlanPoint label_point(const PlanWall& wall) {
  PlanPoint sum;
  double count = 0.0;
  for (const std::vector<PlanSegment>& face : wall.faces) {
    const auto longest =
        std::max_element(face.begin(), face.end(), [](const PlanSegment& a, const PlanSegment& b) {
          return length(a) < length(b);
        });
    if (longest != face.end()) {
      sum.x += 0.5 * (longest->from.x + longest->to.x);
      sum.y += 0.5 * (longest->from.y + longest->to.y);
      count += 1.0;
    }
  }
  return {sum.x / count, sum.y / count};
}

void extend(const std::vector<PlanSegment>& segments, Plan& plan) {
  for (const PlanSegment& segment : segments) {
    for (const PlanPoint& p : {segment.from, segment.to}) {
      plan.min = {std::min(plan.min.x, p.x), std::min(plan.min.y, p.y)};
      plan.max = {std::max(plan.max.x, p.x), std::max(plan.max.y, p.y)};
    }
  }
}

void add_walls(const std::vector<Wall>& walls, bool are_bodies, const Cutter& cutter, Plan& plan) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    PlanWall cut;
    cut.wall = i;
    cut.is_body = are_bodies;
    for (const Opening& opening : walls[i].openings) {
      for (const PlanSegment& segment :
           cutter.cut(opening.polygon, walls[i].faces[0].plane.normal)) {
        cut.openings.push_back(segment);
      }
    }
    for (std::size_t side = 0; side < 2; ++side) {
      for (const PlanSegment& segment : cutter.cut(walls[i].faces[side])) {
        for (const PlanSegment& solid : without(segment, cut.openings)) {
          cut.faces[side].push_back(solid);
        }
      }
      extend(cut.faces[side], plan);
    }
    if (!cut.faces[0].empty() || !cut.faces[1].empty()) {
      cut.label = label_point(cut);
      plan.walls.push_back(std::move(cut));
    }
  }
}

}  // namespace

Plan make_plan(const Survey& survey, double height) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Plan plan;
  plan.height = survey.floor + height;
  plan.min = {kInfinity, kInfinity};
  plan.max = {-kInfinity, -kInfinity};
  const Cutter cutter(survey.up, plan.height);
  add_walls(survey.walls, false, cutter, plan);
  add_walls(survey.bodies, true, cutter, plan);
  for (const SurveyFace& face : survey.faces) {
    for (const PlanSegment& segment : cutter.cut(face)) {
      plan.faces.push_back(segment);
    }
  }
  extend(plan.faces, plan);
  if (plan.min.x > plan.max.x) {
    plan.min = plan.max = {};
  }
  return plan;
}

}  // namespace nvm::survey
