// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/patch_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/median.hpp"
#include "survey/survey_options.hpp"

namespace nvm::survey {

namespace {

constexpr int kBits = 21;           // of a key, per axis
constexpr double kGridReach = 5e4;  // [m]; with the smallest cells, 2^20 of them

std::uint64_t key_of(const Eigen::Vector3d& p, double size) {
  std::uint64_t key = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const auto index = static_cast<std::int64_t>(std::floor(p[axis] / size)) + (1 << (kBits - 1));
    key = (key << kBits) | static_cast<std::uint64_t>(index);
  }
  return key;
}

/// The median of each coordinate of the finite positions.
Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<double> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    const std::size_t step = 1 + positions.size() / 10000;
    for (std::size_t i = 0; i < positions.size(); i += step) {
      if (positions[i].allFinite()) {
        values.push_back(positions[i][axis]);
      }
    }
    if (!values.empty()) {
      middle[axis] = std::round(median(std::move(values)));
    }
  }
  return middle;
}

using KeyedPoint = std::pair<std::uint64_t, std::uint32_t>;  // of its cell, and its index

std::vector<KeyedPoint> sorted_by_cell(const std::vector<Eigen::Vector3d>& positions, double size) {
  std::vector<KeyedPoint> keyed(positions.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    keyed[i] = {key_of(positions[i], size), static_cast<std::uint32_t>(i)};
  }
  if (!std::is_sorted(keyed.begin(), keyed.end())) {
    std::sort(keyed.begin(), keyed.end());
  }
  return keyed;
}

/// Neighbours come to lie side by side: whoever goes over the points of a face finds them in the
/// cache.
void bring_together(SurveyCloud& cloud) {
  const std::vector<KeyedPoint> order = sorted_by_cell(cloud.positions, SurveyOptions{}.patch_size);
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  positions.reserve(order.size());
  normals.reserve(order.size());
  for (const auto& [key, index] : order) {
    positions.push_back(cloud.positions[index]);
    normals.push_back(cloud.normals[index]);
  }
  cloud.positions = std::move(positions);
  cloud.normals = std::move(normals);
}

/// How finely coordinates were written: in single precision, when all of them are such numbers.
class Rounding {
 public:
  void add(const Eigen::Vector3d& p) {
    for (const double coordinate : p) {
      const auto number = static_cast<float>(coordinate);
      is_single_ = is_single_ && static_cast<double>(number) == coordinate;
      largest_ = std::max(largest_, std::abs(number));
    }
  }

  /// Between neighbours of the largest [m]; 0 in double precision.
  double step() const { return is_single_ ? std::nextafter(largest_, HUGE_VALF) - largest_ : 0.0; }

 private:
  bool is_single_ = true;
  float largest_ = 0.0F;
};

/// A surface within a cell while its points are being gathered.
struct Cluster {
  PlaneSums sums;
  Eigen::Vector3d normal_sum = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> points;

  bool takes(const Eigen::Vector3d& p, const Eigen::Vector3d& n) const {
    constexpr double kMinCosine = 0.82;  // 35 degrees
    constexpr double kMaxOffset = 0.05;  // [m]
    const double length = normal_sum.norm();
    const double offset = normal_sum.dot(p - sums.mean());
    return normal_sum.dot(n) > kMinCosine * length && std::abs(offset) < kMaxOffset * length;
  }
};

}  // namespace

SurveyCloud survey_cloud(const io::MapCloud& cloud) {
  constexpr float kMinLength = 0.5F;
  if (cloud.positions.empty()) {
    throw std::invalid_argument("has no points");
  }
  SurveyCloud result;
  result.origin = middle_of(cloud.positions);
  result.positions.reserve(cloud.positions.size());
  result.normals.reserve(cloud.positions.size());
  Rounding rounding;
  for (std::size_t i = 0; i < cloud.normals.size(); ++i) {
    const Eigen::Vector3d p = cloud.positions[i] - result.origin;
    const float length = cloud.normals[i].norm();
    if (p.cwiseAbs().maxCoeff() < kGridReach && p.allFinite() && length >= kMinLength &&
        std::isfinite(length)) {
      result.positions.push_back(p);
      result.normals.push_back(cloud.normals[i] / length);
      rounding.add(cloud.positions[i]);
    }
  }
  result.left_out = cloud.positions.size() - result.positions.size();
  result.rounding = rounding.step();
  if (result.positions.empty()) {
    throw std::invalid_argument(
        "none of the " + std::to_string(cloud.positions.size()) +
        " points has a position and a normal, which tells the two faces of a wall apart; make the "
        "map with `nvm run` or `nvm map`, with map.type=nvm");
  }
  bring_together(result);
  return result;
}

