// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>

#include "adapters/common/host_options.hpp"
#include "adapters/common/point_fields.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/map/view_direction.hpp"

namespace nvm::adapters {

/// Finds the normals of a host's points as a NormalPolicy says, from the points themselves or from
/// where the sensor is.
class NormalFinder {
 public:
  NormalFinder() = default;
  explicit NormalFinder(const NormalPolicy& policy) : policy_(policy) {}

  void set_policy(const NormalPolicy& policy) noexcept { policy_ = policy; }
  /// Where the sensor is [m], map frame. Not finite, as at the start: unknown.
  void set_view_point(const Eigen::Vector3d& p_map_sensor) noexcept { view_point_ = p_map_sensor; }
  const Eigen::Vector3d& view_point() const noexcept { return view_point_; }

  /// Whether `normal` is a sighting, and the policy lets sightings stand for normals.
  bool takes(const Eigen::Vector3f& normal) const noexcept {
    return policy_.missing == MissingNormal::kViewDirection && is_sighting(normal);
  }

  /// The unit normal, or the sighting, that a query with this point goes by; zero when it has none.
  template <class Point>
  Eigen::Vector3f query_normal(const Point& point) const noexcept {
    return find(point, policy_.query);
  }
  /// The same for the point's insertion.
  template <class Point>
  Eigen::Vector3f insert_normal(const Point& point) const noexcept {
    return find(point, policy_.insert);
  }

  /// The normals that a range of points is inserted with, computed when read. Refers to both.
  template <class Points>
  struct Range {
    const NormalFinder& finder;
    const Points& points;
    std::size_t size() const { return static_cast<std::size_t>(points.size()); }
    Eigen::Vector3f operator[](std::size_t i) const { return finder.insert_normal(points[i]); }
  };
  template <class Points>
  Range<Points> insert_normals(const Points& points) const noexcept {
    return {*this, points};
  }

 private:
  template <class Point>
  Eigen::Vector3f find(const Point& point, NormalSource source) const noexcept {
    if (source == NormalSource::kPoint) {
      const Eigen::Vector3f normal = normal_field(point);
      if (is_unit_normal(normal) || takes(normal)) {
        return normal;
      }
    }
    const bool takes_direction =
        source == NormalSource::kViewDirection ||
        (source == NormalSource::kPoint && policy_.missing == MissingNormal::kViewDirection);
    return takes_direction ? view_direction(point, view_point_)
                           : Eigen::Vector3f(Eigen::Vector3f::Zero());
  }

  NormalPolicy policy_;
  Eigen::Vector3d view_point_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

}  // namespace nvm::adapters
