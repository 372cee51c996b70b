// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>

#include "nvm/core/option.hpp"
#include "nvm/core/target.hpp"

namespace nvm {

/// 0 to 255 each.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// What a point can carry beside its position and normal.
struct PointValues {
  float intensity = 0.0F;   ///< of its return, as the sensor gives it
  double time = 0.0;        ///< when it was seen [s]
  Color color;              ///< of what it lies on
  std::uint16_t label = 0;  ///< its class, as whoever labels it counts them
};

/// Which of them a map keeps (MapOptions::columns), a column each; what it does not keep costs
/// nothing.
struct MapColumns {
  bool intensity = false;
  bool time = false;
  bool color = false;
  bool label = false;
};

inline namespace NVM_TARGET {

/// Calls visit(info, &MapColumns::kept, &PointValues::value) for each column. A member in each of
/// the two structs and a line here are all that a column takes: options, storage, files and
/// exports walk over these.
template <class Visitor>
void visit_columns(Visitor&& visit) {
  const auto column = [](const char* name, const char* doc) {
    return OptionInfo{name, 0.0, 1.0, "", doc};
  };
  visit(
      column("intensity", "Points carry the intensity of their return"),
      &MapColumns::intensity,
      &PointValues::intensity);
  visit(column("time", "Points carry when they were seen"), &MapColumns::time, &PointValues::time);
  visit(column("color", "Points carry a colour"), &MapColumns::color, &PointValues::color);
  visit(column("label", "Points carry a class"), &MapColumns::label, &PointValues::label);
}

}  // namespace NVM_TARGET
}  // namespace nvm
