// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/sightings.hpp"

#include <algorithm>
#include <cmath>

namespace nvm::survey {

namespace {

constexpr double kMinPoints = 8.0;
constexpr double kMinNormalCosine = 0.85;  // 30 degrees, of a point's normal to the face's

/// What a keyframe shows, in the frame of the faces.
struct View {
  double time = 0.0;
  Eigen::Vector3d sensor;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  double reach = 0.0;  ///< of its farthest point [m]
};

View view_of(const io::Keyframe& keyframe, const Eigen::Vector3d& origin) {
  View view;
  view.time = keyframe.time;
  view.sensor = keyframe.T_map_lidar.translation() - origin;
  for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
    const Eigen::Vector3d p = keyframe.points[i].cast<double>();
    view.points.emplace_back(keyframe.T_map_lidar * p - origin);
    view.normals.emplace_back(keyframe.T_map_lidar.linear() * keyframe.normals[i].cast<double>());
    view.reach = std::max(view.reach, p.norm());
  }
  return view;
}

/// Where a side is looked for.
struct Side {
  const Face* face = nullptr;
  const PlaneFrame* frame = nullptr;  ///< of the mask
  const Mask* overlap = nullptr;
  Eigen::Vector3d center;
  double radius = 0.0;  ///< of the overlap [m]
  double gate = 0.0;    ///< of distances to the face [m]
};

Side side_of(const std::vector<Face>& faces, const FacePair& pair, std::size_t side) {
  constexpr double kMinGate = 0.02;  // poses are off by less, and other faces of this side farther
  Side result;
  result.face = &faces[side == 0 ? pair.first : pair.second];
  result.frame = &faces[pair.first].frame;
  result.overlap = &pair.overlap;
  PlaneBox box;
  pair.overlap.for_each([&](int column, int row) {
    box.extend(pair.overlap.u(column), pair.overlap.v(row));
    box.extend(pair.overlap.u(column + 1), pair.overlap.v(row + 1));
  });
  result.center = result.frame->point(0.5 * (box.min_u + box.max_u), 0.5 * (box.min_v + box.max_v));
  result.radius = 0.5 * std::hypot(box.width(), box.height());
  result.gate = std::max(kMinGate, 4.0 * result.face->rms);
  return result;
}

std::optional<Sighting> sighting_of(const View& view, const Side& side) {
  const eval::OrientedPlane& plane = side.face->plane;
  if (plane.distance(view.sensor) <= 0.0 ||
      (view.sensor - side.center).norm() > view.reach + side.radius) {
    return std::nullopt;
  }
  double count = 0.0;
  double sum = 0.0;
  double sq_sum = 0.0;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const Eigen::Vector3d& p = view.points[i];
    const double distance = plane.distance(p);
    if (std::abs(distance) < side.gate && plane.normal.dot(view.normals[i]) > kMinNormalCosine &&
        side.overlap->covers(side.frame->coordinate_u(p), side.frame->coordinate_v(p))) {
      count += 1.0;
      sum += distance;
      sq_sum += distance * distance;
    }
  }
  if (count < kMinPoints) {
    return std::nullopt;
  }
  const double mean = sum / count;
  return Sighting{view.time, mean, (sq_sum / count - mean * mean) / (count - 1.0)};
}

}  // namespace

std::vector<WallSightings> find_sightings(
    const SurveyCloud& cloud,
    const std::vector<Face>& faces,
    const std::vector<FacePair>& pairs,
    const KeyframeSource& next) {
  std::vector<std::array<Side, 2>> sides;
  for (const FacePair& pair : pairs) {
    sides.push_back({side_of(faces, pair, 0), side_of(faces, pair, 1)});
  }
  std::vector<WallSightings> sightings(pairs.size());
  while (const std::optional<io::Keyframe> keyframe = next()) {
    const View view = view_of(*keyframe, cloud.origin);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (const std::size_t side : {0U, 1U}) {
        if (const auto sighting = sighting_of(view, sides[i][side])) {
          sightings[i][side].push_back(*sighting);
        }
      }
    }
  }
  return sightings;
}

}  // namespace nvm::survey
