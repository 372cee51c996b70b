// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "ct_icp/map.h"

namespace ct_icp {

class ANeighborhoodStrategy {
 public:
  virtual ~ANeighborhoodStrategy() = default;
  virtual bool ComputeNeighborhoodInPlace(
      const ISlamMap& map,
      const slam::WPoint3D& query,
      slam::Neighborhood&,
      Eigen::Vector3d* sensor_location = nullptr) const = 0;
};

struct INeighborStrategyOptions {
  virtual ~INeighborStrategyOptions() = default;
  virtual std::string GetType() const { return "INVALID_STRATEGY"; }
  virtual std::shared_ptr<ct_icp::ANeighborhoodStrategy> MakeStrategyFromOptions() const {
    throw std::runtime_error("not implemented");
  }
  int max_num_neighbors = 20;
  int min_num_neighbors = 8;
};

}  // namespace ct_icp
