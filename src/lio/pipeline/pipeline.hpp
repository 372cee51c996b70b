// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "lio/imu/imu_input_options.hpp"
#include "lio/map/lio_map.hpp"
#include "lio/match/unobserved_directions.hpp"
#include "lio/scan/deskew.hpp"
#include "lio/state/imu_noise.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"

namespace nvm::lio {

enum class FrameStatus {
  kInitializing,  ///< no pose yet, see FrameResult::message
  kTracking,      ///< the pose fits the map; the scan went into the map
  kDegenerate,    ///< the same, but along FrameResult::unobserved nothing has told it for too long
  kWeak,          ///< too little of the scan fits: the pose is the prediction, the map is unchanged
  kLost,          ///< weak for longer than max_weak_duration: do not trust the pose
  kSkipped,       ///< the scan is empty or older than the last one
};

const char* name(FrameStatus status);

/// Whether the pose fits the map as far as the scan tells.
inline bool is_believed(FrameStatus status) {
  return status == FrameStatus::kTracking || status == FrameStatus::kDegenerate;
}

/// FrameResult::message of frames that are weak or lost, with what to try.
inline constexpr const char* kTooLittleFits =
    "too little of the scan fits the map: try larger map.voxel_size in wide surroundings, check "
    "input.T_imu_lidar and the times of points and IMU";

/// FrameResult::message of a scan that cannot begin a map.
inline constexpr const char* kTooFewSurfaces = "the scan shows too few surfaces to begin with";

/// CPU time of the whole process that each stage of a frame took [ms].
struct StageTimes {
  double deskew = 0.0;  ///< IMU propagation included
  double normals = 0.0;
  double optimize = 0.0;  ///< keypoints, association, estimation
  double map_update = 0.0;

  double pose_estimation() const { return optimize + map_update; }
  double measurement() const { return deskew + pose_estimation(); }
  double total() const { return measurement() + normals; }
};

using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;

/// What a pipeline says about one scan.
struct FrameResult {
  FrameStatus status = FrameStatus::kInitializing;
  double time = 0.0;  ///< of the pose: the scan's end [s]
  Pose T_map_body = Pose::Identity();
  Pose T_map_lidar = Pose::Identity();
  /// Of the body's position [m^2] and of a rotation about the map's axes [rad^2]; zero without a
  /// pose, and for one that is so by definition.
  Covariance6 pose_covariance = Covariance6::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< of the body [m/s], map frame
  Eigen::Vector3d angular_rate = Eigen::Vector3d::Zero();  ///< of the body [rad/s], body frame
  Covariance6 twist_covariance = Covariance6::Zero();      ///< of velocity and angular_rate
  std::size_t points = 0;                                  ///< returns used
  std::size_t keypoints = 0;
  std::size_t residuals = 0;        ///< keypoints that found their surface in the map
  double inlier_share = 0.0;        ///< of the keypoints: those that fit the map, 0 to 1
  double residual_rms = 0.0;        ///< [m]
  int degenerate_directions = 0;    ///< of the pose's six, that the scan does not tell
  UnobservedDirections unobserved;  ///< these directions
  int iterations = 0;
  ImuNoise imu_noise = {0.0, 0.0, 0.0, 0.0, 0.0};  ///< given or learned; zero without an IMU
  double imu_time_offset = 0.0;  ///< given and learned: added to the readings' times [s]
  InsertStats inserted;
  StageTimes times;
  std::string message;  ///< why there is no pose, or what was done about bad data
};

/// From scans and IMU readings to poses and a map. Not safe to call from several threads at once.
class Pipeline {
 public:
  virtual ~Pipeline() = default;

  /// Takes an IMU reading. All readings up to imu_needed_until() a scan's end must come before that
  /// scan; a pipeline without an IMU ignores them.
  virtual void add_imu(const ImuSample& sample) = 0;
  /// `time` [s] by the clock that stamps the readings: they belong to it where that is late or
  /// early, as far as it is known by now.
  virtual double imu_needed_until(double time) const { return time; }

  /// Takes the next scan in order of time.
  virtual FrameResult process(const Scan& scan) = 0;

  virtual const LioMap& map() const = 0;

  /// The scan that process() took last, and its normals: unit vectors in the scan frame, a sighting
  /// (nvm/map/sighting.hpp) or zero where there is no plane. Only of use when that gave a pose.
  virtual const DeskewedScan& scan() const = 0;
  virtual const std::vector<Eigen::Vector3f>& normals() const = 0;

  /// Says where the body is in a map that others have begun, at the end of the next scan: about, as
  /// far as scans can be aligned. Only before the first pose.
  virtual void start_at(const Pose& T_map_body) = 0;

  /// What was found out of the IMU too late for the scans until then, as settings to begin again
  /// with; nothing while there is nothing, or the IMU is of no use.
  virtual std::optional<ImuSetup> better_imu_setup() const { return std::nullopt; }

  /// What is wrong, or was mended, in the data as a whole. One line each: what was seen, what it
  /// usually means, what mends it.
  virtual std::vector<std::string> findings() const { return {}; }
};

}  // namespace nvm::lio
