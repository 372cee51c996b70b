// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <vector>

namespace nvm::sim {

/// An axis-aligned rectangle [m].
struct Rectangle {
  double min_u = 0.0;
  double max_u = 0.0;
  double min_v = 0.0;
  double max_v = 0.0;
};

/// What remains of `whole` without `openings`, as rectangles that touch but do not overlap: one
/// column per stretch of u between the edges of openings, cut along v.
inline std::vector<Rectangle> cut_openings(
    const Rectangle& whole, std::vector<Rectangle> openings) {
  std::sort(openings.begin(), openings.end(), [](const Rectangle& a, const Rectangle& b) {
    return a.min_v < b.min_v;
  });
  std::vector<double> edges{whole.min_u, whole.max_u};
  for (const Rectangle& opening : openings) {
    edges.push_back(std::clamp(opening.min_u, whole.min_u, whole.max_u));
    edges.push_back(std::clamp(opening.max_u, whole.min_u, whole.max_u));
  }
  std::sort(edges.begin(), edges.end());

  std::vector<Rectangle> pieces;
  const auto add = [&](const Rectangle& piece) {
    if (piece.min_u < piece.max_u && piece.min_v < piece.max_v) {
      pieces.push_back(piece);
    }
  };
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double middle = 0.5 * (edges[i] + edges[i + 1]);
    double solid_from = whole.min_v;
    for (const Rectangle& opening : openings) {
      if (opening.min_u < middle && middle < opening.max_u) {
        add({edges[i], edges[i + 1], solid_from, std::min(opening.min_v, whole.max_v)});
        solid_from = std::max(solid_from, opening.max_v);
      }
    }
    add({edges[i], edges[i + 1], solid_from, whole.max_v});
  }
  return pieces;
}

}  // namespace nvm::sim
