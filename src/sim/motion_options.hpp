// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::sim {

/// How the sensor is carried along a route.
struct MotionOptions {
  double speed = 0.0;       ///< [m/s], up to 1.2; 0: the scene's
  double still_time = 2.5;  ///< at the start [s], 2.5 to 60
  double height = 1.3;      ///< of the IMU above the floor [m]
  double tilt_deg = 8.0;  ///< of the IMU against the horizontal, in a direction chosen by the seed
  double gait = 1.0;      ///< scale of the sway and bob of walking, 0 to 2
  double wander = 1.0;    ///< scale of the hand's slow turns, 0 to 2
  double waypoint_jitter = 0.04;  ///< each waypoint is moved by up to this, by the seed [m]
  double clearance = 0.25;        ///< from the sensor to any surface, at least [m]
};

}  // namespace nvm::sim
