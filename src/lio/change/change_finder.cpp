// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/change/change_finder.hpp"

#include <Eigen/Geometry>
#include <optional>

#include "lio/place/covered_face.hpp"
#include "lio/place/sight_lines.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

constexpr std::size_t kMostLines = 30'000;  // of a scan
constexpr float kMinRange = 0.4F;           // [m]: nearer is the sensor's carrier
constexpr double kMaxRange = 8.0;           // [m]: farther out errors of the pose grow
constexpr float kMinCosine = 0.3F;          // of the incidence
constexpr float kFaceRadius = 0.05F;        // around a point of the map, that counts as face [m]
/// Depth along a face's normal that neither the noise of ranges nor an error of the pose makes [m].
constexpr float kDepth = 0.1F;
constexpr double kApart = 0.15;  // of an added surface from all that the map has [m]

/// A point of the map with its surroundings, in the scan frame.
struct Face {
  Eigen::Vector3f center;
  Eigen::Vector3f normal;
};

/// Where a line of sight passes a face or would if it went on.
struct Passage {
  Eigen::Vector3f place;  ///< [m], scan frame
  float depth;            ///< of the line's end behind the face [m]
};

}  // namespace

/// A scan in work.
struct ChangeFinder::View {
  const DeskewedScan& scan;
  const std::vector<Eigen::Vector3f>& normals;
  Pose T_map_scan;
  Eigen::Matrix3f R_map_scan;
  SightLines lines;
  std::vector<bool> is_blocked;  ///< before it reaches a face of the map; as lines.indices()
  VoxelMap::QueryContext context;

  std::size_t point(std::size_t line) const { return lines.indices()[line]; }
  const Eigen::Vector3f& begin(std::size_t line) const { return scan.viewpoints[point(line)]; }
  const Eigen::Vector3f& end(std::size_t line) const { return scan.points[point(line)]; }

  /// Nothing when it misses the face, or grazes it.
  std::optional<Passage> passage(std::size_t line, const Face& face) const {
    const Eigen::Vector3f way = end(line) - begin(line);
    const float height = face.normal.dot(begin(line) - face.center);
    const float descent = -face.normal.dot(way);
    if (height <= 0.0F || descent < kMinCosine * way.norm()) {
      return std::nullopt;
    }
    const Eigen::Vector3f place = begin(line) + (height / descent) * way;
    if ((place - face.center).squaredNorm() > kFaceRadius * kFaceRadius) {
      return std::nullopt;
    }
    return Passage{place, descent - height};
  }
};

void ChangeFinder::add(
    const DeskewedScan& scan, const std::vector<Eigen::Vector3f>& normals, const Pose& T_map_scan) {
  const std::size_t step = scan.size() / kMostLines + 1;
  const auto is_of_use = [&](std::size_t i) {
    return i % step == 0 && !plane_normal(normals[i]).isZero();
  };
  View view{
      scan,
      normals,
      T_map_scan,
      T_map_scan.linear().cast<float>(),
      SightLines(scan.points, kMinRange, is_of_use),
      {},
      {}};
  view.is_blocked.assign(view.lines.indices().size(), false);
  ++scans_;
  added_.next_scan();
  gone_.next_scan();
  prior_.for_each_within(
      T_map_scan.translation(), kMaxRange, [&](const Neighbor& face) { look_at_face(view, face); });
  note_added(view);
  look_through_added(view);
}

/// What the lines of sight say of a point of the map and the face around it.
void ChangeFinder::look_at_face(View& view, const Neighbor& neighbor) {
  const Eigen::Matrix3f R_scan_map = view.R_map_scan.transpose();
  const Eigen::Vector3f n_map = plane_normal(prior_.normal(neighbor.id));
  const Face face{
      R_scan_map * (neighbor.position - view.T_map_scan.translation()).cast<float>(),
      R_scan_map * n_map};
  const float range = face.center.norm();
  if (range < kMinRange || -face.normal.dot(face.center) < kMinCosine * range) {
    return;
  }
  bool is_passed = false;
  bool is_met = false;
  view.lines.for_each_near(face.center / range, kFaceRadius / range, [&](std::size_t line) {
    const std::optional<Passage> passage = view.passage(line, face);
    if (!passage) {
      return;
    }
    if (passage->depth < -kDepth) {
      view.is_blocked[line] = true;
    } else if (passage->depth <= kDepth) {
      is_met = true;
    } else if (!is_passed) {
      const Eigen::Vector3d p_map = view.T_map_scan * passage->place.cast<double>();
      is_passed = is_covered(prior_, p_map, n_map, view.context);
    }
  });
  if (is_met) {
    gone_.object(neighbor.position, n_map);
  } else if (is_passed) {
    gone_.vote(neighbor.position, n_map);
  }
}

void ChangeFinder::note_added(View& view) {
  Neighbor nearest;
  for (std::size_t line = 0; line < view.is_blocked.size(); ++line) {
    const Eigen::Vector3d p_map = view.T_map_scan * view.end(line).cast<double>();
    if (view.is_blocked[line] && prior_.nearest(p_map, {1, kApart}, &nearest, view.context) == 0) {
      added_.vote(p_map, view.R_map_scan * view.normals[view.point(line)]);
    }
  }
}

/// People who have passed are seen through later.
void ChangeFinder::look_through_added(const View& view) {
  const Eigen::Matrix3f R_scan_map = view.R_map_scan.transpose();
  added_.object_where([&](const Eigen::Vector3d& position) {
    const Eigen::Vector3f center =
        R_scan_map * (position - view.T_map_scan.translation()).cast<float>();
    const float range = center.norm();
    bool is_passed = false;
    if (range > kMinRange && range < static_cast<float>(kMaxRange)) {
      view.lines.for_each_near(center / range, kFaceRadius / range, [&](std::size_t line) {
        const Eigen::Vector3f way = view.end(line) - view.begin(line);
        const Eigen::Vector3f offset = center - view.begin(line);
        const float along = way.normalized().dot(offset);
        const float beside = way.normalized().cross(offset).norm();
        is_passed |= beside < 0.5F * kFaceRadius && way.norm() > along + 2.0F * kDepth;
      });
    }
    return is_passed;
  });
}

}  // namespace nvm::lio
