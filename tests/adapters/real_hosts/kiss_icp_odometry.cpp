// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// kiss_icp_odometry MAP SEQUENCE RESULT: KISS-ICP on an nvm sequence. Compiled twice, with the
// host's own VoxelHashMap.hpp (MAP: own) and with nvm's in its place (MAP: transparent or nvm).
#include <ctime>
#include <iostream>
#include <kiss_icp/pipeline/KissICP.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "nvm/normal/normal_estimator.hpp"
#include "nvm_sequence.hpp"

namespace {

using real_hosts::Result;
using real_hosts::Scan;

constexpr double kVoxel = 0.5;      // [m]
constexpr double kMaxRange = 60.0;  // [m]

template <class Map, class = void>
struct IsNvm : std::false_type {};
template <class Map>
struct IsNvm<Map, std::void_t<decltype(std::declval<Map&>().make_transparent())>> : std::true_type {
};

/// False when this program was not compiled for the map of that name.
template <class Map>
bool choose(Map& map, const std::string& kind) {
  if constexpr (IsNvm<Map>::value) {
    if (kind == "transparent") {
      map.make_transparent();
    }
    return kind != "own";
  } else {
    return kind == "own";
  }
}

Eigen::Isometry3d to_isometry(const Sophus::SE3d& pose) {
  Eigen::Isometry3d T;
  T.matrix() = pose.matrix();
  return T;
}

Result run(kiss_icp::pipeline::KissICP& host, const std::vector<Scan>& scans) {
  Result result;
  nvm::NormalEstimator estimator;  // for the map that is judged: the host has no normals
  for (std::size_t i = 0; i < scans.size(); ++i) {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> times;
    for (const real_hosts::Point& p : scans[i].points) {
      points.emplace_back(Eigen::Vector3f(p.x, p.y, p.z).cast<double>());
      times.push_back(p.dt);
    }
    const std::clock_t start = std::clock();
    const auto& [deskewed, source] = host.RegisterFrame(points, times);
    result.cpu_seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const Eigen::Isometry3d T = to_isometry(host.pose());
    result.poses.push_back(T);
    std::vector<Eigen::Vector3d> some;
    for (std::size_t j = i % 20; j < deskewed.size(); j += 20) {
      some.push_back(deskewed[j]);
    }
    const nvm::NormalResult& found =
        estimator.estimate_at(some, deskewed, Eigen::Vector3d(Eigen::Vector3d::Zero()));
    for (std::size_t j = 0; j < some.size(); ++j) {
      result.add_to_map(T, some[j], found.normals[j].cast<double>());
    }
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc == 4 ? argv[1] : "";
  kiss_icp::pipeline::KISSConfig config;
  config.voxel_size = kVoxel;
  config.max_range = kMaxRange;
  config.max_num_threads = 1;
  kiss_icp::pipeline::KissICP host(config);
  if (argc != 4 || !choose(host.VoxelMap(), kind)) {
    std::cerr << "usage: kiss_icp_odometry own|transparent|nvm SEQUENCE RESULT\n";
    return 2;
  }
  const std::vector<Scan> scans = real_hosts::read_scans(argv[2]);
  const Result result = run(host, scans);
  real_hosts::write(result, scans, real_hosts::read_extrinsic(argv[2]), argv[3]);
  real_hosts::print_time(kind, result);
}
