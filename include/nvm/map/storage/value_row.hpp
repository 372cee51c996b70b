// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "nvm/core/target.hpp"
#include "nvm/map/point_values.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// The values that a map keeps of one point, packed in the order of visit_columns(); of its bytes
/// only the first row_bytes() count.
using ValueRow = std::array<std::uint8_t, sizeof(PointValues)>;

inline std::size_t row_bytes(const MapColumns& columns) {
  std::size_t bytes = 0;
  visit_columns([&](const OptionInfo&, auto kept, auto value) {
    bytes += columns.*kept ? sizeof(PointValues{}.*value) : 0;
  });
  return bytes;
}

inline void pack(const MapColumns& columns, const PointValues& values, ValueRow& row) {
  std::uint8_t* at = row.data();
  visit_columns([&](const OptionInfo&, auto kept, auto value) {
    if (columns.*kept) {
      std::memcpy(at, &(values.*value), sizeof(values.*value));
      at += sizeof(values.*value);
    }
  });
}

inline PointValues unpack(const MapColumns& columns, const ValueRow& row) {
  PointValues values;
  const std::uint8_t* at = row.data();
  visit_columns([&](const OptionInfo&, auto kept, auto value) {
    if (columns.*kept) {
      std::memcpy(&(values.*value), at, sizeof(values.*value));
      at += sizeof(values.*value);
    }
  });
  return values;
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
