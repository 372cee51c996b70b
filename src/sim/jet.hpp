// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>

namespace nvm::sim {

/// A function of time at one instant with its first two derivatives [per s, per s^2]. Code that is
/// a template on its scalar gives exact derivatives when it is run on jets.
struct Jet {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

/// Time itself.
inline Jet time_jet(double t) { return {t, 1.0, 0.0}; }

inline Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}
inline Jet operator-(const Jet& a, const Jet& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}
inline Jet operator*(const Jet& a, const Jet& b) {
  return {
      a.value * b.value,
      a.first * b.value + a.value * b.first,
      a.second * b.value + 2.0 * a.first * b.first + a.value * b.second};
}
inline Jet operator+(const Jet& a, double b) { return {a.value + b, a.first, a.second}; }
inline Jet operator+(double a, const Jet& b) { return b + a; }
inline Jet operator-(const Jet& a, double b) { return {a.value - b, a.first, a.second}; }
inline Jet operator-(double a, const Jet& b) { return {a - b.value, -b.first, -b.second}; }
inline Jet operator*(const Jet& a, double b) { return {a.value * b, a.first * b, a.second * b}; }
inline Jet operator*(double a, const Jet& b) { return b * a; }

inline Jet sin(const Jet& a) {
  const double s = std::sin(a.value);
  const double c = std::cos(a.value);
  return {s, c * a.first, c * a.second - s * a.first * a.first};
}
inline Jet cos(const Jet& a) {
  const double s = std::sin(a.value);
  const double c = std::cos(a.value);
  return {c, -s * a.first, -s * a.second - c * a.first * a.first};
}

inline double value_of(double a) { return a; }
inline double value_of(const Jet& a) { return a.value; }

}  // namespace nvm::sim
