// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "batch_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace nvm::python {

namespace {

/// Answers the queries from `begin` to `end`, with squared distances and ids in the place of rows.
void find_block(
    const VoxelMap& map,
    const Vectors& points,
    const Vectors* normals,
    double max_distance,
    std::size_t begin,
    std::size_t end,
    Answers& answers) {
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
  const NearestSearch search{answers.k, max_distance};
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t count =
        normals != nullptr
            ? map.nearest(points[i], (*normals)[i].cast<float>(), search, found.data(), context)
            : map.nearest(points[i], search, found.data(), context);
    answers.counts[i] = static_cast<std::int64_t>(count);
    for (std::size_t j = 0; j < count; ++j) {
      answers.distances[i * answers.k + j] = static_cast<double>(found[j].sq_distance);
      answers.rows[i * answers.k + j] = found[j].id;
    }
  }
}

/// Makes of what find_block() left what is asked for. Rows of ids are far apart in memory: the
/// processor looks several up at once only where no query stands between them.
void finish_block(
    const std::vector<std::uint32_t>& rows,
    std::size_t map_size,
    std::size_t begin,
    std::size_t end,
    Answers& answers) {
  for (std::size_t i = begin; i < end; ++i) {
    double* const distances = answers.distances.get() + i * answers.k;
    std::int64_t* const places = answers.rows.get() + i * answers.k;
    const auto count = static_cast<std::size_t>(answers.counts[i]);
    for (std::size_t j = 0; j < count; ++j) {
      distances[j] = std::sqrt(distances[j]);
      places[j] = rows[static_cast<std::size_t>(places[j])];
    }
    std::fill(distances + count, distances + answers.k, std::numeric_limits<double>::infinity());
    std::fill(places + count, places + answers.k, static_cast<std::int64_t>(map_size));
  }
}

}  // namespace

Answers answer(
    const SharedMap& self,
    const Vectors& points,
    const Vectors* normals,
    const NearestSearch& search,
    const Executor& executor) {
  constexpr std::size_t kBlock = 512;
  return self.read([&](const VoxelMap& map) {
    Answers answers(points.size(), search.count);
    const auto rows = self.rows(map);
    executor.for_blocks(points.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      find_block(map, points, normals, search.max_distance, begin, end, answers);
      finish_block(*rows, map.size(), begin, end, answers);
    });
    return answers;
  });
}

}  // namespace nvm::python
