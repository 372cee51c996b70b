// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/scan_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lio/place/covered_face.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

constexpr float kWitnessRadius =
    0.05F;  // around a point of the map, where its face is looked for [m]
constexpr std::size_t kMostPoints = 25'000;
constexpr float kMinWitnessRange = 0.4F;   // nearer faces are about the sensor's carrier [m]
constexpr double kMaxWitnessRange = 10.0;  // [m]
constexpr float kMinWitnessCosine = 0.3F;  // of the incidence
/// How far noise, and the pose's error, may put a point off its face [m].
constexpr float kNoise = 0.05F;

}  // namespace

std::size_t count(const Testimonies& place, Testimony testimony) {
  return static_cast<std::size_t>(std::count(place.begin(), place.end(), testimony));
}

std::size_t count_only(const Testimonies& place, const Testimonies& other, Testimony testimony) {
  std::size_t only = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    only += place[i] == testimony && other[i] != testimony ? 1 : 0;
  }
  return only;
}

/// What is asked of the points, and what they have answered.
struct ScanWitness::Question {
  const VoxelMap& map;
  Pose T_map_scan;
  Eigen::Matrix3f R_map_scan;
  VoxelMap::QueryContext context;
  Testimonies answers;
};

/// A point of the map with its surroundings, in the scan frame.
struct ScanWitness::Face {
  Eigen::Vector3f center;
  Eigen::Vector3f normal;
  float range;
};

ScanWitness::ScanWitness(
    const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals)
    : lines_(points, kMinWitnessRange, [&, step = points.size() / kMostPoints + 1](std::size_t i) {
        return i % step == 0 && !normals[i].isZero();
      }) {
  for (const std::uint32_t index : lines_.indices()) {
    points_.push_back(points[index]);
    normals_.push_back(normals[index]);
    ranges_.push_back(points[index].norm());
    directions_.push_back(points[index] / ranges_.back());
  }
}

Testimonies ScanWitness::testify(const VoxelMap& map, const Pose& T_map_scan) const {
  Question question{map, T_map_scan, T_map_scan.linear().cast<float>(), {}, {}};
  question.answers.assign(size(), Testimony::kNone);
  const Eigen::Matrix3f R_scan_map = question.R_map_scan.transpose();
  const Eigen::Vector3d origin = T_map_scan.translation();
  map.for_each_within(origin, kMaxWitnessRange, [&](const Neighbor& neighbor) {
    Face face;
    face.center = R_scan_map * (neighbor.position - origin).template cast<float>();
    face.normal = R_scan_map * plane_normal(map.normal(neighbor.id));
    face.range = face.center.norm();
    if (face.range > kMinWitnessRange &&
        -face.normal.dot(face.center) > kMinWitnessCosine * face.range) {
      look_through(face, question);
    }
  });
  for (std::size_t i = 0; i < size(); ++i) {
    if (question.answers[i] == Testimony::kNone) {
      question.answers[i] = lies_on(i, question);
    }
  }
  return std::move(question.answers);
}

/// Has the points speak against the place whose lines of sight pass through `face`.
void ScanWitness::look_through(const Face& face, Question& question) const {
  const float height = -face.normal.dot(face.center);  // of the origin above the face
  lines_.for_each_near(
      face.center / face.range, kWitnessRadius / face.range, [&](std::size_t line) {
        const float descent = -face.normal.dot(directions_[line]);
        if (question.answers[line] == Testimony::kAgainst ||
            ranges_[line] * descent < height + kNoise) {
          return;
        }
        const Eigen::Vector3f passage = (height / descent) * directions_[line];
        if ((passage - face.center).squaredNorm() < kWitnessRadius * kWitnessRadius &&
            is_covered(
                question.map,
                question.T_map_scan * passage.cast<double>(),
                question.R_map_scan * face.normal,
                question.context)) {
          question.answers[line] = Testimony::kAgainst;
        }
      });
}

/// Whether the map has a face like the point's that it lies on, or only one right beside it.
Testimony ScanWitness::lies_on(std::size_t point, Question& question) const {
  constexpr double kFarthest = 0.15;  // [m]
  constexpr double kBeside = 0.06;    // along the face [m]
  constexpr float kLike = 0.8F;       // cosine between normals
  const VoxelMap& map = question.map;
  const Eigen::Vector3d p_map = question.T_map_scan * points_[point].cast<double>();
  const Eigen::Vector3f n_map = question.R_map_scan * normals_[point];
  std::array<Neighbor, 4> found;
  const std::size_t most =
      map.nearest(p_map, n_map, {found.size(), kFarthest}, found.data(), question.context);
  Testimony testimony = Testimony::kNone;
  for (std::size_t i = 0; i < most; ++i) {
    const Eigen::Vector3f normal = map.normal(found[i].id);
    if (normal.dot(n_map) < kLike) {
      continue;
    }
    const Eigen::Vector3d n = normal.cast<double>();
    const double height = n.dot(p_map - found[i].position);
    if (std::abs(height) < static_cast<double>(kNoise)) {
      return Testimony::kFor;
    }
    const bool is_beside = found[i].sq_distance - height * height < kBeside * kBeside;
    if (is_beside && is_covered(map, p_map - height * n, normal, question.context)) {
      testimony = Testimony::kAgainst;
    }
  }
  return testimony;
}

}  // namespace nvm::lio
