// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "common/sensor_data.hpp"
#include "lio/state/imu_noise.hpp"

namespace nvm::lio {

/// Learns how white the noise of an IMU is from its readings, because users do not know it.
///
/// Third differences of neighbouring readings tell it even in motion, which hardly changes from one
/// reading to the next. An IMU that filters its readings shows less noise there than it has; so at
/// rest the means over a tenth of a second, which is what a scan integrates, may say up to twice as
/// much (a hand's tremor would, too).
class ImuNoiseLearner {
 public:
  /// Takes readings in order of time, of which `at_rest` says whether the sensor is still.
  void add(const ImuSample& sample);

  /// What has been learned of a gyroscope and an accelerometer in place of the white noise that is
  /// zero in `given`; where too little is known, the usual. Between half and sixteen times of
  /// that.
  ImuNoise complete(const ImuNoise& given, bool at_rest) const;

 private:
  /// Of three axes together.
  class Triad {
   public:
    void add(const Eigen::Vector3d& reading, double interval);
    void interrupt();
    /// Spectral density [unit/sqrt(Hz)]; zero while it is not known.
    double density(bool at_rest) const;

   private:
    double fine() const;
    double coarse() const;

    std::array<Eigen::Vector3d, 3> last_{};  ///< latest first
    std::size_t run_ = 0;                    ///< of readings without a gap
    double sum_sq_third_ = 0.0;
    double sum_intervals_ = 0.0;
    std::size_t thirds_ = 0;
    Eigen::Vector3d block_ = Eigen::Vector3d::Zero();
    double block_duration_ = 0.0;
    Eigen::Vector3d last_mean_ = Eigen::Vector3d::Zero();
    bool has_mean_ = false;
    double sum_sq_steps_ = 0.0;  ///< between means, times their duration
    std::size_t steps_ = 0;
  };

  Triad gyro_, accel_;
  double last_time_ = 0.0;
  bool has_time_ = false;
};

}  // namespace nvm::lio
