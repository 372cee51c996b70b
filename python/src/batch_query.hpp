// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "arrays.hpp"
#include "common/executor.hpp"
#include "nvm/map/neighbor.hpp"
#include "shared_map.hpp"

namespace nvm::python {

/// The answers of a batch of queries, `k` places for each; empty places lie at infinity.
struct Answers {
  Answers(std::size_t size, std::size_t places_each)
      : k(places_each),
        distances(new double[size * k]),
        rows(new std::int64_t[size * k]),
        counts(new std::int64_t[size]) {}

  std::size_t k;
  // Not vectors: no place is written before its answer is known, while its cache line is at hand.
  std::unique_ptr<double[]> distances;
  std::unique_ptr<std::int64_t[]> rows;
  std::unique_ptr<std::int64_t[]> counts;
};

/// Answers as many queries as there are points, of one face where there are normals.
Answers answer(
    const SharedMap& self,
    const Vectors& points,
    const Vectors* normals,
    const NearestSearch& search,
    const Executor& executor);

}  // namespace nvm::python
