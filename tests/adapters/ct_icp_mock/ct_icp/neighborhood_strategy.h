// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// As of include/ct_icp/neighborhood_strategy.h in commit 2536d02.
#include "ct_icp/map.h"

namespace YAML {
class Node;
}

namespace ct_icp {

class ANeighborhoodStrategy {  // the host gives it no virtual destructor
 public:
  virtual bool ComputeNeighborhoodInPlace(
      const ISlamMap& map,
      const slam::WPoint3D& query,
      slam::Neighborhood&,
      Eigen::Vector3d* sensor_location = nullptr) const = 0;
};

struct INeighborStrategyOptions {
  virtual ~INeighborStrategyOptions() = 0;
  virtual std::string GetType() const { return "INVALID_STRATEGY"; }
  virtual std::shared_ptr<ct_icp::ANeighborhoodStrategy> MakeStrategyFromOptions() const {
    throw std::runtime_error("not implemented");
  }
  int max_num_neighbors = 20;
  int min_num_neighbors = 8;
  virtual void FromYAML(const YAML::Node&) {}
};
inline INeighborStrategyOptions::~INeighborStrategyOptions() = default;

}  // namespace ct_icp
