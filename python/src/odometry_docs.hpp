// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::python {

inline constexpr char kOdometryDoc[] =
    R"(Odometry and mapping, scan by scan: the pipelines of ``nvm run``.

Parameters
----------
config : dict or path, optional
    Settings as in the files of ``nvm run --config``, ``{"map": {"voxel_size": 0.2}}``, or as behind
    its ``--set``, ``{"map.voxel_size": 0.2}``. Without ``pipeline`` it is 'fast_lio' when an IMU
    reading comes before the first scan, else 'lidar_only'.
T_imu_lidar : (4, 4) float, optional
    Maps LiDAR to IMU coordinates; the identity without it, which `findings` says.

Raises
------
ValueError
    For an unknown key, a value out of range, or a pose that is not rigid.)";

inline constexpr char kAddImuDoc[] = R"(Take readings of the IMU: one, or N at once.

All readings up to a scan's end, as `imu_needed_until` says it, must come before that scan, in any
order. One that comes later than that, or twice, is left out.

Parameters
----------
times : float or (N,) float64
    [s].
gyro : (3,) or (N, 3) float
    Angular velocity [rad/s], in the IMU's frame.
accel : (3,) or (N, 3) float
    Specific force [m/s^2]: +9.81 upwards at rest.

Raises
------
ValueError
    For numbers that are not finite; no reading is taken then.
RuntimeError
    For the first reading after the first scan, unless ``pipeline`` is set.)";

inline constexpr char kImuNeededDoc[] = R"(Until when readings are needed before a scan.

Parameters
----------
time : float
    The scan's end [s].

Returns
-------
float
    The same by the clock that stamps the readings [s], as far as its offset
    is known by now: given as ``imu.time_offset``, or learned.)";

inline constexpr char kRegisterDoc[] = R"(Take the next scan, in order of time.

Parameters
----------
points : (N, 3) float
    [m], raw: in the LiDAR's frame at each point's own time. Points that are not finite are left out.
times : (N,) float, or float
    When each point was seen [s], on the clock of the IMU and in any order; one number for a sensor
    that sees all points at once. Without `begin` absolute, and float64; with it, from it on.
begin, end : float, optional
    Of the sweep [s]; by default of the points. The pose is that at the end.
intensity : (N,) float, optional
    Of the returns, for the map: ``odometry.map.column("intensity")``.

Returns
-------
FrameResult

Raises
------
ValueError
    For arrays of other shapes, and for times that lie outside `begin` to `end` or span more than
    10 s, which are of another unit.)";

inline constexpr char kFindingsDoc[] = R"(What is wrong, or was mended, in the data so far.

Returns
-------
list of str
    One line each, as ``nvm run`` prints them at its end: what was seen, what it usually means, what
    mends it.)";

inline constexpr char kScanDoc[] =
    R"(tuple: points and normals, (M, 3) float32, of the scan that was registered last, deskewed: in the
LiDAR's frame at the scan's end. Only of use when that gave a pose.)";

inline constexpr char kFrameDoc[] = R"(What became of a scan.

Attributes
----------
status : str
    'initializing' (no pose yet), 'tracking', 'degenerate' (the same, but nothing has told the
    unobserved directions for too long), 'weak' (too little fits: the pose is a prediction), 'lost'
    (do not trust the pose) or 'skipped' (empty, or older than the last one).
time : float
    Of the pose: the scan's end [s].
T_map_body, T_map_lidar : (4, 4) float64
    Poses of the IMU (without one: of the LiDAR) and of the LiDAR.
velocity, angular_rate : (3,) float64
    Of the body: [m/s] in the map's frame, [rad/s] in its own.
pose_covariance, twist_covariance : (6, 6) float64
    Of position [m^2] and of a rotation about the map's axes [rad^2]; of velocity and angular rate.
points, keypoints, residuals, iterations : int
inlier_share : float
    Of the keypoints: those that fit the map, 0 to 1.
residual_rms : float
    [m].
degenerate_directions : int
    Of the pose's six, that the scan does not tell.
unobserved_translations, unobserved_rotations : (N, 3) float64
    These directions: unit vectors in the map's frame, unit axes in the body's.
inserted : InsertStats
times_ms : dict
    CPU time of each stage [ms].
message : str
    Why there is no pose, or what was done about bad data.)";

}  // namespace nvm::python
