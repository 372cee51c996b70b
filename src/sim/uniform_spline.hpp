// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/jet.hpp"

namespace nvm::sim {

/// A uniform B-spline of degree five in time with values in R^N: four times continuously
/// differentiable, and never outside the convex hull of the function that it smooths.
///
/// Its control values are samples of that function, which makes it the function seen through a
/// window of standard deviation sqrt(1/2) knot spacings: corners become curves of that size.
template <std::size_t N>
class UniformSpline {
 public:
  using Value = std::array<double, N>;

  static constexpr double kReach = 3.0;  ///< knot spacings over which a control value acts

  /// Smooths `function(double time)` over [0, duration]. Asks for times up to three `spacing`s
  /// outside. `duration` >= 0 and `spacing` > 0 [s].
  template <class Function>
  UniformSpline(double duration, double spacing, const Function& function) : spacing_(spacing) {
    const auto spans = static_cast<std::size_t>(std::ceil(duration / spacing)) + 1;
    controls_.reserve(spans + kControls);
    for (std::size_t i = 0; i < spans + kControls; ++i) {
      controls_.push_back(function((static_cast<double>(i) - kLead) * spacing));
    }
  }

  /// The value at time `t` [s], a double or a Jet; times outside [0, duration] extrapolate.
  template <class Scalar>
  std::array<Scalar, N> at(const Scalar& t) const {
    const auto last_span = static_cast<double>(controls_.size() - kControls - 1);
    const double span = std::clamp(std::floor(value_of(t) / spacing_), 0.0, last_span);
    const std::array<Scalar, kControls> weights = basis(t * (1.0 / spacing_) - span);
    const Value* controls = controls_.data() + static_cast<std::size_t>(span);
    std::array<Scalar, N> result{};
    for (std::size_t k = 0; k < kControls; ++k) {
      for (std::size_t n = 0; n < N; ++n) {
        result[n] = result[n] + controls[k][n] * weights[k];
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t kControls = 6;  ///< that reach one span
  static constexpr double kLead = 2.0;         ///< of them before the span's first knot

  /// The six basis polynomials of a uniform quintic B-spline over one span, `u` in [0, 1].
  template <class Scalar>
  static std::array<Scalar, kControls> basis(const Scalar& u) {
    constexpr double kScale = 1.0 / 120.0;
    const Scalar v = 1.0 - u;
    const Scalar u2 = u * u;
    const Scalar v2 = v * v;
    const auto inner = [&](const Scalar& x) {  // the neighbours of the two central polynomials
      return kScale * (1.0 + x * (5.0 + x * (10.0 + x * (10.0 + x * (5.0 - 5.0 * x)))));
    };
    const auto central = [&](const Scalar& x2, const Scalar& x) {
      return kScale * (66.0 + x2 * (-60.0 + x2 * (30.0 - 10.0 * x)));
    };
    return {
        kScale * (v2 * v2 * v),
        inner(v),
        central(u2, u),
        central(v2, v),
        inner(u),
        kScale * (u2 * u2 * u)};
  }

  double spacing_;
  std::vector<Value> controls_;
};

}  // namespace nvm::sim
