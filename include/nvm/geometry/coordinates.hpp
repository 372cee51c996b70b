// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "nvm/core/target.hpp"

// Eigen's expressions are templates: one in a function that is no template itself is instantiated
// by every file that includes it, whether it calls the function or not; in a template, one whose
// types do not depend on it is so in part. Functions of include/nvm calculate with coordinates
// instead, or are made of the types that they are given: most of what nvm/nvm.hpp cost to
// include (docs/performance.md). For the same reason functions and classes that use containers,
// tables or much else are templates even where there is nothing to choose (`template <class =
// void>`): only the files that call them have them compiled.
namespace nvm::detail {
inline namespace NVM_TARGET {

/// The vector of value(0), value(1) and value(2). Inlined always, like what follows: with -O2 a
/// query would take 1.5 % more instructions.
template <class Value>
[[gnu::always_inline]] inline auto per_axis(const Value& value)
    -> Eigen::Matrix<decltype(value(0)), 3, 1> {
  return {value(0), value(1), value(2)};
}

/// Whether holds(0), holds(1) and holds(2).
template <class Condition>
bool on_all_axes(const Condition& holds) {
  return holds(0) && holds(1) && holds(2);
}

template <class To, class Real>
Eigen::Matrix<To, 3, 1> cast(const Eigen::Matrix<Real, 3, 1>& v) {
  return {static_cast<To>(v.x()), static_cast<To>(v.y()), static_cast<To>(v.z())};
}

/// A vector or matrix of fixed size.
template <class Matrix>
Matrix zeros() {
  Matrix matrix;
  std::fill_n(matrix.data(), matrix.size(), typename Matrix::Scalar{});
  return matrix;
}

template <class Real>
[[gnu::always_inline]] inline Eigen::Matrix<Real, 3, 1> difference(
    const Eigen::Matrix<Real, 3, 1>& a, const Eigen::Matrix<Real, 3, 1>& b) {
  return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}

template <class Real>
[[gnu::always_inline]] inline Real dot(
    const Eigen::Matrix<Real, 3, 1>& a, const Eigen::Matrix<Real, 3, 1>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

template <class Real>
Eigen::Matrix<Real, 3, 1> cross(
    const Eigen::Matrix<Real, 3, 1>& a, const Eigen::Matrix<Real, 3, 1>& b) {
  return {
      a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

template <class Real>
[[gnu::always_inline]] inline Real sq_norm(const Eigen::Matrix<Real, 3, 1>& v) {
  return dot(v, v);
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
