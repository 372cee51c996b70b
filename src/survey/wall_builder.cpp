// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/wall_builder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace nvm::survey {

namespace {

constexpr double kUpright = 0.34;  // |n . up| of walls: within 20 degrees
constexpr double kLevel = 0.94;    // of slabs: within 20 degrees
constexpr double kMinPart = 0.3;   // [m²]; smaller parts of a face and smaller openings are left

PlaneBox box_of(const Mask& mask) {
  PlaneBox box;
  mask.for_each([&](int column, int row) {
    box.extend(mask.u(column), mask.v(row));
    box.extend(mask.u(column + 1), mask.v(row + 1));
  });
  return box;
}

/// `hole` down to the wall's foot, where that is near and no side shows anything between: the foot
/// of a wall is often hidden from the sensor, on both sides of a door as well.
Mask down_to_foot(const Mask& hole, const Mask& shown, const PlaneBox& wall) {
  constexpr double kReach = 0.7;  // [m]
  constexpr double kMostly = 0.8;
  const int foot = shown.row(wall.min_v + 0.5 * shown.cell());
  Mask result = hole;
  int columns = 0;
  int open_columns = 0;
  for (int column = 0; column < hole.columns(); ++column) {
    int bottom = foot;
    while (bottom < hole.rows() && !hole.get(column, bottom)) {
      ++bottom;
    }
    if (bottom == hole.rows()) {
      continue;
    }
    ++columns;
    bool is_open = (bottom - foot) * hole.cell() <= kReach;
    for (int row = foot; row < bottom && is_open; ++row) {
      is_open = !shown.get(column, row);
    }
    for (int row = foot; row < bottom && is_open; ++row) {
      result.set(column, row);
    }
    open_columns += is_open ? 1 : 0;
  }
  return open_columns >= kMostly * columns ? result : hole;
}

std::string opening_kind(const PlaneBox& opening, const PlaneBox& wall) {
  constexpr double kTouch = 0.25;      // [m]
  constexpr double kLowestDoor = 1.5;  // as far as its foot is seen [m]
  const bool from_floor = opening.min_v < wall.min_v + kTouch;
  const bool to_ceiling = opening.max_v > wall.max_v - kTouch;
  if (from_floor && to_ceiling) {
    return "passage";
  }
  if (from_floor && opening.height() > kLowestDoor && opening.width() > 0.5 &&
      opening.width() < 2.2) {
    return "door";
  }
  return !from_floor && !to_ceiling ? "window" : "gap";
}

}  // namespace

WallBuilder::WallBuilder(
    const SurveyCloud& cloud,
    const std::vector<Face>& faces,
    const std::vector<FacePair>& pairs,
    const Eigen::Vector3d& up,
    const SurveyOptions& options)
    : cloud_(cloud),
      faces_(faces),
      pairs_(pairs),
      up_(up),
      options_(options),
      snapper_(cloud, faces) {
  for (const Face& face : faces) {
    rest_.push_back(face.seen);
  }
  for (const FacePair& pair : pairs) {
    const Mask around = dilated(pair.overlap, 4);  // beyond the end of a wall at a corner
    rest_[pair.first] = difference(rest_[pair.first], around);
    rest_[pair.second] = difference(rest_[pair.second], on_second(pair, around));
  }
}

bool WallBuilder::is_upright(const Face& face) const {
  return std::abs(face.plane.normal.dot(up_)) < kUpright;
}

int WallBuilder::gap_cells(const Mask& mask) const {
  return static_cast<int>(options_.max_gap / mask.cell());
}

Mask WallBuilder::on_second(const FacePair& pair, const Mask& on_first) const {
  const PlaneFrame& frame = faces_[pair.first].frame;
  const Face& second = faces_[pair.second];
  Mask result = Mask::like(second.seen);
  second.seen.for_each([&](int column, int row) {
    const Eigen::Vector3d p =
        second.frame.point(second.seen.u(column + 0.5), second.seen.v(row + 0.5));
    result.set(column, row, on_first.covers(frame.coordinate_u(p), frame.coordinate_v(p)));
  });
  return result;
}

