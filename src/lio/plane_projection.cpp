// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/plane_projection.hpp"

#include <cmath>

namespace nvm::lio {

namespace {

constexpr float kMinIncidenceSine = 0.05F;  // 3 degrees: normals err by 1

}  // namespace

std::vector<Eigen::Vector3f> project_to_planes(
    const NormalResult& estimated, double max_offset, DeskewedScan& scan) {
  std::vector<Eigen::Vector3f> normals = estimated.normals;
  if (max_offset == 0.0) {
    return normals;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float offset = estimated.plane_offsets[i];
    const Eigen::Vector3f beam = scan.viewpoints[i] - scan.points[i];
    if (std::abs(offset) <= static_cast<float>(max_offset) &&
        normals[i].dot(beam) >= kMinIncidenceSine * beam.norm()) {
      scan.points[i] += offset * normals[i];
    } else {
      normals[i].setZero();
    }
  }
  return normals;
}

}  // namespace nvm::lio
