// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/solid_fields.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "sim/angles.hpp"
#include "sim/rectangle_cut.hpp"

namespace nvm::sim {
namespace {

constexpr config::Range kLength{1e-4, 1e4};  // [m]
constexpr config::Range kAngleDeg{-360.0, 360.0};

/// Opposite corners "min" and "max", of which the first must be below the second on `axes` axes.
std::pair<Eigen::Vector3d, Eigen::Vector3d> read_corners(Fields& item, Eigen::Index axes) {
  const Eigen::Vector3d min = item.point("min", 0.0);
  const Eigen::Vector3d max = item.point("max", 0.0);
  if ((max - min).head(axes).minCoeff() <= 0.0) {
    item.fail(R"("max" must be greater than "min")");
  }
  return {min, max};
}

Eigen::Matrix3d read_rotation(Fields& item) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  return euler_rotation_deg(item.optional("rotation_deg", none, kAngleDeg));
}

/// Boxes of `thickness` for rectangles in the plane of the two axes other than `across`.
std::vector<Box> plate_boxes(
    const std::vector<Rectangle>& rectangles,
    double thickness,
    Eigen::Index across,
    const Pose& T_local_plate) {
  const Eigen::Index u = 0;
  const Eigen::Index v = across == 1 ? 2 : 1;
  std::vector<Box> boxes;
  for (const Rectangle& rectangle : rectangles) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    center[u] = 0.5 * (rectangle.min_u + rectangle.max_u);
    center[v] = 0.5 * (rectangle.min_v + rectangle.max_v);
    Box& box = boxes.emplace_back();
    box.half_size[u] = 0.5 * (rectangle.max_u - rectangle.min_u);
    box.half_size[v] = 0.5 * (rectangle.max_v - rectangle.min_v);
    box.half_size[across] = 0.5 * thickness;
    box.T_world_box = T_local_plate * shift(center);
  }
  return boxes;
}

}  // namespace

Box read_box(Fields& item) {
  Box box;
  Eigen::Vector3d center;
  if (item.has("min")) {
    const auto [min, max] = read_corners(item, 3);
    center = 0.5 * (min + max);
    box.half_size = 0.5 * (max - min);
  } else {
    center = item.required<Eigen::Vector3d>("center");
    box.half_size = 0.5 * item.required<Eigen::Vector3d>("size", kLength);
  }
  box.T_world_box = make_pose(read_rotation(item), center);
  return box;
}

std::vector<Box> read_hull(Fields& item) {
  const auto [min, max] = read_corners(item, 3);
  const double thickness = item.optional("thickness", 0.3, kLength);
  const Eigen::Vector3d half_size = 0.5 * (max - min);
  std::vector<Box> boxes;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Eigen::Vector3d center = 0.5 * (min + max);
      center[axis] += sign * (half_size[axis] + 0.5 * thickness);
      Box& box = boxes.emplace_back();
      box.T_world_box = shift(center);
      box.half_size = half_size + Eigen::Vector3d::Constant(thickness);
      box.half_size[axis] = 0.5 * thickness;
    }
  }
  return boxes;
}

Cylinder read_cylinder(Fields& item) {
  Cylinder cylinder;
  cylinder.radius = item.required<double>("radius", kLength);
  cylinder.half_height = 0.5 * item.required<double>("height", kLength);
  const Eigen::Matrix3d R = read_rotation(item);
  const Eigen::Vector3d bottom = item.point("bottom", 0.0);
  cylinder.T_world_cylinder = make_pose(R, bottom + cylinder.half_height * R.col(2));
  return cylinder;
}

Pose read_placement(Fields& item) {
  const double yaw = rad(item.optional("yaw_deg", 0.0, kAngleDeg));
  return make_pose(euler_rotation(0.0, 0.0, yaw) * read_rotation(item), item.point("at", 0.0));
}

std::vector<Box> read_wall(Fields& item) {
  const Eigen::Vector3d from = item.point("from", 0.0);
  const Eigen::Vector3d along = item.point("to", 0.0) - from;
  const double length = along.norm();
  if (length < kLength.min || from.z() != 0.0 || along.z() != 0.0) {
    item.fail(R"("from" and "to" must be two different points [x, y])");
  }
  const double bottom = item.optional("bottom", 0.0);
  const auto height = item.required<double>("height", kLength);
  std::vector<Rectangle> openings;
  for (Fields& opening : item.items("openings")) {
    const auto start = opening.required<double>("from", {0.0, length});
    const auto end = opening.required<double>("to", {start, length});
    const double sill = opening.optional("bottom", 0.0, {0.0, height});
    const double top = opening.optional("top", 2.05, {sill, height});
    opening.finish();
    openings.push_back({start, end, bottom + sill, bottom + top});
  }
  const Eigen::Matrix3d R = euler_rotation(0.0, 0.0, std::atan2(along.y(), along.x()));
  return plate_boxes(
      cut_openings({0.0, length, bottom, bottom + height}, openings),
      item.required<double>("thickness", kLength),
      1,
      make_pose(R, from));
}

std::vector<Box> read_slab(Fields& item) {
  const auto [min, max] = read_corners(item, 2);
  std::vector<Rectangle> openings;
  for (Fields& opening : item.items("openings")) {
    const auto [low, high] = read_corners(opening, 2);
    opening.finish();
    openings.push_back({low.x(), high.x(), low.y(), high.y()});
  }
  const auto thickness = item.required<double>("thickness", kLength);
  const auto middle = item.required<double>("top") - 0.5 * thickness;
  return plate_boxes(
      cut_openings({min.x(), max.x(), min.y(), max.y()}, openings),
      thickness,
      2,
      shift({0.0, 0.0, middle}));
}

}  // namespace nvm::sim
