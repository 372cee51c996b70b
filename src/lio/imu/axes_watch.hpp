// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "lio/imu/motion_history.hpp"

namespace nvm::lio {

/// Learns by how many degrees the LiDAR is turned against where the extrinsic has it: by which
/// rotation the gyroscope turns as the scans do, a second at a time, for poses that lean on the IMU
/// hide it in shorter ones. Its bias, its scale and its clock, which would pass for one,
/// are learned beside it. Larger ones, of axes that are swapped, TurnComparison tells at once.
class AxesWatch {
 public:
  /// Some turns on end, the same by both.
  struct Stretch {
    double begin, end;                  ///< [s]
    Eigen::Vector3d by_scans, by_gyro;  ///< rotation vectors [rad]
    std::size_t turns;
  };

  /// From the IMU's axes to those that the poses take for them, and how late its clock is [s].
  struct Finding {
    Eigen::Matrix3d rotation;
    double lateness;
  };

  /// Takes what has turned until after `begin` [s], when it was looked at last, in a history whose
  /// readings have been moved by `-mended` [s].
  void look(const MotionHistory& history, double begin, double mended);

  /// Nothing unless it is sure and turns by a degree or more.
  std::optional<Finding> finding() const;

 private:
  /// Rotation [rad], bias [rad/s], lateness [s], scale: each row of `H` says what they add to a
  /// turn of the scans.
  static constexpr int kSize = 8;
  static constexpr int kRotation = 3;  ///< the first so many
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  void add(const MotionHistory& history, const Stretch& stretch, double mended);
  double difference_left(int first, const Matrix& prior) const;
  static Matrix prior_information();

  Matrix information_ = Matrix::Zero();  ///< the sum of H^T H
  Vector vector_ = Vector::Zero();       ///< the sum of H^T times the difference of both turns
  double sq_difference_ = 0.0;           ///< [rad^2]
  double weight_ = 0.0;                  ///< of the stretches, each by the share that is its own
};

}  // namespace nvm::lio
