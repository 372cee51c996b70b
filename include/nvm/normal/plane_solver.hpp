// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_NORMAL_PLANE_SOLVER_HPP  // a kernel: nvm/core/target.hpp
#define NVM_NORMAL_PLANE_SOLVER_HPP

#include <cstddef>

#include "nvm/core/target.hpp"
#include "nvm/normal/block_search.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/normal/normal_result.hpp"
#include "nvm/normal/plane_judge.hpp"
#include "nvm/normal/query_block.hpp"
#include "nvm/normal/tree_items.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Finds the planes of queries, a block at a time; blocks may be solved in any order and thread.
template <class Search>
class PlaneSolver {
 public:
  /// `where`: what the search is made of.
  template <class... Where>
  PlaneSolver(
      const NormalOptions& options,
      const SortedPoints& queries,
      NormalResult& result,
      const Where&... where)
      : search_(where...), judge_(options), queries_(queries), result_(result) {}

  std::size_t block_count() const { return QueryBlock::count(queries_); }

  /// Solves the blocks from `begin` to before `end`.
  void operator()(std::size_t begin, std::size_t end) const {
    for (std::size_t block = begin; block < end; ++block) {
      Moments<FloatLanes> sums;
      const QueryBlock query(queries_, block);
      search_(query, sums);
      judge_(query, sums, result_);
    }
  }

 private:
  Search search_;
  PlaneJudge judge_;
  const SortedPoints& queries_;
  NormalResult& result_;
};

/// The neighbours are points with a tree over them.
using PointSolver = PlaneSolver<BlockSearch<PointItems>>;

NVM_END_DETAIL_KERNELS

#endif  // NVM_NORMAL_PLANE_SOLVER_HPP
