// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <vector>

#include "common/sensor_data.hpp"
#include "sim/motion.hpp"
#include "sim/random.hpp"

namespace nvm::sim {

/// How one triad of sensors errs; the unit is rad/s for gyroscopes, m/s^2 for accelerometers.
struct TriadNoise {
  double noise_density = 0.0;     ///< white noise [unit / sqrt(Hz)]
  double bias_walk = 0.0;         ///< random walk of the bias [unit / s / sqrt(Hz)]
  double initial_bias = 0.0;      ///< standard deviation of the bias at the start [unit]
  double scale_error = 0.0;       ///< standard deviation of the scale of each axis
  double misalignment_deg = 0.0;  ///< standard deviation of the turn about each axis
  double vibration = 0.0;         ///< amplitude of what the carrier shakes it by [unit]
};

/// A MEMS IMU. The defaults are those of a good consumer part (Bosch BMI088 class).
struct ImuOptions {
  double rate = 200.0;                ///< [Hz]
  double gravity = 9.81;              ///< [m/s^2]
  double grade = 1.0;                 ///< factor of all errors of both triads
  double vibration_frequency = 87.0;  ///< [Hz]
  double clock_offset = 0.0;          ///< its stamps are late by this [s]
  double clock_jitter = 0.0;          ///< standard deviation of a stamp [s]; their order holds
  TriadNoise gyro{2.4e-4, 1e-5, 2e-3, 0.0, 0.0};
  TriadNoise accelerometer{1.7e-3, 1e-4, 3e-2, 0.0, 0.0};
};

/// The readings of an IMU that is carried along `motion`, from time 0 to its end.
std::vector<ImuSample> simulate_imu(
    const Motion& motion, const ImuOptions& options, std::uint64_t seed);

}  // namespace nvm::sim
