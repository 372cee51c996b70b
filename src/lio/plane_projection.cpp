// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/plane_projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nvm::lio {

namespace {

constexpr float kMinIncidenceSine = 0.05F;  // 3 degrees: normals err by 1
constexpr float kMaxVarianceRatio = 2.25F;  // 1.5 times the usual standard deviation
constexpr float kNoVariance = 2.5e-5F;      // 5 mm: no edge pulls by more than a part of that

/// Of the planes of most points: 2.25 times their median variance [m^2].
float max_variance(const NormalResult& estimated) {
  std::vector<float> variances;
  variances.reserve(estimated.normals.size());
  for (std::size_t i = 0; i < estimated.normals.size(); ++i) {
    if (estimated.status[i] == NormalStatus::kValid) {
      variances.push_back(estimated.plane_variances[i]);
    }
  }
  if (variances.empty()) {
    return 0.0F;
  }
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::max(kMaxVarianceRatio * *middle, kNoVariance);
}

}  // namespace

std::vector<Eigen::Vector3f> project_to_planes(
    const NormalResult& estimated, double max_offset, DeskewedScan& scan) {
  std::vector<Eigen::Vector3f> normals = estimated.normals;
  if (max_offset == 0.0) {
    return normals;
  }
  const float max_plane_variance = max_variance(estimated);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float offset = estimated.plane_offsets[i];
    const Eigen::Vector3f beam = scan.viewpoints[i] - scan.points[i];
    if (estimated.plane_variances[i] <= max_plane_variance &&
        std::abs(offset) <= static_cast<float>(max_offset) &&
        normals[i].dot(beam) >= kMinIncidenceSine * beam.norm()) {
      scan.points[i] += offset * normals[i];
    } else {
      normals[i].setZero();
    }
  }
  return normals;
}

}  // namespace nvm::lio
