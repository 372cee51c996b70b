// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What a query costs in the map of a walk (see corridor.hpp), one thread, for nvm's map and those
// that odometries use. Each reports the mean distance of its answers as a checksum: equal where
// maps hold the same points.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "support/contestants.hpp"
#include "support/walk.hpp"

namespace nvm::benchmarks {
namespace {

const std::vector<Query>& queries(benchmark::State& state) {
  return state.range(1) == 0 ? scan_queries() : random_queries();
}

/// nearest/<map>/<wanted>/<0: in scan order, 1: in random order>
template <class Map>
void nearest(benchmark::State& state) {
  Map& map = walked<Map>();
  const auto wanted = static_cast<std::size_t>(state.range(0));
  const std::vector<Query>& all = queries(state);
  double sum = 0.0;
  std::size_t found = 0;
  std::size_t asked = 0;
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(all.size()))) {
    for (const Query& query : all) {
      const std::size_t count = map.nearest(query, wanted);
      found += count;
      sum += count > 0 ? map.sq_distance(count - 1) : 0.0;
    }
    asked += all.size();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(asked);
  state.counters["checksum"] = sum / static_cast<double>(asked);
}

/// latency<map>/<wanted>: each query timed by itself, in scan order [ns of wall time, with the
/// clock's own 20 to 30].
template <class Map>
void latency(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  Map& map = walked<Map>();
  const auto wanted = static_cast<std::size_t>(state.range(0));
  std::vector<double> times_ns;
  for (auto _ : state) {
    for (const Query& query : scan_queries()) {
      const Clock::time_point begin = Clock::now();
      benchmark::DoNotOptimize(map.nearest(query, wanted));
      times_ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
    }
  }
  std::sort(times_ns.begin(), times_ns.end());
  const auto quantile = [&](double share) {
    return times_ns[static_cast<std::size_t>(share * static_cast<double>(times_ns.size() - 1))];
  };
  state.counters["p50_ns"] = quantile(0.5);
  state.counters["p99_ns"] = quantile(0.99);
  state.counters["p999_ns"] = quantile(0.999);
  state.counters["max_ns"] = quantile(1.0);
}

#define NVM_QUERY_BENCHMARK(Map)           \
  BENCHMARK_TEMPLATE(nearest, Map)         \
      ->Unit(benchmark::kNanosecond)       \
      ->ArgsProduct({{1, 5, 20}, {0, 1}}); \
  BENCHMARK_TEMPLATE(latency, Map)->Arg(5)->Iterations(1)

NVM_QUERY_BENCHMARK(Nvm);
NVM_QUERY_BENCHMARK(NvmUngated);
NVM_QUERY_BENCHMARK(KissStyle);
NVM_QUERY_BENCHMARK(Nanoflann);
#ifdef NVM_BENCHMARK_SMALL_GICP
NVM_QUERY_BENCHMARK(SmallGicp);
#endif
#ifdef NVM_BENCHMARK_KISS_ICP
BENCHMARK_TEMPLATE(nearest, KissIcp)->Unit(benchmark::kNanosecond)->ArgsProduct({{1}, {0, 1}});
#endif
#ifdef NVM_BENCHMARK_PCL
NVM_QUERY_BENCHMARK(PclKdTree);
#endif

}  // namespace
}  // namespace nvm::benchmarks
