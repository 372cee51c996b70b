// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// How nvm reads the coordinates of a point record. Specialise it for a record that is neither an
/// Eigen 3-vector nor has members `x`, `y`, `z`:
/// ```
/// template <> struct nvm::PointAccess<MyPoint> {
///   static Eigen::Vector3d position(const MyPoint& p) { return {p.east, p.north, p.up}; }
/// };
/// ```
template <class Point, class = void>
struct PointAccess;

/// Any record with arithmetic members x, y, z: PCL and Livox points, or your own.
template <class Point>
struct PointAccess<
    Point,
    std::enable_if_t<
        std::is_arithmetic_v<std::remove_reference_t<decltype(std::declval<const Point&>().x)>> &&
        std::is_arithmetic_v<std::remove_reference_t<decltype(std::declval<const Point&>().y)>> &&
        std::is_arithmetic_v<std::remove_reference_t<decltype(std::declval<const Point&>().z)>>>> {
  static Eigen::Vector3d position(const Point& point) {
    return {
        static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
  }
};

}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

template <class Derived>
std::integral_constant<int, Derived::SizeAtCompileTime> eigen_size(
    const Eigen::MatrixBase<Derived>&);

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {

/// Eigen vectors (and maps, blocks, expressions) of three elements.
template <class Vector>
struct PointAccess<
    Vector,
    std::enable_if_t<decltype(detail::eigen_size(std::declval<const Vector&>()))::value == 3>> {
  static Eigen::Vector3d position(const Vector& vector) { return vector.template cast<double>(); }
};

}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

template <class Point, class = void>
struct IsPoint : std::false_type {};
template <class Point>
struct IsPoint<
    Point,
    std::void_t<decltype(PointAccess<Point>::position(std::declval<const Point&>()))>>
    : std::true_type {};

template <class Range, class = void>
struct IsPointRange : std::false_type {};
template <class Range>
struct IsPointRange<
    Range,
    std::void_t<
        decltype(std::declval<const Range&>().size()),
        decltype(std::declval<const Range&>()[std::size_t{0}])>>
    : IsPoint<std::decay_t<decltype(std::declval<const Range&>()[std::size_t{0}])>> {};

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {

/// True when nvm can read a `Point`.
template <class Point>
inline constexpr bool is_point_v = detail::IsPoint<std::remove_cv_t<Point>>::value;

/// True for anything with `size()` and `operator[]` whose elements are points: std::vector with any
/// allocator, std::array, pcl::PointCloud, a view. Nothing is copied.
template <class Range>
inline constexpr bool is_point_range_v = detail::IsPointRange<Range>::value;

/// Coordinates of `point`, in the point's own frame and unit.
template <class Point>
Eigen::Vector3d position(const Point& point) {
  static_assert(
      is_point_v<Point>,
      "nvm: this type is not a point: give it members x, y, z or specialise nvm::PointAccess");
  return PointAccess<Point>::position(point);
}

}  // namespace NVM_TARGET
}  // namespace nvm