Polygon WallBuilder::in_map(const Face& face, const Loop& loop) const {
  Polygon polygon;
  for (const PlanePoint& p : loop) {
    polygon.push_back(face.frame.point(p.u, p.v) + cloud_.origin);
  }
  return polygon;
}

SurveyFace WallBuilder::face(std::size_t index, const Mask& region) const {
  const Face& face = faces_[index];
  SurveyFace result;
  result.plane = face.plane;
  result.plane.offset += face.plane.normal.dot(cloud_.origin);
  result.area = region.area();
  double sq_sum = 0.0;
  constexpr double kBlock = 0.5;  // [m]
  constexpr double kMinCount = 8.0;
  std::map<std::pair<int, int>, std::pair<double, double>> blocks;
  for (const std::uint32_t i : face.points) {
    const Eigen::Vector3d& p = cloud_.positions[i];
    const double u = face.frame.coordinate_u(p);
    const double v = face.frame.coordinate_v(p);
    if (region.covers(u, v)) {
      const double distance = face.plane.distance(p);
      ++result.points;
      sq_sum += distance * distance;
      auto& [sum, count] = blocks[{
          static_cast<int>(std::floor(u / kBlock)), static_cast<int>(std::floor(v / kBlock))}];
      sum += distance;
      count += 1.0;
    }
  }
  result.rms = std::sqrt(sq_sum / static_cast<double>(std::max<std::size_t>(result.points, 1)));
  for (const auto& [key, block] : blocks) {
    if (block.second >= kMinCount) {
      result.bow = std::max(result.bow, std::abs(block.first / block.second));
    }
  }
  const Mask filled = is_upright(face) ? closed_along_rows(region, gap_cells(region)) : region;
  for (const Mask& part : components(filled, kMinPart)) {
    const Loop outer = trace(part).front();
    const Loop loop = snapper_.snap(index, simplified(outer, 1.5 * part.cell()));
    (result.polygon.empty() ? result.polygon : result.parts.emplace_back()) = in_map(face, loop);
  }
  return result;
}

std::vector<Opening> WallBuilder::openings(const FacePair& pair, const Mask& shown) const {
  const Face& face = faces_[pair.first];
  std::vector<Opening> result;
  if (!is_upright(face)) {
    return result;
  }
  const PlaneBox wall = box_of(shown);
  const Mask whole = filled(closed_along_rows(shown, gap_cells(shown)));
  const Mask empty = difference(whole, shown);
  for (const Mask& seen : components(dilated(eroded(empty, 1), 1), kMinPart)) {
    const Mask hole = down_to_foot(seen, shown, wall);
    const PlaneBox box = box_of(hole);
    const Loop loop =
        snapper_.snap(pair.first, simplified(trace(hole).front(), 1.5 * hole.cell()), true);
    PlaneBox sharp;
    for (const PlanePoint& p : loop) {
      sharp.extend(p.u, p.v);
    }
    result.push_back({opening_kind(box, wall), in_map(face, loop), sharp.width(), sharp.height()});
  }
  return result;
}

Wall WallBuilder::wall(std::size_t index, const WallThickness& measured) const {
  const FacePair& pair = pairs_[index];
  const Face& first = faces_[pair.first];
  const Face& second = faces_[pair.second];
  const int beyond = 1 + static_cast<int>(std::ceil(0.3 / pair.overlap.cell()));
  const Mask around = dilated(closed_along_rows(pair.overlap, gap_cells(pair.overlap)), beyond);
  Wall wall;
  wall.thickness = measured.value;
  wall.angle = std::acos(std::clamp(-first.plane.normal.dot(second.plane.normal), -1.0, 1.0));
  wall.area = pair.overlap.area();
  const PlaneBox box = box_of(pair.overlap);
  wall.length = is_upright(first) ? box.width() : std::max(box.width(), box.height());
  wall.height = is_upright(first) ? box.height() : std::min(box.width(), box.height());
  wall.kind = kind(index, wall);
  wall.faces[0] = face(pair.first, intersection(first.seen, around));
  wall.faces[1] = face(pair.second, on_second(pair, around));
  Mask shown = intersection(first.seen, around);
  around.for_each([&](int column, int row) {
    const Eigen::Vector3d p = first.frame.point(around.u(column + 0.5), around.v(row + 0.5));
    if (second.seen.covers(second.frame.coordinate_u(p), second.frame.coordinate_v(p))) {
      shown.set(column, row);
    }
  });
  wall.openings = openings(pair, shown);
  return wall;
}

