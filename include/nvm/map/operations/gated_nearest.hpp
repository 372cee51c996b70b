// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_GATED_NEAREST_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_GATED_NEAREST_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/answer.hpp"
#include "nvm/map/operations/candidates.hpp"
#include "nvm/map/operations/nearest_query.hpp"
#include "nvm/map/operations/nearest_request.hpp"
#include "nvm/map/operations/query_context.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Answers a request; how many neighbours were written.
template <class Gate>
std::size_t gated_nearest(
    const VoxelStorage& storage,
    const Lattice& lattice,
    const Gate& gate,
    const NearestRequest& request) noexcept {
  const double max_distance = request.search.max_distance;
  VoxelQueryContext& context = request.context;
  LatticePoint point;
  const int wanted = static_cast<int>(std::min(request.search.count, kMaxNeighbors));
  if (wanted == 0 || !is_distance(max_distance) ||
      lattice.locate(request.point, point) != LatticeStatus::kInside) {
    return 0;
  }
  const std::int32_t limit = lattice.sq_steps(max_distance) + 1;
  context.enter(storage, brick_index(point.voxel));
  const NearestQuery<Gate> query(storage, point, gate, context.is_new_place());
  Candidates<> found(wanted);
  for (std::int32_t reach = context.guess(wanted, limit);; reach = limit) {
    query.collect(context.brick(), reach, found);
    if (found.count() >= wanted || reach == limit) {
      break;
    }
  }
  std::array<std::uint8_t, kMaxNeighbors> order;
  const int count = found.nearest(order.data());
  const auto last = static_cast<std::size_t>(std::max(count, 1) - 1);
  context.learn(wanted, count == wanted ? found.sq_distance(order[last]) : limit);
  Answer(storage, lattice, point)
      .write(found, order.data(), static_cast<std::size_t>(count), request.out);
  return static_cast<std::size_t>(count);
}

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_GATED_NEAREST_HPP
