// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lio/imu/axes_watch.hpp"
#include "lio/imu/clock_watch.hpp"
#include "lio/imu/imu_clipping.hpp"
#include "lio/imu/imu_input_options.hpp"
#include "lio/imu/motion_fit.hpp"
#include "lio/imu/motion_history.hpp"
#include "lio/imu/range_scale.hpp"
#include "lio/imu/rest_force.hpp"
#include "lio/imu/turn_comparison.hpp"

namespace nvm::lio {

/// What the scans say of the IMU.
enum class ImuVerdict {
  kUnknown,   ///< too little motion yet
  kGood,      ///< both tell the same motion
  kMended,    ///< a unit, sign or clock has been mended: what was read before counts no more
  kDoubtful,  ///< they contradict each other, unless the IMU has led the poses: go on without it
  kUnusable,  ///< they contradict each other, for a reason that findings() tells
};

/// Checks the IMU against poses that scans tell without it: units, signs, gravity, axes and clock.
class ImuJudge {
 public:
  /// `T_body_lidar`: the extrinsic that the poses take for granted; `gravity` [m/s^2].
  ImuJudge(const ImuInputOptions& options, const Pose& T_body_lidar, double gravity);

  /// A reading with all that has been found out so far.
  ImuSample mended(const ImuSample& reading) const;
  /// Takes readings as they come.
  void add(const ImuSample& reading);
  void add(const StampedPose& T_map_body) { history_.add(T_map_body); }
  /// The next poses belong to another stretch.
  void forget() { history_.clear(); }

  /// Whether enough readings came to tell the units.
  bool knows_unit() const { return first_.size() >= kUnitCount; }
  /// Of poses that know nothing of the IMU, once they last for `duration` [s].
  ImuVerdict judge(double duration);
  /// Of poses that were predicted by the IMU, in which small contradictions do not show.
  ImuVerdict watch();
  /// Of what the accelerometer feels at rest [m/s^2, body frame].
  ImuVerdict judge_rest(const Eigen::Vector3d& force);
  /// Of ranges, clocks, and what the force at rest has left open, the last pose being of `time`
  /// [s]. Mended is nothing but the scale of the accelerations.
  ImuVerdict inspect(double time);
  /// How late the IMU's clock was found to be since the last call [s]: its readings are to be moved
  /// by the negative of it, those to come too. Zero if nothing was found.
  double take_clock_offset();
  /// All of it [s].
  double clock_offset() const { return clocks_.mended(); }
  /// Settings with which all that motion has told would have held from the beginning; nothing while
  /// it has told nothing that counts.
  std::optional<ImuSetup> better_setup() const;
  /// The motion at the last pose, once scans and accelerometer agree on it.
  std::optional<MotionFit> motion() const;

  /// One line each: what was seen, what it usually means, what mends it.
  const std::vector<std::string>& findings() const { return findings_; }
  /// The same, and what the whole run says of clocks and force at rest.
  std::vector<std::string> summary() const;
  /// Of an axis that stands still, which only explains what contradicts the scans; "" without one.
  std::string frozen_axis() const;

 private:
  static constexpr std::size_t kUnitCount = 20;

  ImuVerdict judge_turns(double max_mismatch, bool are_poses_apart);
  void tell_contradiction(const TurnComparison& turns, bool is_turned, bool are_mirrored);
  bool mend_offset(const TurnComparison& turns, bool is_explained);
  bool mend_gyro(const TurnComparison& turns, bool is_explained);
  void look_at_clock(double time);
  void mend_clock(double offset);
  void weigh_rotation(double duration);
  std::optional<AxesWatch::Finding> learned_axes() const;
  ImuVerdict judge_gravity();
  ImuVerdict weigh_rest(double duration);
  ImuVerdict judge_sign(ImuVerdict turns);
  void find_units();
  void mend_accel_unit(double force);
  void tell(std::string finding);

  ImuInputOptions options_;
  Pose T_body_lidar_;
  double gravity_;
  double gyro_scale_, accel_scale_;
  bool has_mended_gyro_ = false, has_mended_accel_ = false;  ///< by what motion told
  bool are_swapped_ = false;                                 ///< gyroscope and accelerometer
  std::vector<ImuSample> first_;  ///< readings as they came, that tell the units
  MotionHistory history_;
  bool has_offset_ = false;    ///< of the clocks, by the last look at the turns
  bool tells_offset_ = false;  ///< by any
  bool contradicts_ = false;   ///< the gyroscope the scans: it tells nothing of clocks
  ImuClipping gyro_clipping_, accel_clipping_;
  RestForce rest_;
  RangeScale ranges_;
  ClockWatch clocks_;
  AxesWatch axes_;
  /// Of poses from what the accelerometer tells of them, with its axes as they are and turned by
  /// what axes_ has found [m^2].
  double sq_misfit_ = 0.0, sq_misfit_turned_ = 0.0;
  double untaken_offset_ = 0.0;  ///< of the clock, for take_clock_offset() [s]
  double clocked_ = -1e300;      ///< until then the turns have told of the clock [s]
  double tried_clock_ = -1e300;  ///< when they were asked last [s]
  double inspected_ = -1e300;    ///< time of the last inspection [s]
  std::vector<std::string> findings_;
};

}  // namespace nvm::lio
