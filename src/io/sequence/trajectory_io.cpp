// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/trajectory_io.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>

#include "io/file/file.hpp"
#include "io/file/line_reader.hpp"
#include "io/file/pending_path.hpp"

namespace nvm::io {
namespace {

constexpr double kTolerance = 0.01;

/// The `count` numbers of the next line; nothing at the end of the file.
std::optional<std::vector<double>> next_numbers(LineReader& lines, std::size_t count) {
  const auto words = lines.next();
  if (!words) {
    return std::nullopt;
  }
  if (words->size() != count) {
    lines.fail(
        "has " + std::to_string(words->size()) + " values instead of " + std::to_string(count));
  }
  std::vector<double> numbers;
  for (const std::string_view word : *words) {
    numbers.push_back(lines.number(word));
  }
  return numbers;
}

/// Fails unless `time` is above `previous`, which it then replaces.
void check_ascending(const LineReader& lines, double time, double& previous) {
  if (time <= previous) {
    lines.fail(
        "time " + std::to_string(time) + " is not above " + std::to_string(previous) +
        " of the line before");
  }
  previous = time;
}

Pose pose_from_tum(const LineReader& lines, const std::vector<double>& numbers) {
  const Eigen::Quaterniond q(numbers[7], numbers[4], numbers[5], numbers[6]);
  if (std::abs(q.norm() - 1.0) > kTolerance) {
    lines.fail("quaternion has length " + std::to_string(q.norm()) + " instead of 1");
  }
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() << numbers[1], numbers[2], numbers[3];
  return pose;
}

Pose pose_from_kitti(const LineReader& lines, const std::vector<double>& numbers) {
  using RowMajor = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> matrix(numbers.data());
  const Eigen::Matrix3d R = matrix.leftCols<3>();
  if (!(R.transpose() * R).isIdentity(kTolerance) || R.determinant() < 0.0) {
    lines.fail("the left 3x3 block is not a rotation");
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Pose pose = Pose::Identity();
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  pose.translation() = matrix.col(3);
  return pose;
}

}  // namespace

Trajectory read_tum(const std::string& path) {
  LineReader lines(path);
  Trajectory trajectory;
  double previous = -std::numeric_limits<double>::infinity();
  while (const auto numbers = next_numbers(lines, 8)) {
    check_ascending(lines, (*numbers)[0], previous);
    trajectory.push_back({(*numbers)[0], pose_from_tum(lines, *numbers)});
  }
  return trajectory;
}

void write_tum(const std::string& path, const Trajectory& trajectory) {
  AtomicFile file(path);
  for (const StampedPose& stamped : trajectory) {
    write_tum(file.stream(), stamped);
  }
  file.commit();
}

void write_tum(std::ostream& out, const StampedPose& stamped) {
  const Eigen::Vector3d p = stamped.pose.translation();
  const Eigen::Quaterniond q(stamped.pose.linear());
  out << std::fixed;
  out.precision(9);
  out << stamped.time << ' ' << p.x() << ' ' << p.y() << ' ' << p.z() << ' ';
  out.precision(12);
  out << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
}

Trajectory read_kitti_poses(const std::string& path, const std::vector<double>& times) {
  LineReader lines(path);
  Trajectory trajectory;
  while (const auto numbers = next_numbers(lines, 12)) {
    if (trajectory.size() == times.size()) {
      lines.fail("more poses than the " + std::to_string(times.size()) + " times");
    }
    trajectory.push_back({times[trajectory.size()], pose_from_kitti(lines, *numbers)});
  }
  if (trajectory.size() != times.size()) {
    fail(
        path,
        "has " + std::to_string(trajectory.size()) + " poses for " + std::to_string(times.size()) +
            " times");
  }
  return trajectory;
}

void write_kitti_poses(const std::string& path, const Trajectory& trajectory) {
  AtomicFile file(path);
  for (const StampedPose& stamped : trajectory) {
    write_kitti_pose(file.stream(), stamped.pose);
  }
  file.commit();
}

void write_kitti_pose(std::ostream& out, const Pose& pose) {
  const Eigen::IOFormat one_line(Eigen::StreamPrecision, Eigen::DontAlignCols, " ", " ");
  out.precision(17);
  out << pose.matrix().topRows<3>().format(one_line) << '\n';
}

std::vector<double> read_times(const std::string& path) {
  LineReader lines(path);
  std::vector<double> times;
  double previous = -std::numeric_limits<double>::infinity();
  while (const auto numbers = next_numbers(lines, 1)) {
    check_ascending(lines, (*numbers)[0], previous);
    times.push_back(previous);
  }
  return times;
}

}  // namespace nvm::io
