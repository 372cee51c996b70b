// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <ct_icp/map.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/common/host_map.hpp"
#include "adapters/ct_icp/cloud.hpp"
#include "nvm/normal/normal_estimator.hpp"

/// CT-ICP takes these through OdometryOptions::map_options.
/// docs/adapters/ct_icp.md
namespace nvm::adapters {

/// How an NvmSlamMap stores and answers.
struct NvmSlamMapOptions : ct_icp::IMapOptions {
  /// Normals are the map's own: insert kPoint estimates them from each inserted cloud. Queries know
  /// the sensor at best, so kViewDirection is what they have.
  HostOptions host = defaults();
  NormalOptions normals;
  /// Radius of searches for which the host gives none [m].
  double default_radius = 0.8;
  /// Neighbours in descending order, as the host's own maps give them, though its solver takes the
  /// first for the nearest.
  bool farthest_first = false;

  static std::string Type() { return "NVM"; }
  std::string GetType() const override { return Type(); }
  std::shared_ptr<ct_icp::ISlamMap> MakeMapFromOptions() const override;

 private:
  static HostOptions defaults() {
    HostOptions options;
    options.normals = {
        NormalSource::kPoint, NormalSource::kViewDirection, MissingNormal::kViewDirection};
    options.reach = 2.0;
    return options;
  }
};

/// An nvm map for CT-ICP. Searches may run from many threads at once, every other member needs the
/// map for itself.
class NvmSlamMap final : public ct_icp::ISlamMap {
 public:
  /// Throws std::invalid_argument when the options are out of range.
  explicit NvmSlamMap(const NvmSlamMapOptions& options)
      : options_(options), estimator_(options.normals) {
    map_.configure(options.host);
  }

  const HostMap& map() const noexcept { return map_; }
  /// One line when the voxels are too small for points `spacing` [m] apart; else empty.
  std::string density_warning(double spacing) const {
    return adapters::density_warning(options_.host.map.voxel_size, spacing, 20);
  }

  void ClearMap() override { map_.clear(); }

  /// Seen from the middle of the first and the last pose. Selects all points: what the map keeps
  /// of them is its own affair.
  void InsertPointCloud(
      const slam::PointCloud& cloud,
      const std::vector<slam::Pose>& frame_poses,
      std::vector<std::size_t>& out_indices) override {
    if (frame_poses.empty()) {
      throw std::invalid_argument("nvm: frame_poses must hold a pose");
    }
    const Eigen::Vector3d origin =
        0.5 * (frame_poses.front().TrConstRef() + frame_poses.back().TrConstRef());
    insert(world_points(cloud, frame_poses), origin);
    out_indices.resize(cloud.size());
    for (std::size_t i = 0; i < out_indices.size(); ++i) {
      out_indices[i] = i;
    }
  }
  /// Points of the map frame, seen from its origin.
  void InsertPointCloud(
      const slam::PointCloud& cloud, std::vector<std::size_t>& out_indices) override {
    InsertPointCloud(cloud, {slam::Pose()}, out_indices);
  }

  void RemoveElementsFarFromLocation(const Eigen::Vector3d& location, double distance) override {
    if (map_.map() != nullptr) {
      map_.map()->erase_voxels_beyond(location, distance);
    }
  }

  std::size_t NumPoints() const override { return map_.size(); }

  slam::PointCloudPtr MapAsPointCloud() const override { return to_cloud(map_); }

  /// The up to max_num_neighbors (-1 or more than 64: 64) nearest points within `radius` [m]; with
  /// a sensor location only those on the sides that are seen from there.
  void RadiusSearchInPlace(
      const Eigen::Vector3d& query,
      slam::Neighborhood& neighborhood,
      double radius,
      int max_num_neighbors = -1,
      bool /* nearest_neighbors */ = true,
      Eigen::Vector3d* sensor_location = nullptr) const override {
    std::array<Neighbor, kMaxNeighbors> found;
    const auto wanted =
        max_num_neighbors < 0 ? kMaxNeighbors : static_cast<std::size_t>(max_num_neighbors);
    const bool gated =
        sensor_location != nullptr && options_.host.normals.query == NormalSource::kViewDirection;
    const Eigen::Vector3f normal =
        gated ? view_direction(query, *sensor_location) : Eigen::Vector3f(Eigen::Vector3f::Zero());
    const std::size_t count = map_.nearest(
        query, normal, {std::min(wanted, kMaxNeighbors), radius, Gate::kSurfaces}, found.data());
    neighborhood.points.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      neighborhood.points[options_.farthest_first ? count - 1 - i : i] = found[i].position;
    }
  }
  slam::Neighborhood RadiusSearch(
      const Eigen::Vector3d& query,
      double radius,
      int max_num_neighbors = -1,
      bool nearest_neighbors = true,
      Eigen::Vector3d* sensor_location = nullptr) const override {
    slam::Neighborhood neighborhood;
    RadiusSearchInPlace(
        query, neighborhood, radius, max_num_neighbors, nearest_neighbors, sensor_location);
    return neighborhood;
  }
  void ComputeNeighborhoodInPlace(
      const Eigen::Vector3d& query,
      int max_num_neighbors,
      slam::Neighborhood& neighborhood) const override {
    RadiusSearchInPlace(query, neighborhood, options_.default_radius, max_num_neighbors);
  }
  std::vector<slam::Neighborhood> ComputeNeighborhoods(
      const std::vector<Eigen::Vector3d>& queries, int max_num_neighbors) const override {
    return ComputeNeighborhoods(
        queries,
        std::vector<double>(queries.size(), options_.default_radius),
        max_num_neighbors,
        true,
        nullptr);
  }
  /// Throws std::invalid_argument when the numbers of queries and radiuses differ.
  std::vector<slam::Neighborhood> ComputeNeighborhoods(
      const std::vector<Eigen::Vector3d>& queries,
      const std::vector<double> radiuses,
      int max_num_neighbors,
      bool nearest_neighbors,
      Eigen::Vector3d* sensor_location) const override {
    require(radiuses.size() == queries.size(), "radiuses.size()", radiuses.size(), "as queries");
    std::vector<slam::Neighborhood> result(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      RadiusSearchInPlace(
          queries[i],
          result[i],
          radiuses[i],
          max_num_neighbors,
          nearest_neighbors,
          sensor_location);
    }
    return result;
  }

 private:
  void insert(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& origin) {
    map_.set_view_point(origin);
    if (options_.host.normals.insert != NormalSource::kPoint) {
      map_.insert(points);
      return;
    }
    std::vector<Eigen::Vector3f> normals = estimator_.estimate(points, origin).normals;
    if (options_.host.normals.missing == MissingNormal::kViewDirection) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        normals[i] = normals[i].isZero() ? view_direction(points[i], origin) : normals[i];
      }
    }
    map_.insert(points, normals);
  }

  NvmSlamMapOptions options_;
  NormalEstimator estimator_;
  HostMap map_;
};

inline std::shared_ptr<ct_icp::ISlamMap> NvmSlamMapOptions::MakeMapFromOptions() const {
  return std::make_shared<NvmSlamMap>(*this);
}

}  // namespace nvm::adapters
