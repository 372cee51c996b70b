// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// As much of small_gicp's header of this name as an adapter sees: how it reads a cloud.
#include <Eigen/Core>
#include <cstddef>

namespace small_gicp::traits {

template <class T>
struct Traits;

template <class T>
std::size_t size(const T& points) {
  return Traits<T>::size(points);
}
template <class T>
auto point(const T& points, std::size_t i) {
  return Traits<T>::point(points, i);
}
template <class T>
auto normal(const T& points, std::size_t i) {
  return Traits<T>::normal(points, i);
}

}  // namespace small_gicp::traits
