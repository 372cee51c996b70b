// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::benchmarks {

/// The map that most LiDAR odometries use, as KISS-ICP lays it out: a robin-hood hash table of
/// voxels, each a vector of at most 20 points that keep a distance from each other; no normals, no
/// sides. The baseline of the comparison.
class HashOfVectorsMap {
 public:
  struct Found {
    Eigen::Vector3d position;
    double sq_distance;
  };

  HashOfVectorsMap(double voxel_size, double min_distance, std::size_t max_points)
      : voxel_size_(voxel_size),
        sq_min_distance_(min_distance * min_distance),
        max_points_(max_points) {}

  template <class Points>
  std::size_t insert(const Points& points, const Pose& T) {
    const std::size_t before = size_;
    for (std::size_t i = 0; i < points.size(); ++i) {
      insert(T * points[i].template cast<double>());
    }
    return size_ - before;
  }

  /// The `wanted` nearest points in the 27 voxels around, ascending.
  std::size_t nearest(
      const Eigen::Vector3d& query, std::size_t wanted, double max_distance, Found* found) const {
    const Eigen::Vector3i center = voxel_of(query);
    std::size_t count = 0;
    double limit = max_distance * max_distance;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const auto voxel = voxels_.find(center + Eigen::Vector3i(dx, dy, dz));
          if (voxel == voxels_.end()) {
            continue;
          }
          for (const Eigen::Vector3d& point : voxel->second) {
            const double sq_distance = (point - query).squaredNorm();
            if (sq_distance <= limit) {
              count = keep(point, sq_distance, found, count, wanted);
              limit = count == wanted ? found[count - 1].sq_distance : limit;
            }
          }
        }
      }
    }
    return count;
  }

  /// Drops voxels whose first point is farther than `radius` from `origin`, by a sweep over all of
  /// them.
  void erase_beyond(const Eigen::Vector3d& origin, double radius) {
    for (auto voxel = voxels_.begin(); voxel != voxels_.end();) {
      if ((voxel->second.front() - origin).squaredNorm() > radius * radius) {
        size_ -= voxel->second.size();
        voxel = voxels_.erase(voxel);
      } else {
        ++voxel;
      }
    }
  }

  std::size_t size() const { return size_; }

 private:
  struct VoxelHash {
    std::size_t operator()(const Eigen::Vector3i& v) const {
      const auto x = static_cast<std::uint32_t>(v.x());
      const auto y = static_cast<std::uint32_t>(v.y());
      const auto z = static_cast<std::uint32_t>(v.z());
      return x * 73856093U ^ y * 19349669U ^ z * 83492791U;
    }
  };

  void insert(const Eigen::Vector3d& point) {
    const Eigen::Vector3i index = voxel_of(point);
    const auto voxel = voxels_.find(index);
    if (voxel == voxels_.end()) {
      std::vector<Eigen::Vector3d> points;
      points.reserve(max_points_);
      points.push_back(point);
      voxels_.insert({index, std::move(points)});
      ++size_;
      return;
    }
    std::vector<Eigen::Vector3d>& points = voxel.value();
    const bool rejected = points.size() == max_points_ ||
                          std::any_of(points.begin(), points.end(), [&](const auto& other) {
                            return (other - point).squaredNorm() < sq_min_distance_;
                          });
    if (!rejected) {
      points.push_back(point);
      ++size_;
    }
  }

  Eigen::Vector3i voxel_of(const Eigen::Vector3d& point) const {
    return (point / voxel_size_).array().floor().cast<int>();
  }

  // Insertion into the sorted answers: the fastest way for small `wanted`.
  static std::size_t keep(
      const Eigen::Vector3d& point,
      double sq_distance,
      Found* found,
      std::size_t count,
      std::size_t wanted) {
    std::size_t place = count < wanted ? count : wanted - 1;
    for (; place > 0 && found[place - 1].sq_distance > sq_distance; --place) {
      found[place] = found[place - 1];
    }
    found[place] = {point, sq_distance};
    return std::min(count + 1, wanted);
  }

  double voxel_size_;
  double sq_min_distance_;
  std::size_t max_points_;
  std::size_t size_ = 0;
  tsl::robin_map<Eigen::Vector3i, std::vector<Eigen::Vector3d>, VoxelHash> voxels_;
};

}  // namespace nvm::benchmarks
