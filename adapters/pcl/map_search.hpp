// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/search/search.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "adapters/common/point_fields.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::adapters {

/// An nvm map as a pcl::search::Search, for PCL's algorithms. getInputCloud() is a copy of the
/// map's points, with their normals when PointT has room for them, and indices point into it.
///
/// Refers to the map. After the map has changed, update() must be called. Answers are exact at any
/// distance; up to 64 neighbours within the 27 voxels around a query are found fastest. Const
/// members may run from many threads at once.
template <class PointT>
class MapSearch : public ::pcl::search::Search<PointT> {
  using Base = ::pcl::search::Search<PointT>;

 public:
  using typename Base::IndicesConstPtr;
  using typename Base::PointCloud;
  using typename Base::PointCloudConstPtr;
  using Ptr = ::pcl::shared_ptr<MapSearch>;

  explicit MapSearch(const VoxelMap& map) : Base("nvm::MapSearch", true), map_(map) { update(); }

  /// Copies the map's points. Takes time proportional to the map.
  void update() {
    const auto cloud = ::pcl::make_shared<PointCloud>();
    cloud->reserve(map_.size());
    index_of_.clear();
    map_.for_each_within(Eigen::Vector3d::Zero(), kEverywhere, [&](const Neighbor& point) {
      index_of_.resize(std::max<std::size_t>(index_of_.size(), point.id + std::size_t{1}));
      index_of_[point.id] = static_cast<::pcl::index_t>(cloud->size());
      cloud->push_back(make_point<PointT>(point.position, map_.normal(point.id)));
    });
    this->input_ = cloud;
  }

  /// Only getInputCloud() itself is taken; for anything else throws std::invalid_argument.
  void setInputCloud(const PointCloudConstPtr& cloud, const IndicesConstPtr& = {}) override {
    if (cloud != this->input_) {
      throw std::invalid_argument("nvm: MapSearch searches its map; use getInputCloud()");
    }
  }

  using Base::nearestKSearch;
  int nearestKSearch(
      const PointT& point,
      int k,
      ::pcl::Indices& indices,
      std::vector<float>& sq_distances) const override {
    const auto wanted = static_cast<std::size_t>(std::max(k, 0));
    if (wanted > kMaxNeighbors) {
      return copy(collect(position(point), kEverywhere, wanted), indices, sq_distances);
    }
    std::array<Neighbor, kMaxNeighbors> found;
    VoxelMap::QueryContext context;
    const std::size_t count = map_.nearest(
        position(point), {wanted, kEverywhere, Gate::kSurfaces, kAllRings}, found.data(), context);
    return copy({found.begin(), found.begin() + count}, indices, sq_distances);
  }

  using Base::radiusSearch;
  int radiusSearch(
      const PointT& point,
      double radius,
      ::pcl::Indices& indices,
      std::vector<float>& sq_distances,
      unsigned int max_nn = 0) const override {
    const std::size_t wanted = max_nn == 0 ? map_.size() : max_nn;
    return copy(collect(position(point), radius, wanted), indices, sq_distances);
  }

 private:
  static constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  static constexpr int kAllRings = std::numeric_limits<int>::max();

  /// The `wanted` nearest points within `radius` [m], ascending.
  std::vector<Neighbor> collect(
      const Eigen::Vector3d& point, double radius, std::size_t wanted) const {
    std::vector<Neighbor> found;
    map_.for_each_within(point, radius, [&](const Neighbor& n) { found.push_back(n); });
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, found.size()));
    std::partial_sort(found.begin(), end, found.end(), [](const Neighbor& a, const Neighbor& b) {
      return a.sq_distance != b.sq_distance ? a.sq_distance < b.sq_distance : a.id < b.id;
    });
    found.erase(end, found.end());
    return found;
  }

  int copy(
      const std::vector<Neighbor>& found,
      ::pcl::Indices& indices,
      std::vector<float>& sq_distances) const {
    indices.resize(found.size());
    sq_distances.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      indices[i] = index_of_[found[i].id];
      sq_distances[i] = found[i].sq_distance;
    }
    return static_cast<int>(found.size());
  }

  const VoxelMap& map_;
  std::vector<::pcl::index_t> index_of_;  // by PointId
};

}  // namespace nvm::adapters
