// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace nvm::survey {

namespace {

constexpr double kMaxCosine = -0.985;  // 10 degrees from opposite

/// How far behind `behind` the point `p` of a face that looks the other way lies [m].
double depth(const Face& behind, const Eigen::Vector3d& p) { return -behind.plane.distance(p); }

bool may_pair(const Face& a, const Face& b, double max_thickness) {
  if (a.plane.normal.dot(b.plane.normal) > kMaxCosine) {
    return false;
  }
  const PlaneBox box = box_in(a.frame, b.frame, b.box);
  if (a.box.gap(box) > 0.0) {
    return false;
  }
  // Along faces of 50 m that are 10 degrees off, the depth changes by meters: a loose test.
  const double slack = 0.2 * std::max({box.width(), box.height(), a.box.width(), a.box.height()});
  return depth(a, b.frame.origin) > -slack && depth(a, b.frame.origin) < max_thickness + slack;
}

/// The pair of `first` and `second` where both are seen, and neither is `used`.
std::optional<FacePair> pair_of(
    const std::vector<Face>& faces,
    const std::vector<Mask>& used,
    std::pair<std::size_t, std::size_t> indices,
    const SurveyOptions& options) {
  const Face& a = faces[indices.first];
  const Face& b = faces[indices.second];
  FacePair pair{indices.first, indices.second, 0.0, Mask::like(a.seen)};
  double sum = 0.0;
  a.seen.for_each([&](int column, int row) {
    const Eigen::Vector3d p = a.frame.point(a.seen.u(column + 0.5), a.seen.v(row + 0.5));
    const double u = b.frame.coordinate_u(p);
    const double v = b.frame.coordinate_v(p);
    const double distance = depth(b, p);
    if (distance >= options.min_thickness && distance <= options.max_thickness &&
        b.seen.covers(u, v) && !used[indices.first].get(column, row) &&
        !used[indices.second].covers(u, v)) {
      pair.overlap.set(column, row);
      sum += distance;
    }
  });
  if (pair.overlap.area() < options.min_area) {
    return std::nullopt;
  }
  pair.distance = sum / static_cast<double>(pair.overlap.count());
  return pair;
}

/// Marks what `pair` covers, and a cell around it, as used on both faces.
void mark(const std::vector<Face>& faces, const FacePair& pair, std::vector<Mask>& used) {
  const Face& a = faces[pair.first];
  const Face& b = faces[pair.second];
  const Mask covered = dilated(pair.overlap, 1);
  covered.for_each([&](int column, int row) { used[pair.first].set(column, row); });
  b.seen.for_each([&](int column, int row) {
    const Eigen::Vector3d p = b.frame.point(b.seen.u(column + 0.5), b.seen.v(row + 0.5));
    if (covered.covers(a.frame.coordinate_u(p), a.frame.coordinate_v(p))) {
      used[pair.second].set(column, row);
    }
  });
}

}  // namespace

std::vector<FacePair> pair_faces(const std::vector<Face>& faces, const SurveyOptions& options) {
  std::vector<Mask> used;
  for (const Face& face : faces) {
    used.push_back(Mask::like(face.seen));
  }
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> candidates;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (may_pair(faces[i], faces[j], options.max_thickness)) {
        if (const auto pair = pair_of(faces, used, {i, j}, options)) {
          candidates.push_back({pair->distance, {i, j}});
        }
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end());
  std::vector<FacePair> pairs;
  for (const auto& [distance, indices] : candidates) {
    if (auto pair = pair_of(faces, used, indices, options)) {
      mark(faces, *pair, used);
      pairs.push_back(std::move(*pair));
    }
  }
  return pairs;
}

}  // namespace nvm::survey
