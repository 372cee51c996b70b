// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/inside_out.hpp"

#include <cmath>

#include "survey/pairing.hpp"

namespace nvm::survey {

namespace {

std::vector<Face> turned(std::vector<Face> faces) {
  for (Face& face : faces) {
    face.plane.normal *= -1.0;
    face.plane.offset *= -1.0;
  }
  return faces;
}

/// The lowest and the highest of the large level faces; null without any.
struct LevelFaces {
  const Face* lowest = nullptr;
  const Face* highest = nullptr;
};

LevelFaces level_faces(const std::vector<Face>& faces, const Eigen::Vector3d& up) {
  constexpr double kLevel = 0.98;
  constexpr double kMinArea = 2.0;  // [m²]
  LevelFaces found;
  for (const Face& face : faces) {
    if (std::abs(face.plane.normal.dot(up)) > kLevel && face.seen.area() > kMinArea) {
      const double height = face.frame.origin.dot(up);
      if (found.lowest == nullptr || height < found.lowest->frame.origin.dot(up)) {
        found.lowest = &face;
      }
      if (found.highest == nullptr || height > found.highest->frame.origin.dot(up)) {
        found.highest = &face;
      }
    }
  }
  return found;
}

}  // namespace

bool is_inside_out(
    const std::vector<Face>& faces,
    const Eigen::Vector3d& up,
    const SurveyOptions& options,
    bool has_pairs) {
  constexpr double kMinStorey = 1.8;  // [m]; tables and slabs are lower
  const auto [floor, ceiling] = level_faces(faces, up);
  if (floor != nullptr && floor->plane.normal.dot(up) > 0.0) {
    return false;
  }
  if (floor != nullptr && ceiling->plane.normal.dot(up) > 0.0 &&
      (ceiling->frame.origin - floor->frame.origin).dot(up) > kMinStorey) {
    return true;
  }
  return !has_pairs && !pair_faces(turned(faces), options).empty();
}

}  // namespace nvm::survey
