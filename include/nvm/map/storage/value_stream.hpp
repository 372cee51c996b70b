// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/point_values.hpp"
#include "nvm/map/storage/byte_stream.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

template <class Number>
void put_value(Number value, ByteWriter& out) {
  out.put(value);
}
template <class = void>
void put_value(const Color& color, ByteWriter& out) {
  for (const std::uint8_t part : {color.red, color.green, color.blue}) {
    out.put(part);
  }
}

template <class Number>
void get_value(ByteReader& in, Number& value) {
  value = in.get<Number>();
}
template <class = void>
void get_value(ByteReader& in, Color& color) {
  for (std::uint8_t* part : {&color.red, &color.green, &color.blue}) {
    *part = in.get<std::uint8_t>();
  }
}

/// The values of the columns that are kept, in the order of visit_columns().
template <class = void>
void write_values(const MapColumns& columns, const PointValues& values, ByteWriter& out) {
  visit_columns([&](const OptionInfo&, auto kept, auto value) {
    if (columns.*kept) {
      put_value(values.*value, out);
    }
  });
}
template <class = void>
PointValues read_values(const MapColumns& columns, ByteReader& in) {
  PointValues values;
  visit_columns([&](const OptionInfo&, auto kept, auto value) {
    if (columns.*kept) {
      get_value(in, values.*value);
    }
  });
  return values;
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
