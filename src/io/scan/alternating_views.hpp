// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"

namespace nvm::io {

/// Keeps a topic to one of two LiDARs of one frame that send in turn, where no times of points show
/// it (SweepOverlap): each cloud looks like the last but one, not like the last.
class AlternatingViews {
 public:
  /// Judges by the first clouds, in the order in which they came, of which the first shows what to
  /// keep. Returns what to say, "" where each cloud looks like the last.
  std::string learn(const std::vector<Scan>& first);

  /// Takes the next cloud. Throws std::runtime_error for one that looks like those that are left
  /// out, while the others go on.
  void check(const Scan& scan);

 private:
  using View = std::vector<float>;  ///< mean range by direction [m]; 0 where little is seen

  static View view_of(const Scan& scan);
  static double difference(const View& a, const View& b);

  bool is_watched_ = false;
  View kept_, left_out_;                                         ///< the last ones
  double kept_time_ = -std::numeric_limits<double>::infinity();  // [s]
};

}  // namespace nvm::io
