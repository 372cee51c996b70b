// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// As much of small_gicp's header of this name as an adapter sees: how it asks a search structure.
#include <Eigen/Core>
#include <cstddef>
#include <type_traits>

namespace small_gicp::traits {

template <class T>
struct Traits;

template <class T>
std::size_t knn_search(
    const T& tree, const Eigen::Vector4d& p, std::size_t k, std::size_t* i, double* sq) {
  return Traits<T>::knn_search(tree, p, k, i, sq);
}

// The name of the member alone must be enough to detect it: no overloads, no templates.
template <class T, class = void>
struct has_nearest_neighbor_search : std::false_type {};
template <class T>
struct has_nearest_neighbor_search<T, std::void_t<decltype(&Traits<T>::nearest_neighbor_search)>>
    : std::true_type {};

template <class T>
std::size_t nearest_neighbor_search(
    const T& tree, const Eigen::Vector4d& p, std::size_t* i, double* sq) {
  static_assert(has_nearest_neighbor_search<T>::value);
  return Traits<T>::nearest_neighbor_search(tree, p, i, sq);
}

}  // namespace small_gicp::traits
