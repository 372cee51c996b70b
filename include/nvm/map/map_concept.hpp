// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "nvm/core/target.hpp"
#include "nvm/map/neighbor.hpp"

namespace nvm {
inline namespace NVM_TARGET {}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

template <class Map, class = void>
struct IsMap : std::false_type {};

template <class Map>
struct IsMap<
    Map,
    std::void_t<
        typename Map::QueryContext,
        decltype(std::declval<const Map&>().nearest(
            std::declval<const Eigen::Vector3d&>(),
            std::declval<const Eigen::Vector3f&>(),
            std::declval<const NearestSearch&>(),
            std::declval<Neighbor*>(),
            std::declval<typename Map::QueryContext&>()))>>
    : std::is_same<
          std::size_t,
          decltype(std::declval<const Map&>().nearest(
              std::declval<const Eigen::Vector3d&>(),
              std::declval<const Eigen::Vector3f&>(),
              std::declval<const NearestSearch&>(),
              std::declval<Neighbor*>(),
              std::declval<typename Map::QueryContext&>()))> {};

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {

/// The map concept that registration needs. A model has
///
/// - `Map::QueryContext`: default-constructible scratch state, one per calling thread. It may speed
///   a query up; it never changes its answer.
/// - `std::size_t nearest(const Eigen::Vector3d& point, const Eigen::Vector3f& normal,
///   const NearestSearch& search, Neighbor* out, QueryContext& context) const noexcept`: writes at
///   most `search.count` neighbours of `point` (map frame, m), ascending by distance, to `out`
///   (room for `search.count`) and returns how many. `normal` is the unit normal of the querying
///   surface in the map frame; a map without normals ignores it. Non-finite points get no
///   neighbours.
///
/// `nearest` may be called from many threads at once while nobody changes the map.
template <class Map>
inline constexpr bool is_map_v = detail::IsMap<Map>::value;

}  // namespace NVM_TARGET
}  // namespace nvm
