// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// small_gicp_odometry MAP SEQUENCE RESULT: scan-to-map odometry of small_gicp on an nvm sequence,
// with its own incremental map or with nvm's behind the same registration. MAP is own, transparent
// or nvm. Writes what `nvm evaluate` reads: trajectory.tum, map.ply.
#include <ctime>
#include <iostream>
#include <memory>
#include <small_gicp/ann/flat_container.hpp>
#include <small_gicp/ann/incremental_voxelmap.hpp>
#include <small_gicp/factors/plane_icp_factor.hpp>
#include <small_gicp/points/point_cloud.hpp>
#include <small_gicp/registration/reduction.hpp>
#include <small_gicp/registration/registration.hpp>
#include <small_gicp/util/downsampling.hpp>
#include <small_gicp/util/normal_estimation.hpp>
#include <string>
#include <vector>

#include "adapters/small_gicp/plane_factor.hpp"
#include "nvm_sequence.hpp"

namespace {

using real_hosts::Result;
using real_hosts::Scan;
using small_gicp::PointCloud;
using OwnMap = small_gicp::IncrementalVoxelMap<small_gicp::FlatContainerNormal>;
using nvm::adapters::NormalConsistentPlaneFactor;

constexpr double kLeaf = 0.15;  // [m], of the scan
constexpr double kVoxel = 0.5;  // [m], of both maps
constexpr int kPointsPerVoxel = 20;
constexpr double kMinDistance = 0.1;  // [m], of stored points

/// The points in the sensor's frame at the end of the scan, were its motion `step` per scan.
PointCloud::Ptr deskew(const Scan& scan, const Eigen::Isometry3d& step) {
  const auto cloud = std::make_shared<PointCloud>();
  cloud->resize(scan.points.size());
  const Eigen::AngleAxisd turn(step.linear());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const real_hosts::Point& p = scan.points[i];
    const double left = p.dt / (scan.end - scan.begin) - 1.0;  // of the scan, -1 to 0
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(left * turn.angle(), turn.axis()).toRotationMatrix();
    const Eigen::Vector3d raw = Eigen::Vector3f(p.x, p.y, p.z).cast<double>();
    cloud->point(i) << R * raw + left * (step.linear().transpose() * step.translation()), 1.0;
  }
  return cloud;
}

/// small_gicp's own map and factor.
struct Own {
  OwnMap map{kVoxel};
  small_gicp::Registration<small_gicp::PointToPlaneICPFactor, small_gicp::SerialReduction>
      registration;

  Own() {
    map.voxel_setting.max_num_points_in_cell = kPointsPerVoxel;
    map.voxel_setting.min_sq_dist_in_cell = kMinDistance * kMinDistance;
    map.set_search_offsets(27);
  }
  void insert(const PointCloud& cloud, const Eigen::Isometry3d& T) { map.insert(cloud, T); }
};

/// nvm's map behind the same registration.
struct Nvm {
  nvm::VoxelMap map;
  small_gicp::Registration<NormalConsistentPlaneFactor, small_gicp::SerialReduction> registration;

  explicit Nvm(bool gated) : map(options(gated)) {
    registration.point_factor.source_normal =
        gated ? nvm::adapters::SourceNormal::kPoint : nvm::adapters::SourceNormal::kNone;
  }
  static nvm::MapOptions options(bool gated) {
    nvm::MapOptions options;
    options.voxel_size = kVoxel;
    options.min_point_distance = kMinDistance;
    options.points_per_surface = kPointsPerVoxel;
    options.max_surfaces = gated ? 2 : 1;
    return options;
  }
  void insert(const PointCloud& cloud, const Eigen::Isometry3d& T) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3f> normals;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      points.emplace_back(cloud.point(i).head<3>());
      normals.emplace_back(cloud.normal(i).head<3>().cast<float>());
    }
    map.insert(points, normals, nvm::Pose(T.matrix()));
  }
};

template <class Host>
Result run(Host& host, const std::vector<Scan>& scans) {
  Result result;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  host.registration.rejector.max_dist_sq = kVoxel * kVoxel;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto cloud = small_gicp::voxelgrid_sampling(*deskew(scans[i], step), kLeaf);
    small_gicp::estimate_normals(*cloud, 20);
    const std::clock_t start = std::clock();
    if (i > 0) {
      const Eigen::Isometry3d T_before = T;
      T = host.registration.align(host.map, *cloud, host.map, Eigen::Isometry3d(T * step))
              .T_target_source;
      // Rounding errors of the rotation would double with each prediction.
      T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
      step = T_before.inverse() * T;
    }
    host.insert(*cloud, T);
    result.cpu_seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    result.poses.push_back(T);
    for (std::size_t j = i % 5; j < cloud->size(); j += 5) {
      result.add_to_map(T, cloud->point(j).head<3>(), cloud->normal(j).head<3>());
    }
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: small_gicp_odometry own|transparent|nvm SEQUENCE RESULT\n";
    return 2;
  }
  const std::string kind = argv[1];
  const std::vector<Scan> scans = real_hosts::read_scans(argv[2]);
  Result result;
  if (kind == "own") {
    Own host;
    result = run(host, scans);
  } else {
    Nvm host(kind == "nvm");
    result = run(host, scans);
  }
  real_hosts::write(result, scans, real_hosts::read_extrinsic(argv[2]), argv[3]);
  real_hosts::print_time(kind, result);
}
