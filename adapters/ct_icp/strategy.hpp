// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <ct_icp/map.h>
#include <ct_icp/neighborhood_strategy.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>

namespace nvm::adapters {

/// A neighbourhood strategy that lets the sensor's location through to the map, which CT-ICP's
/// default one drops.
struct NvmStrategy : ct_icp::ANeighborhoodStrategy {
  struct Options : ct_icp::INeighborStrategyOptions {
    double radius = 0.8;  ///< [m]

    std::string GetType() const override { return "NVM_STRATEGY"; }
    std::shared_ptr<ct_icp::ANeighborhoodStrategy> MakeStrategyFromOptions() const override {
      return std::make_shared<NvmStrategy>(*this);
    }
  } options;

  NvmStrategy() = default;
  explicit NvmStrategy(const Options& options_) : options(options_) {}

  /// True when there are at least min_num_neighbors.
  bool ComputeNeighborhoodInPlace(
      const ct_icp::ISlamMap& map,
      const slam::WPoint3D& query,
      slam::Neighborhood& neighborhood,
      Eigen::Vector3d* sensor_location = nullptr) const override {
    map.RadiusSearchInPlace(
        query.world_point,
        neighborhood,
        options.radius,
        options.max_num_neighbors,
        true,
        sensor_location);
    return neighborhood.points.size() >= static_cast<std::size_t>(options.min_num_neighbors);
  }
};

}  // namespace nvm::adapters
