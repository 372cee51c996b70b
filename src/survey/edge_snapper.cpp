// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/edge_snapper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nvm::survey {

namespace {

constexpr double kEdgeReach = 0.3;  // [m]; from an edge over cells to where it may belong

double length(const PlanePoint& a, const PlanePoint& b) { return std::hypot(b.u - a.u, b.v - a.v); }

/// True when face `other` shows something within kEdgeReach of `p`.
bool is_near(const Face& other, const Eigen::Vector3d& p) {
  const double u = other.frame.coordinate_u(p);
  const double v = other.frame.coordinate_v(p);
  return std::abs(other.plane.distance(p)) < kEdgeReach && u > other.box.min_u - kEdgeReach &&
         u < other.box.max_u + kEdgeReach && v > other.box.min_v - kEdgeReach &&
         v < other.box.max_v + kEdgeReach;
}

}  // namespace

EdgeSnapper::EdgeSnapper(const SurveyCloud& cloud, const std::vector<Face>& faces)
    : cloud_(cloud), faces_(faces) {
  for (const Face& face : faces) {
    Eigen::AlignedBox3d box;
    for (const double u : {face.box.min_u, face.box.max_u}) {
      for (const double v : {face.box.min_v, face.box.max_v}) {
        box.extend(face.frame.point(u, v));
      }
    }
    boxes_.push_back(box);
  }
}

EdgeSnapper::Surroundings EdgeSnapper::surroundings(std::size_t index) const {
  constexpr double kMaxCosine = 0.87;  // of two planes that cut: 30 degrees
  const Face& face = faces_[index];
  Surroundings result{face, {}, {}};
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(2.0 * kEdgeReach);
  const Eigen::AlignedBox3d box(boxes_[index].min() - reach, boxes_[index].max() + reach);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (box.intersects(boxes_[i]) &&
        std::abs(faces_[i].plane.normal.dot(face.plane.normal)) < kMaxCosine) {
      result.neighbors.push_back(&faces_[i]);
    }
  }
  for (const std::uint32_t i : face.points) {
    const Eigen::Vector3d& p = cloud_.positions[i];
    result.points.push_back({face.frame.coordinate_u(p), face.frame.coordinate_v(p)});
  }
  return result;
}

double EdgeSnapper::end_of_points(const Surroundings& around, const Line& line, const Edge& edge) {
  constexpr double kShare = 0.95;  // of the points near the edge that lie within it
  constexpr std::size_t kMinPoints = 5;
  const double reach = length(edge.from, edge.to);
  const double along_u = (edge.to.u - edge.from.u) / reach;
  const double along_v = (edge.to.v - edge.from.v) / reach;
  std::vector<double> offsets;
  for (const auto& [u, v] : around.points) {
    const double offset = line.a * u + line.b * v - line.c;
    const double along = along_u * (u - edge.from.u) + along_v * (v - edge.from.v);
    if (std::abs(offset) < 1.5 * around.face.seen.cell() && along > 0.0 && along < reach) {
      offsets.push_back(offset);
    }
  }
  if (offsets.size() < kMinPoints) {
    return line.c;
  }
  std::sort(offsets.begin(), offsets.end());
  const double share = edge.is_of_hole ? 1.0 - kShare : kShare;
  return line.c +
         offsets[static_cast<std::size_t>(share * static_cast<double>(offsets.size() - 1))];
}

std::vector<EdgeSnapper::Line> EdgeSnapper::cuts_along(
    const Surroundings& around, const Edge& loop_edge, const Line& edge) {
  constexpr double kMaxSlope = 0.18;  // of an edge against the cut: 10 degrees
  const Face& face = around.face;
  const double edge_length = length(loop_edge.from, loop_edge.to);
  const double middle_u = 0.5 * (loop_edge.from.u + loop_edge.to.u);
  const double middle_v = 0.5 * (loop_edge.from.v + loop_edge.to.v);
  const Eigen::Vector3d middle = face.frame.point(middle_u, middle_v);
  std::vector<Line> cuts;
  for (const Face* other : around.neighbors) {
    if (!is_near(*other, middle)) {
      continue;
    }
    Line cut{
        other->plane.normal.dot(face.frame.u),
        other->plane.normal.dot(face.frame.v),
        -other->plane.distance(face.frame.origin),
        true};
    const double scale =
        (cut.a * edge.a + cut.b * edge.b < 0.0 ? -1.0 : 1.0) / std::hypot(cut.a, cut.b);
    cut = {scale * cut.a, scale * cut.b, scale * cut.c, true};
    const double slope = std::abs(cut.a * edge.b - cut.b * edge.a);
    if (std::abs(cut.a * middle_u + cut.b * middle_v - cut.c) < kEdgeReach &&
        slope * std::min(edge_length, 1.0) < kMaxSlope) {
      cuts.push_back(cut);
    }
  }
  return cuts;
}

EdgeSnapper::Line EdgeSnapper::edge_line(const Surroundings& around, const Edge& loop_edge) {
  const auto& [from, to, is_of_hole] = loop_edge;
  const double edge_length = std::max(length(from, to), 1e-9);
  Line edge{(to.v - from.v) / edge_length, (from.u - to.u) / edge_length, 0.0};
  edge.c = edge.a * from.u + edge.b * from.v;
  const std::vector<Line> cuts = cuts_along(around, loop_edge, edge);
  if (cuts.size() == 1) {
    return cuts[0];
  }
  const double end =
      edge_length > around.face.seen.cell() ? end_of_points(around, edge, loop_edge) : edge.c;
  // Of a wall that this face abuts on both sides may be near: it ends at that where its points do.
  const double u = 0.5 * (from.u + to.u) + (end - edge.c) * edge.a;
  const double v = 0.5 * (from.v + to.v) + (end - edge.c) * edge.b;
  edge.c = end;
  const auto distance = [&](const Line& cut) { return std::abs(cut.a * u + cut.b * v - cut.c); };
  const auto nearest =
      std::min_element(cuts.begin(), cuts.end(), [&](const Line& first, const Line& second) {
        return distance(first) < distance(second);
      });
  return nearest == cuts.end() ? edge : *nearest;
}

Loop EdgeSnapper::snap(std::size_t index, const Loop& loop, bool is_hole) const {
  constexpr double kMinSine = 0.25;  // of two edges that make a corner
  constexpr double kMaxMove = 0.5;   // [m]
  const std::size_t size = loop.size();
  const Surroundings around = surroundings(index);
  std::vector<Line> lines;
  for (std::size_t i = 0; i < size; ++i) {
    lines.push_back(edge_line(around, {loop[i], loop[(i + 1) % size], is_hole}));
  }
  Loop result;
  for (std::size_t i = 0; i < size; ++i) {
    const Line& before = lines[(i + size - 1) % size];
    const Line& after = lines[i];
    const double sine = before.a * after.b - before.b * after.a;
    PlanePoint corner = loop[i];
    if (std::abs(sine) > kMinSine) {
      corner = {
          (before.c * after.b - before.b * after.c) / sine,
          (before.a * after.c - before.c * after.a) / sine};
    } else {
      const Line& known = before.is_cut && !after.is_cut ? before : after;
      const double off = known.a * corner.u + known.b * corner.v - known.c;
      corner = {corner.u - off * known.a, corner.v - off * known.b};
    }
    result.push_back(length(corner, loop[i]) < kMaxMove ? corner : loop[i]);
  }
  return result;
}

}  // namespace nvm::survey