PatchGrid::PatchGrid(const SurveyCloud& cloud, double size) : size_(size) {
  sort_points(cloud);
  for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
    while (end < order_.size() && point_keys_[end] == point_keys_[begin]) {
      ++end;
    }
    keys_.push_back(point_keys_[begin]);
    first_patch_.push_back(static_cast<std::uint32_t>(patches_.size()));
    add_patches(cloud, begin, end);
  }
  first_patch_.push_back(static_cast<std::uint32_t>(patches_.size()));
  point_keys_ = {};
  find_rows();
}

void PatchGrid::sort_points(const SurveyCloud& cloud) {
  const std::vector<KeyedPoint> keyed = sorted_by_cell(cloud.positions, size_);
  order_.reserve(keyed.size());
  point_keys_.reserve(keyed.size());
  for (const auto& [key, index] : keyed) {
    order_.push_back(index);
    point_keys_.push_back(key);
  }
}

void PatchGrid::add_patches(const SurveyCloud& cloud, std::size_t begin, std::size_t end) {
  std::vector<Cluster> clusters;
  for (std::size_t i = begin; i < end; ++i) {
    const Eigen::Vector3d& p = cloud.positions[order_[i]];
    const Eigen::Vector3d n = cloud.normals[order_[i]].cast<double>();
    auto cluster = std::find_if(
        clusters.begin(), clusters.end(), [&](const Cluster& c) { return c.takes(p, n); });
    if (cluster == clusters.end()) {
      cluster = clusters.insert(cluster, Cluster());
    }
    cluster->sums.add(p);
    cluster->normal_sum += n;
    cluster->points.push_back(order_[i]);
  }
  const auto cell = static_cast<std::uint32_t>(keys_.size() - 1);
  auto position = static_cast<std::uint32_t>(begin);
  for (const Cluster& cluster : clusters) {
    Patch patch;
    patch.cell = cell;
    patch.begin = position;
    for (const std::uint32_t point : cluster.points) {
      order_[position++] = point;
    }
    patch.end = position;
    patch.sums = cluster.sums;
    patch.mean = cluster.sums.mean();
    patch.normal = cluster.normal_sum.normalized();
    patches_.push_back(patch);
  }
}

void PatchGrid::find_rows() {
  const auto cells = static_cast<std::uint32_t>(keys_.size());
  rows_.resize(cells);
  std::size_t row = 0;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy, ++row) {
      // Keys ascend, and so do the keys of the cells beside them.
      const auto shift = static_cast<std::uint64_t>(
          dz * (std::int64_t{1} << (2 * kBits)) + dy * (std::int64_t{1} << kBits));
      std::uint32_t begin = 0;
      std::uint32_t end = 0;
      for (std::uint32_t cell = 0; cell < cells; ++cell) {
        const std::uint64_t center = keys_[cell] + shift;
        while (begin < cells && keys_[begin] < center - 1) {
          ++begin;
        }
        while (end < cells && keys_[end] <= center + 1) {
          ++end;
        }
        rows_[cell][row] = {begin, end};
      }
    }
  }
}

double PatchGrid::noise() const {
  constexpr double kMinCount = 5.0;
  std::vector<double> spreads;
  for (const Patch& patch : patches_) {
    if (patch.sums.count >= kMinCount) {
      const auto plane = fit_plane(patch.sums, patch.normal);
      if (plane) {
        const double freedom = patch.sums.count / (patch.sums.count - 3.0);
        spreads.push_back(rms_distance(patch.sums, *plane) * std::sqrt(freedom));
      }
    }
  }
  return spreads.empty() ? 0.0 : median(std::move(spreads));
}

}  // namespace nvm::survey
