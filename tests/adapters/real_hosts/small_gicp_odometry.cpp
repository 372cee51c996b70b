// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// small_gicp_odometry MAP SEQUENCE RESULT: scan-to-map odometry of small_gicp on an nvm sequence,
// with its own incremental map or with nvm's behind the same registration. MAP is own, transparent
// or nvm. Writes what `nvm evaluate` reads: trajectory.tum, map.ply.
#include <algorithm>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <small_gicp/ann/flat_container.hpp>
#include <small_gicp/ann/incremental_voxelmap.hpp>
#include <small_gicp/factors/plane_icp_factor.hpp>
#include <small_gicp/points/point_cloud.hpp>
#include <small_gicp/registration/reduction.hpp>
#include <small_gicp/registration/registration.hpp>
#include <small_gicp/util/downsampling.hpp>
#include <small_gicp/util/normal_estimation.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "adapters/small_gicp/plane_factor.hpp"

namespace {

using small_gicp::PointCloud;
using OwnMap = small_gicp::IncrementalVoxelMap<small_gicp::FlatContainerNormal>;
using nvm::adapters::NormalConsistentPlaneFactor;

constexpr double kLeaf = 0.15;  // [m], of the scan
constexpr double kVoxel = 0.5;  // [m], of both maps
constexpr int kPointsPerVoxel = 20;
constexpr double kMinDistance = 0.1;  // [m], of stored points

struct Point {
  float x, y, z, intensity, dt;
  std::uint16_t ring, padding;
};
static_assert(sizeof(Point) == 24);

struct Scan {
  double begin, end;
  std::vector<Point> points;
};

std::vector<Scan> read_scans(const std::filesystem::path& folder) {
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

/// The points in the sensor's frame at the end of the scan, were its motion `step` per scan.
PointCloud::Ptr deskew(const Scan& scan, const Eigen::Isometry3d& step) {
  const auto cloud = std::make_shared<PointCloud>();
  cloud->resize(scan.points.size());
  const Eigen::AngleAxisd turn(step.linear());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Point& p = scan.points[i];
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

struct Result {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Eigen::Matrix<double, 6, 1>> map;  // points and normals, of all scans
  double cpu_seconds = 0.0;                      // of registration and insertion
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
      result.map.emplace_back();
      result.map.back() << (T * cloud->point(j)).head<3>(), T.linear() * cloud->normal(j).head<3>();
    }
  }
  return result;
}

Eigen::Isometry3d read_extrinsic(const std::filesystem::path& folder) {
  const auto meta = nlohmann::json::parse(std::ifstream(folder / "meta.json"));
  const auto t = meta.at("T_imu_lidar").at("translation").get<std::vector<double>>();
  const auto q = meta.at("T_imu_lidar").at("quaternion_xyzw").get<std::vector<double>>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(t[0], t[1], t[2]);
  T.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  return T;
}

void write(
    const Result& result,
    const std::vector<Scan>& scans,
    const Eigen::Isometry3d& T_imu_lidar,
    const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream trajectory(folder / "trajectory.tum");
  trajectory.precision(12);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Eigen::Isometry3d T = T_imu_lidar * result.poses[i] * T_imu_lidar.inverse();
    const Eigen::Quaterniond q(T.linear());
    trajectory << scans[i].end << ' ' << T.translation().transpose() << ' ' << q.x() << ' ' << q.y()
               << ' ' << q.z() << ' ' << q.w() << '\n';
  }
  std::ofstream map(folder / "map.ply");
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: small_gicp_odometry own|transparent|nvm SEQUENCE RESULT\n";
    return 2;
  }
  const std::string kind = argv[1];
  const std::vector<Scan> scans = read_scans(argv[2]);
  Result result;
  if (kind == "own") {
    Own host;
    result = run(host, scans);
  } else {
    Nvm host(kind == "nvm");
    result = run(host, scans);
  }
  write(result, scans, read_extrinsic(argv[2]), argv[3]);
  std::cout << kind << ": " << scans.size() << " scans, "
            << 1e3 * result.cpu_seconds / static_cast<double>(scans.size())
            << " ms of CPU per scan for registration and insertion\n";
}
