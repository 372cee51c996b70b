// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "io/scan/scan_converter.hpp"

namespace nvm::io {

inline constexpr int kColumns = 400;
inline constexpr int kBeams = 4;

/// A sensor that turns once in `period`, anticlockwise from -x, beams side by side. Every second
/// beam sees nothing in every tenth column.
struct TurningSensor {
  double period = 0.05;
  double start = 100.0;  ///< [s]
  std::string field = "t";
  ScalarType type = ScalarType::kUint32;
  /// The tick of a point at time `dt` of the sweep that begins at `t`.
  std::function<double(double t, double dt)> tick = [](double, double dt) { return 1e9 * dt; };
  std::function<double(double t)> stamp = [](double t) { return t; };
  double delay = 0.001;  ///< of recording, after the sweep's end

  double time_of(int sweep) const { return start + period * sweep; }

  CloudMessage cloud(int sweep) const {
    CloudMessage message;
    PointRecords& records = message.records;
    records.source = "/scan";
    for (const char* name : {"x", "y", "z"}) {
      records.add_field(name, ScalarType::kFloat32);
    }
    records.add_field("ring", ScalarType::kUint8);
    if (!field.empty()) {
      records.add_field(field, type);
    }
    const double t = time_of(sweep);
    for (int column = 0; column < kColumns; ++column) {
      for (int beam = 0; beam < kBeams; ++beam) {
        append_point(t, column, beam, records);
      }
    }
    message.stamp = stamp(t);
    message.record_time = t + period + delay;
    return message;
  }

  void append_point(double t, int column, int beam, PointRecords& records) const {
    const double share = static_cast<double>(column) / kColumns;
    const double azimuth = 2.0 * M_PI * (share - 0.5);
    const bool is_return = column % 10 != 7 || beam % 2 == 0;
    const double range = is_return ? 5.0 + beam : 0.0;
    for (const double value :
         {range * std::cos(azimuth), range * std::sin(azimuth), is_return ? 0.3 * beam : 0.0}) {
      append_bytes(static_cast<float>(value), records.bytes);
    }
    append_bytes(static_cast<std::uint8_t>(beam), records.bytes);
    if (!field.empty()) {
      const double ticks = is_return ? tick(t, period * share) : 0.0;
      visit_type(type, [&](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_same_v<T, std::uint32_t>) {
          append_bytes(
              static_cast<T>(static_cast<std::int64_t>(std::llround(ticks))), records.bytes);
        } else {
          append_bytes(static_cast<T>(ticks), records.bytes);
        }
      });
    }
    ++records.size;
  }

  std::vector<CloudMessage> clouds(int count) const {
    std::vector<CloudMessage> messages;
    for (int i = 0; i < count; ++i) {
      messages.push_back(cloud(i));
    }
    return messages;
  }

  /// The scans of `count` sweeps; `damage` may change the messages first.
  std::vector<Scan> scans(
      ScanConverter& converter, const std::vector<CloudMessage>& messages) const {
    converter.learn(messages);
    std::vector<Scan> scans;
    for (const CloudMessage& message : messages) {
      scans.push_back(converter.convert(message.records, message.stamp));
    }
    return scans;
  }
};

}  // namespace nvm::io
