// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// What the programs of this folder read, an nvm sequence, and what they write for `nvm evaluate`:
// trajectory.tum and map.ply.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace real_hosts {

struct Point {
  float x, y, z, intensity, dt;
  std::uint16_t ring, padding;
};
static_assert(sizeof(Point) == 24);

struct Scan {
  double begin, end;
  std::vector<Point> points;
};

/// What a host made of a sequence, in the frame of its first scan.
struct Result {
  std::vector<Eigen::Isometry3d> poses;          // of the sensor at the ends of the scans
  std::vector<Eigen::Matrix<double, 6, 1>> map;  // points and normals, of all scans
  double cpu_seconds = 0.0;                      // of registration and insertion

  void add_to_map(
      const Eigen::Isometry3d& T, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    map.emplace_back();
    map.back() << T * point, T.linear() * normal;
  }
};

inline std::vector<Scan> read_scans(const std::filesystem::path& folder) {
  std::vector<Scan> scans;
  std::ifstream table(folder / "scans.csv");
  std::string line;
  std::getline(table, line);  // names
  while (std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::size_t index = 0;
    std::string file;
    Scan scan;
    fields >> index >> scan.begin >> scan.end >> file;
    std::ifstream data(folder / file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(data), {}};
    scan.points.resize(bytes.size() / sizeof(Point));
    std::copy_n(
        bytes.data(),
        scan.points.size() * sizeof(Point),
        reinterpret_cast<char*>(scan.points.data()));
    scans.push_back(std::move(scan));
  }
  return scans;
}

inline Eigen::Isometry3d read_extrinsic(const std::filesystem::path& folder) {
  const auto meta = nlohmann::json::parse(std::ifstream(folder / "meta.json"));
  const auto t = meta.at("T_imu_lidar").at("translation").get<std::vector<double>>();
  const auto q = meta.at("T_imu_lidar").at("quaternion_xyzw").get<std::vector<double>>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(t[0], t[1], t[2]);
  T.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  return T;
}

inline void write_trajectory(
    const Result& result,
    const std::vector<Scan>& scans,
    const Eigen::Isometry3d& T_imu_lidar,
    const std::filesystem::path& file) {
  std::ofstream trajectory(file);
  trajectory.precision(12);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Eigen::Isometry3d T = T_imu_lidar * result.poses[i] * T_imu_lidar.inverse();
    const Eigen::Quaterniond q(T.linear());
    trajectory << scans[i].end << ' ' << T.translation().transpose() << ' ' << q.x() << ' ' << q.y()
               << ' ' << q.z() << ' ' << q.w() << '\n';
  }
}

inline void write_map(
    const Result& result, const Eigen::Isometry3d& T_imu_lidar, const std::filesystem::path& file) {
  std::ofstream map(file);
  map << "ply\nformat ascii 1.0\nelement vertex " << result.map.size() << '\n';
  for (const char* field : {"x", "y", "z", "nx", "ny", "nz"}) {
    map << "property float " << field << '\n';
  }
  map << "end_header\n";
  for (const auto& point : result.map) {
    const Eigen::Vector3d position = T_imu_lidar * Eigen::Vector3d(point.head<3>());
    map << position.transpose() << ' ' << (T_imu_lidar.linear() * point.tail<3>()).transpose()
        << '\n';
  }
}

inline void write(
    const Result& result,
    const std::vector<Scan>& scans,
    const Eigen::Isometry3d& T_imu_lidar,
    const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_trajectory(result, scans, T_imu_lidar, folder / "trajectory.tum");
  write_map(result, T_imu_lidar, folder / "map.ply");
}

inline void print_time(const std::string& kind, const Result& result) {
  std::cout << kind << ": " << result.poses.size() << " scans, "
            << 1e3 * result.cpu_seconds / static_cast<double>(result.poses.size())
            << " ms of CPU per scan for registration and insertion\n";
}

}  // namespace real_hosts
