// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>

#include "nvm/core/target.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/query_context.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// What VoxelMap::nearest() is asked, but for the normal, and where the answer goes.
struct NearestRequest {
  const Eigen::Vector3d& point;
  const NearestSearch& search;
  Neighbor* out;
  VoxelQueryContext& context;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
