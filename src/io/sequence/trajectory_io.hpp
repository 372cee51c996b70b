// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "nvm/geometry/trajectory.hpp"

namespace nvm::io {

/// Reads a TUM file: lines "t x y z qx qy qz qw" [s, m], '#' begins a comment. Throws
/// std::runtime_error "path:line: problem" for anything but eight finite numbers, a quaternion
/// whose length is more than 1 % from 1 (nearer ones are normalised), and a time not above the one
/// before.
Trajectory read_tum(const std::string& path);

/// Writes a TUM file, to 1 ns, 1 nm and 1e-12 of the quaternion. Throws std::runtime_error.
void write_tum(const std::string& path, const Trajectory& trajectory);

/// Writes the line of one pose.
void write_tum(std::ostream& out, const StampedPose& stamped);

/// Reads the poses of a KITTI file: lines of the 12 numbers of [R | t], row by row. `times` [s],
/// one per pose, date them. Throws std::runtime_error "path:line: problem" for anything but twelve
/// finite numbers and a matrix R that is more than 1 % from a rotation (nearer ones are made one),
/// or when the poses are not as many as `times`.
Trajectory read_kitti_poses(const std::string& path, const std::vector<double>& times);

/// Writes the poses of `trajectory` as a KITTI file, which has no times. Throws std::runtime_error.
void write_kitti_poses(const std::string& path, const Trajectory& trajectory);

/// Writes the line of one pose.
void write_kitti_pose(std::ostream& out, const Pose& pose);

/// Reads one ascending time [s] per line, as in KITTI's times.txt. Throws std::runtime_error
/// "path:line: problem".
std::vector<double> read_times(const std::string& path);

}  // namespace nvm::io
