// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "nvm/core/finite.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/normal/normal_result.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// The neighbourhood radius as a function of range: Eq. 1 as decided in spec §2.2,
/// r = R_min + clamp((D - D_min) / (D_max - D_min), 0, 1) (R_max - R_min).
class RadiusLaw {
 public:
  explicit RadiusLaw(const NormalOptions& options)
      : min_range_(options.min_range),
        slope_((options.max_radius - options.min_radius) / (options.max_range - options.min_range)),
        min_radius_(options.min_radius),
        max_radius_(options.max_radius) {}

  /// Radius [m] at `sq_range` [m^2].
  double operator()(double sq_range) const {
    if (slope_ == 0.0) {
      return min_radius_;
    }
    const double radius = min_radius_ + slope_ * (std::sqrt(sq_range) - min_range_);
    return std::clamp(radius, min_radius_, max_radius_);
  }

 private:
  double min_range_, slope_, min_radius_, max_radius_;
};

}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

/// The viewpoint of point `i`: `viewpoints` is one point or a range of points.
template <class Viewpoints>
Eigen::Vector3d viewpoint_of(const Viewpoints& viewpoints, [[maybe_unused]] std::size_t i) {
  if constexpr (is_point_v<Viewpoints>) {
    return position(viewpoints);
  } else {
    return position(viewpoints[i]);
  }
}

/// Float coordinates relative to a local origin, as a structure of arrays, and the squared radius
/// of each point's neighbourhood. Floats resolve 1 mm at the largest distance from the origin.
struct LocalPoints {
  static constexpr double kMaxOffset = 1e4;  // [m]

  std::vector<float> x, y, z, sq_radius;

  template <class = void>
  void resize(std::size_t size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
    sq_radius.resize(size);
  }
};

/// The range filter of spec §2.1 and the change to local coordinates.
class Localizer {
 public:
  Localizer(const NormalOptions& options, const Eigen::Vector3d& origin)
      : origin_(origin),
        sq_min_range_(options.min_range * options.min_range),
        sq_max_range_(options.max_range * options.max_range),
        radius_(options) {}

  /// Writes point `i` to `local` and returns kValid, or says why the point is dropped.
  NormalStatus operator()(
      const Eigen::Vector3d& point,
      const Eigen::Vector3d& viewpoint,
      std::size_t i,
      LocalPoints& local) const {
    const double sq_range = sq_norm(difference(point, viewpoint));
    if (magnitude(sq_range) > magnitude(sq_max_range_)) {  // NaN is
      return all_finite(point) && all_finite(viewpoint) ? NormalStatus::kTooFar
                                                        : NormalStatus::kNonFinite;
    }
    if (sq_range < sq_min_range_) {
      return NormalStatus::kTooNear;
    }
    const Eigen::Vector3d offset = difference(point, origin_);
    if (!on_all_axes([&](int axis) { return std::abs(offset[axis]) <= LocalPoints::kMaxOffset; })) {
      return NormalStatus::kFarOrigin;
    }
    local.x[i] = static_cast<float>(offset.x());
    local.y[i] = static_cast<float>(offset.y());
    local.z[i] = static_cast<float>(offset.z());
    const auto radius = static_cast<float>(radius_(sq_range));
    local.sq_radius[i] = radius * radius;
    return NormalStatus::kValid;
  }

 private:
  Eigen::Vector3d origin_;
  double sq_min_range_, sq_max_range_;
  RadiusLaw radius_;
};

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {}  // namespace NVM_TARGET
}  // namespace nvm
