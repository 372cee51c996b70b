// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstdint>

namespace nvm::sim {

/// What a random number is drawn for: separate streams never share numbers.
enum class Stream : std::uint64_t {
  kRoute,
  kGait,
  kLidar,
  kGyro,
  kAccelerometer,
  kImuClock,
  kLidarLuck,  ///< with mirrors and bright surfaces
};

/// Random numbers that depend on (seed, stream, index) alone and not on what was drawn before, so
/// that points can be simulated in any order and on any number of threads with the same result.
///
/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014), started at a hash of the three.
class Random {
 public:
  Random(std::uint64_t seed, Stream stream, std::uint64_t index)
      : state_(mix(mix(mix(seed) + static_cast<std::uint64_t>(stream)) + index)) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Normal with mean 0 and standard deviation 1 (Box and Muller).
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * M_PI * uniform());
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;

  static std::uint64_t mix(std::uint64_t x) {
    x += kGolden;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
  }

  std::uint64_t next() {
    const std::uint64_t value = mix(state_);
    state_ += kGolden;
    return value;
  }

  std::uint64_t state_;
};

}  // namespace nvm::sim