bool WallBuilder::is_before_a_wall(std::size_t index) const {
  constexpr double kStep = 0.01;  // [m]
  const FacePair& pair = pairs_[index];
  for (std::size_t other = 0; other < pairs_.size(); ++other) {
    const FacePair& thinner = pairs_[other];
    for (const std::size_t shared : {pair.first, pair.second}) {
      const bool is_shared = thinner.first == shared || thinner.second == shared;
      if (other == index || !is_shared || thinner.distance > pair.distance - kStep ||
          thinner.overlap.area() < pair.overlap.area()) {
        continue;
      }
      // A wall reaches as high as the one beside it, furniture rarely.
      const auto top = [&](const FacePair& p) {
        return faces_[p.first].frame.point(0.0, box_of(p.overlap).max_v).dot(up_);
      };
      if (top(pair) < top(thinner) - 0.25) {
        return true;
      }
    }
  }
  return false;
}

double WallBuilder::shown_height(const FacePair& pair, const Face& side) const {
  const PlaneFrame& frame = faces_[pair.first].frame;
  const PlaneBox overlap = box_of(pair.overlap);
  PlaneBox shown;
  side.seen.for_each([&](int column, int row) {
    const Eigen::Vector3d p = side.frame.point(side.seen.u(column + 0.5), side.seen.v(row + 0.5));
    const double u = frame.coordinate_u(p);
    if (u > overlap.min_u && u < overlap.max_u) {
      shown.extend(u, frame.coordinate_v(p));
    }
  });
  return shown.height() + side.seen.cell();
}

WallKind WallBuilder::kind(std::size_t index, const Wall& wall) const {
  const double slope = std::abs(faces_[pairs_[index].first].plane.normal.dot(up_));
  if (slope > kLevel) {
    return wall.area >= 4.0 ? WallKind::kSlab : WallKind::kPanel;
  }
  if (slope > kUpright) {
    return WallKind::kSloped;
  }
  if (wall.thickness > 0.2 && wall.length < 2.5 * wall.thickness) {
    return WallKind::kColumn;
  }
  const bool is_thick_and_low = wall.thickness > 0.25 && wall.height < 2.0 && wall.length < 3.0;
  if (is_thick_and_low || is_before_a_wall(index)) {
    return WallKind::kFurniture;
  }
  // Of a leaf one side is often seen by half; of a closed one, one side is flush with its wall.
  const FacePair& pair = pairs_[index];
  const std::array<double, 3> heights{
      wall.height, shown_height(pair, faces_[pair.first]), shown_height(pair, faces_[pair.second])};
  const bool is_as_high_as_a_leaf =
      std::any_of(heights.begin(), heights.end(), [](double h) { return h > 1.6 && h < 2.4; });
  if (wall.thickness <= 0.07 && wall.length < 1.3 && is_as_high_as_a_leaf) {
    return WallKind::kDoor;
  }
  const double highest = *std::max_element(heights.begin(), heights.end());
  return highest < 1.9 ? WallKind::kPartition : WallKind::kWall;
}

std::vector<SurveyFace> WallBuilder::single_faces() const {
  std::vector<SurveyFace> result;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (rest_[i].area() >= options_.min_area) {
      SurveyFace single = face(i, rest_[i]);
      if (!single.polygon.empty()) {
        result.push_back(std::move(single));
      }
    }
  }
  return result;
}

}  // namespace nvm::survey
