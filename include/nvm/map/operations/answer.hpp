// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_ANSWER_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_ANSWER_HPP

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/candidates.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Turns what a query has found into neighbours in the map frame.
class Answer {
 public:
  Answer(const VoxelStorage& storage, const Lattice& lattice, const LatticePoint& query)
      : storage_(storage),
        chunks_(storage.chunks()),
        lattice_(lattice),
        query_(wrap(query)),
        origin_(Lattice::steps(query)) {}

  /// Writes the first `count` candidates in the given order, and marks their voxels as used.
  [[gnu::always_inline]] void write(
      const Candidates<>& found,
      const std::uint8_t* order,
      std::size_t count,
      Neighbor* out) const {
    for (std::size_t i = 0; i < count; ++i) {
      const PointId id = found.id(order[i]);
      const PointChunk& chunk = chunks_[id / kLanes];
      storage_.recency().use(chunk.voxel);
      const WrappedPoint point = chunk.wrapped(id % kLanes);
      out[i].position = {
          position(origin_.x(), point.x, query_.x),
          position(origin_.y(), point.y, query_.y),
          position(origin_.z(), point.z, query_.z)};
      out[i].sq_distance = lattice_.sq_meters(found.sq_distance(order[i]));
      out[i].id = id;
    }
  }

 private:
  /// A coordinate [m], from that of the query [steps] and the wrapped ones.
  double position(double origin, std::int16_t wrapped, std::int16_t wrapped_query) const {
    return (origin + wrapped_difference(wrapped, wrapped_query)) * lattice_.meters_per_step();
  }

  const VoxelStorage& storage_;
  const PointChunk* chunks_;
  const Lattice& lattice_;
  WrappedPoint query_;
  Eigen::Vector3d origin_;  // the query [steps]
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_ANSWER_HPP
