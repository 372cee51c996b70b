// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/keypoints.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nvm/core/require.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

constexpr float kMinSqNormal = 0.5F;  // a sighting has 0.25

/// A step through [0, size) that visits each index once and neighbours far apart.
std::size_t scattered_step(std::size_t size) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  auto step =
      std::max<std::size_t>(1, static_cast<std::size_t>(kGoldenRatio * static_cast<double>(size)));
  while (std::gcd(step, size) != 1) {
    ++step;
  }
  return step;
}

}  // namespace

KeypointSampler::KeypointSampler(const KeypointOptions& options)
    : options_((options.validate(), options)) {
  constexpr int kHalvings = 3;
  for (int i = 0; i <= kHalvings; ++i) {
    cubes_.emplace_back(std::ldexp(options_.spacing, -i));
  }
}

const std::vector<std::uint32_t>& KeypointSampler::sample(
    const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals) {
  const auto has_plane = [&](std::size_t i) { return normals[i].squaredNorm() > kMinSqNormal; };
  const std::size_t enough = std::min(options_.min_count, options_.max_count);
  auto cubes = cubes_.begin();
  choose(points, has_plane, *cubes);
  while (chosen_.size() < enough && cubes + 1 != cubes_.end()) {
    choose(points, has_plane, *++cubes);
  }
  const std::size_t most = std::min(options_.max_count, chosen_.size() + options_.max_sightings);
  add(
      points, [&](std::size_t i) { return is_sighting(normals[i]); }, most, *cubes);
  std::sort(chosen_.begin(), chosen_.end());
  return chosen_;
}

template <class Predicate>
void KeypointSampler::choose(
    const std::vector<Eigen::Vector3f>& points, const Predicate& takes, VoxelSet& cubes) {
  chosen_.clear();
  cubes.clear();
  add(points, takes, options_.max_count, cubes);
}

template <class Predicate>
void KeypointSampler::add(
    const std::vector<Eigen::Vector3f>& points,
    const Predicate& takes,
    std::size_t max_count,
    VoxelSet& cubes) {
  const std::size_t size = points.size();
  const std::size_t step = scattered_step(size);
  std::size_t index = 0;
  for (std::size_t i = 0; i < size && chosen_.size() < max_count; ++i) {
    if (takes(index) &&
        cubes.insert(points[index].cast<double>()) == VoxelSet::Insertion::kNewCell) {
      chosen_.push_back(static_cast<std::uint32_t>(index));
    }
    index = (index + step) % size;
  }
}

void KeypointOptions::validate() const {
  require(spacing > 0.0 && std::isfinite(spacing), "keypoint spacing", spacing, "positive [m]");
  require(max_count >= 10 && max_count <= 100'000, "max_keypoints", max_count, "10 to 100000");
}

double mean_range(const std::vector<Eigen::Vector3f>& points) {
  double sum = 0.0;
  for (const Eigen::Vector3f& point : points) {
    sum += static_cast<double>(point.norm());
  }
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

}  // namespace nvm::lio
