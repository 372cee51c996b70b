// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/tick_window.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/median.hpp"

namespace nvm::io {

double spread(std::vector<double> values) {
  const double center = median(values);
  for (double& value : values) {
    value = std::abs(value - center);
  }
  return median(std::move(values));
}

TickWindow main_part(const std::vector<double>& ticks) {
  const std::size_t size = ticks.size();
  const std::size_t share = size - size / 5;
  std::size_t best = 0;
  for (std::size_t i = 0; i + share <= size; ++i) {
    const auto length = [&](std::size_t at) { return ticks[at + share - 1] - ticks[at]; };
    best = length(i) < length(best) ? i : best;
  }
  constexpr double kMargin = 0.3;
  const double first = ticks[best];
  const double last = ticks[best + share - 1];
  const double margin = kMargin * (last - first);
  const auto begin = std::lower_bound(ticks.begin(), ticks.end(), first - margin);
  const auto end = std::upper_bound(ticks.begin(), ticks.end(), last + margin);
  return {*begin, *(end - 1), static_cast<std::size_t>(end - begin)};
}

void unwrap(std::vector<double>& ticks, double modulus) {
  if (modulus <= 0.0 || ticks.empty()) {
    return;
  }
  const auto [min, max] = std::minmax_element(ticks.begin(), ticks.end());
  const double half = 0.5 * modulus;
  if (*max - *min <= half && *min <= half) {
    return;
  }
  for (double& tick : ticks) {
    tick -= tick > half ? modulus : 0.0;
  }
  std::sort(ticks.begin(), ticks.end());
}

TickWindow densest_window(const std::vector<double>& ticks, double length) {
  TickWindow best;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    while (ticks[i] - ticks[begin] > length) {
      ++begin;
    }
    if (i + 1 - begin > best.count) {
      best = {ticks[begin], ticks[i], i + 1 - begin};
    }
  }
  return best;
}

}  // namespace nvm::io
