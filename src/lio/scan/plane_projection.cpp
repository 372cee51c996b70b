// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/plane_projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

// Below this a beam all but grazes a plane: a line of points and the noise along the beams may be
// all there is of it, and its side is not to be trusted. 6 degrees.
constexpr float kMinIncidenceSine = 0.1F;
// The scatter that range noise leaves is this share of it at least, however slanting the beam.
constexpr float kMinNoiseShare = 0.15F;
constexpr float kMaxVarianceRatio = 1.35F;  // of a plane's scatter to what the noise explains
constexpr float kMinNoise = 0.003F;         // [m]: planes are never judged finer than that

/// Sine of the angle between the beam to point `i` and its plane, 0 to 1.
float incidence_sine(const NormalResult& estimated, const DeskewedScan& scan, std::size_t i) {
  const Eigen::Vector3f beam = scan.viewpoints[i] - scan.points[i];
  return estimated.normals[i].dot(beam) / beam.norm();
}

/// Scatter of a plane's points [m^2] for noise of one metre along beams of this incidence.
float noise_scatter(float incidence_sine) {
  const float share = std::max(incidence_sine, kMinNoiseShare);
  return share * share;
}

/// Of the ranges of a scan [m^2]: the median that the scatter of its planes tells.
float noise_variance(const NormalResult& estimated, const DeskewedScan& scan) {
  std::vector<float> variances;
  variances.reserve(estimated.normals.size());
  for (std::size_t i = 0; i < estimated.normals.size(); ++i) {
    if (estimated.status[i] == NormalStatus::kValid) {
      const float scatter = noise_scatter(incidence_sine(estimated, scan, i));
      variances.push_back(estimated.plane_variances[i] / scatter);
    }
  }
  if (variances.empty()) {
    return 0.0F;
  }
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::max(*middle, kMinNoise * kMinNoise);
}

}  // namespace

std::vector<Eigen::Vector3f> project_to_planes(
    const NormalResult& estimated, double max_offset, DeskewedScan& scan) {
  std::vector<Eigen::Vector3f> normals = estimated.normals;
  if (max_offset == 0.0) {
    return normals;
  }
  const float max_variance = kMaxVarianceRatio * noise_variance(estimated, scan);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float offset = estimated.plane_offsets[i];
    const float sine = incidence_sine(estimated, scan, i);
    if (sine >= kMinIncidenceSine &&
        estimated.plane_variances[i] <= max_variance * noise_scatter(sine) &&
        std::abs(offset) <= static_cast<float>(max_offset)) {
      scan.points[i] += offset * normals[i];
    } else if (estimated.status[i] != NormalStatus::kNotPlanar) {
      normals[i] = sighting(scan.points[i], scan.viewpoints[i].cast<double>());
    }
  }
  return normals;
}

}  // namespace nvm::lio
