// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace nvm::lio {

/// Finds out whether a gyroscope or an accelerometer cuts off what lies beyond its range: an axis
/// then stands at exactly its largest value, in leaps to it and away from it, while the other axes
/// go on. An axis that is dead stands still all the time.
class ImuClipping {
 public:
  struct Axis {
    int index = 0;       ///< 0 to 2
    double limit = 0.0;  ///< that its readings stand at; only of frozen() with its sign
    double share = 0.0;  ///< of all readings, 0 to 1
  };

  /// Takes three axes in any unit.
  void add(const Eigen::Vector3d& reading);

  /// The axis that is cut off most often; none of those that seldom are.
  std::optional<Axis> clipped() const;
  /// An axis that has not left its largest value for many readings: cut off, if that is too little.
  std::optional<Axis> stuck() const;
  /// An axis that has read one value, `limit`, in most of many readings, while the others changed.
  std::optional<Axis> frozen() const;

 private:
  struct Track {
    double last = 0.0;
    double limit = 0.0;
    double smallest_step = std::numeric_limits<double>::infinity();
    double step_in = 0.0;    ///< to the limit, when it was last reached
    std::size_t run = 0;     ///< of readings at the limit until now
    std::size_t runs = 0;    ///< that ended
    std::size_t count = 0;   ///< of readings in them
    std::size_t same = 0;    ///< readings on end, until now, that repeat the one before
    std::size_t frozen = 0;  ///< the most of them
    double frozen_at = 0.0;

    void add(double value, bool others_change);
    void end_run(double step_out);
  };

  std::array<Track, 3> tracks_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  std::size_t count_ = 0;
};

}  // namespace nvm::lio
