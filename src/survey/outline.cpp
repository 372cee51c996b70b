// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nvm::survey {

namespace {

constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// True when the border of `mask` leaves the vertex (x, y), a cell's lower left corner, in
/// direction `d` of kSteps: covered on its left, not covered on its right.
bool is_border(const Mask& mask, int x, int y, std::size_t d) {
  constexpr std::array<std::array<int, 2>, 4> kLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
  const std::array<int, 2>& left = kLeft[d];
  const std::array<int, 2>& right = kLeft[(d + 3) % 4];
  return mask.get(x + left[0], y + left[1]) && !mask.get(x + right[0], y + right[1]);
}

/// The loop that starts at (x, y) to the right; marks the lower borders of cells that it runs over.
Loop follow(const Mask& mask, int x, int y, Mask& traced) {
  Loop loop;
  const int start_x = x;
  const int start_y = y;
  std::size_t d = 0;
  std::size_t last = 4;
  do {
    if (d != last) {
      loop.push_back({mask.u(x), mask.v(y)});
      last = d;
    }
    if (d == 0) {
      traced.set(x, y);
    }
    x += kSteps[d][0];
    y += kSteps[d][1];
    for (const std::size_t turn : {1U, 0U, 3U}) {  // left first: cells that meet in a corner part
      if (is_border(mask, x, y, (d + turn) % 4)) {
        d = (d + turn) % 4;
        break;
      }
    }
  } while (x != start_x || y != start_y || d != 0);
  return loop;
}

double distance_to_line(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double length = std::hypot(b.u - a.u, b.v - a.v);
  if (length < 1e-9) {
    return std::hypot(p.u - a.u, p.v - a.v);
  }
  return std::abs((b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u)) / length;
}

/// Index of the point farthest from `from`.
std::size_t farthest(const Loop& loop, const PlanePoint& from) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    if (std::hypot(loop[i].u - from.u, loop[i].v - from.v) >
        std::hypot(loop[best].u - from.u, loop[best].v - from.v)) {
      best = i;
    }
  }
  return best;
}

/// Marks the points between `begin` and `end` that stay.
void keep_between(
    const Loop& loop,
    std::size_t begin,
    std::size_t end,
    double tolerance,
    std::vector<char>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> spans{{begin, end}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    std::size_t best = first;
    double best_distance = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = distance_to_line(loop[i], loop[first], loop[last % loop.size()]);
      if (distance > best_distance) {
        best = i;
        best_distance = distance;
      }
    }
    if (best != first) {
      keep[best] = 1;
      spans.emplace_back(first, best);
      spans.emplace_back(best, last);
    }
  }
}

}  // namespace

std::vector<Loop> trace(const Mask& mask) {
  std::vector<Loop> loops;
  Mask traced = Mask::like(mask);
  mask.for_each([&](int column, int row) {
    if (!mask.get(column, row - 1) && !traced.get(column, row)) {
      loops.push_back(follow(mask, column, row, traced));
    }
  });
  return loops;
}

Loop simplified(const Loop& loop, double tolerance) {
  if (loop.size() <= 3) {
    return loop;
  }
  Loop turned = loop;
  const std::size_t first = farthest(loop, loop[0]);
  std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
  const std::size_t second = farthest(turned, turned[0]);
  std::vector<char> keep(turned.size(), 0);
  keep[0] = keep[second] = 1;
  keep_between(turned, 0, second, tolerance, keep);
  keep_between(turned, second, turned.size(), tolerance, keep);
  Loop result;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (keep[i] != 0) {
      result.push_back(turned[i]);
    }
  }
  return result.size() >= 3 ? result : loop;
}

double signed_area(const Loop& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PlanePoint& a = loop[i];
    const PlanePoint& b = loop[(i + 1) % loop.size()];
    sum += a.u * b.v - b.u * a.v;
  }
  return 0.5 * sum;
}

}  // namespace nvm::survey
