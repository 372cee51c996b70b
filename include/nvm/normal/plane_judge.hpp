// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_NORMAL_PLANE_JUDGE_HPP  // a kernel: nvm/core/target.hpp
#define NVM_NORMAL_PLANE_JUDGE_HPP

#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/geometry/float_lanes.hpp"
#include "nvm/geometry/moments.hpp"
#include "nvm/geometry/symmetric_eigen.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/normal/normal_result.hpp"
#include "nvm/normal/query_block.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// From the moments of neighbourhoods to normals or to the reasons why there are none (spec §2.3
/// and §2.4).
class PlaneJudge {
 public:
  explicit PlaneJudge(const NormalOptions& options)
      : min_neighbors_(static_cast<float>(options.min_neighbors)),
        max_linearity_(static_cast<float>(options.max_linearity)),
        max_surface_variation_(static_cast<float>(options.max_surface_variation)) {}

  /// Writes status and plane, its normal of either sign, of one block of queries.
  template <class = void>
  void operator()(
      const QueryBlock& query, const Moments<FloatLanes>& sums, NormalResult& result) const {
    const Eigen3<FloatLanes> eigen = eigen_decomposition(scatter(sums));
    const FloatLaneBits verdict = judge(sums.count, eigen);
    const FloatLanes zero{};
    const auto is_valid = verdict == static_cast<std::int32_t>(NormalStatus::kValid);
    const FloatLanes x = is_valid ? eigen.smallest_vector.x : zero;
    const FloatLanes y = is_valid ? eigen.smallest_vector.y : zero;
    const FloatLanes z = is_valid ? eigen.smallest_vector.z : zero;
    // The sums are relative to the query.
    const FloatLanes variance = is_valid ? larger(eigen.smallest, zero) / sums.count : zero;
    const FloatLanes offset = is_valid ? (x * sums.x + y * sums.y + z * sums.z) / sums.count : zero;
    for (std::size_t i = query.begin; i < query.end; ++i) {
      const std::size_t lane = i - query.begin;
      const std::uint32_t out = query.queries.index[i];
      result.status[out] = static_cast<NormalStatus>(verdict[lane]);
      result.normals[out] = {x[lane], y[lane], z[lane]};
      result.plane_offsets[out] = offset[lane];
      result.plane_variances[out] = variance[lane];
    }
  }

 private:
  static FloatLaneBits in_all_lanes(NormalStatus status) {
    return FloatLaneBits{} + static_cast<std::int32_t>(status);
  }

  // A NormalStatus per lane. The comparisons are false for NaN, which no plane has.
  template <class = void>
  FloatLaneBits judge(const FloatLanes& count, const Eigen3<FloatLanes>& eigen) const {
    const FloatLanes sum = eigen.smallest + eigen.middle + eigen.largest;
    const auto is_flat = eigen.smallest <= max_surface_variation_ * sum;
    const auto is_wide = (eigen.largest <= max_linearity_ * sum) & (sum > 0.0F);
    const auto is_many = count >= min_neighbors_;
    FloatLaneBits verdict = in_all_lanes(NormalStatus::kValid);
    verdict = is_flat ? verdict : in_all_lanes(NormalStatus::kNotPlanar);
    verdict = is_wide ? verdict : in_all_lanes(NormalStatus::kLineLike);
    return is_many ? verdict : in_all_lanes(NormalStatus::kFewNeighbors);
  }

  float min_neighbors_, max_linearity_, max_surface_variation_;
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_NORMAL_PLANE_JUDGE_HPP
