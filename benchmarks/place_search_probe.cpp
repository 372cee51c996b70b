// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// How often the place of a scan is found in the map of a shipped scene, and how often a wrong one
// is claimed: the map is made of the scene's route at true poses, or MAP that a run has left, whose
// frame lies at x, y, z, yaw in the scene; the scans are made at random places and headings where a
// person can stand.
//   nvm_place_search_probe [SCENE] [SENSOR] [STARTS] [SEED] [MAP X Y Z YAW]
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "lio/pipeline/pipeline_options.hpp"
#include "lio/place/place_search.hpp"
#include "lio/scan/deskew.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "sim/lidar.hpp"
#include "sim/scene_file.hpp"
#include "sim/simulation.hpp"
#include "support/cpu_seconds.hpp"

namespace {

using nvm::Pose;
namespace lio = nvm::lio;
namespace sim = nvm::sim;

struct Setup {
  const sim::Scene& scene;
  const sim::RayCaster& rays;
  const sim::SensorModel& sensor;
  const sim::SimulationOptions& options;
};

struct PreparedScan {
  std::vector<Eigen::Vector3f> points, normals;
  Pose T_world_lidar = Pose::Identity();
};

/// A scan deskewed by the true motion, with its normals.
class Scanner {
 public:
  explicit Scanner(const lio::PipelineOptions& options)
      : returns_(options.inertial.returns), normals_(options.inertial.normals) {}

  PreparedScan prepare(const sim::Lidar& lidar, const sim::Motion& motion, std::size_t index) {
    const nvm::Scan scan = lidar.scan(index).scan;
    lio::NavState end;
    end.time = scan.t_end;
    end.T_world_body = motion.pose(scan.t_end);
    end.T_body_lidar = lidar.extrinsic();
    std::vector<lio::MotionSegment> segments;
    constexpr int kSegments = 20;
    for (int i = 0; i <= kSegments; ++i) {
      const double time = scan.t_begin + (scan.t_end - scan.t_begin) * i / kSegments;
      const sim::Kinematics now = motion.kinematics(time);
      lio::MotionSegment segment{};
      segment.time = time;
      segment.T_world_body = now.T_world_imu;
      segment.velocity = now.velocity;
      segment.acceleration = now.acceleration;
      segment.rate = now.angular_velocity;
      segments.push_back(segment);
    }
    lio::deskew(scan, segments, end, returns_, deskewed_);
    const nvm::NormalResult& result = normals_.estimate(deskewed_.points, deskewed_.viewpoints);
    return {deskewed_.points, result.normals, end.T_world_body * lidar.extrinsic()};
  }

 private:
  lio::ReturnLimits returns_;
  nvm::NormalEstimator normals_;
  lio::DeskewedScan deskewed_;
};

nvm::VoxelMap map_of(const Setup& setup, Scanner& scanner, const nvm::MapOptions& options) {
  constexpr std::size_t kStep = 5;  // scans, so that the map takes seconds
  const sim::Motion motion(setup.scene.route, setup.options.motion, 1, 0.0);
  const sim::Lidar lidar(setup.sensor, setup.options.lidar, {setup.scene, setup.rays, motion}, 1);
  nvm::VoxelMap map(options);
  const auto scans = static_cast<std::size_t>(motion.duration() * setup.options.lidar.scan_rate);
  for (std::size_t i = 0; i < scans; i += kStep) {
    const PreparedScan scan = scanner.prepare(lidar, motion, i);
    map.insert(scan.points, scan.normals, scan.T_world_lidar);
  }
  return map;
}

/// Whether nothing is nearer than `clearance` [m] around a person's head, hips and knees.
bool is_free(const sim::RayCaster& rays, const Eigen::Vector3d& feet, double clearance) {
  constexpr int kDirections = 24;
  for (const double height : {0.3, 0.7, 1.3}) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 6.283185307179586 * i / kDirections;
      const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
      if (rays.cast(feet + Eigen::Vector3d(0.0, 0.0, height), direction, clearance)) {
        return false;
      }
    }
  }
  return true;
}

/// A place on the floor of the scene's route, and a step in a random direction.
sim::Route random_start(const Setup& setup, std::mt19937_64& random) {
  Eigen::Vector3d min = setup.scene.route.waypoints.front();
  Eigen::Vector3d max = min;
  for (const Eigen::Vector3d& waypoint : setup.scene.route.waypoints) {
    min = min.cwiseMin(waypoint);
    max = max.cwiseMax(waypoint);
  }
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  sim::Route route;
  for (;;) {
    const Eigen::Vector3d feet(
        min.x() + unit(random) * (max.x() - min.x()),
        min.y() + unit(random) * (max.y() - min.y()),
        min.z());
    constexpr double kClearance = 0.4;  // [m]
    if (is_free(setup.rays, feet, kClearance)) {
      const double heading = 6.283185307179586 * unit(random);
      route.waypoints = {
          feet, feet + 0.3 * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0)};
      return route;
    }
  }
}

/// The pose that x, y, z and yaw tell.
Pose frame_at(char** arguments) {
  Pose T_world_map = Pose::Identity();
  T_world_map.translation() << std::atof(arguments[0]), std::atof(arguments[1]),
      std::atof(arguments[2]);
  T_world_map.linear() = nvm::so3_exp({0.0, 0.0, std::atof(arguments[3])});
  return T_world_map;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string scene_name = argc > 1 ? argv[1] : "office";
  const std::string sensor_name = argc > 2 ? argv[2] : "mid360";
  const int starts = argc > 3 ? std::atoi(argv[3]) : 100;
  const auto seed = static_cast<std::uint64_t>(argc > 4 ? std::atoll(argv[4]) : 1);
  const sim::Scene scene = sim::load_scene(scene_name);
  const sim::RayCaster rays(scene);
  const sim::SimulationOptions options = sim::options_for(sensor_name);
  const Setup setup{scene, rays, sim::find_sensor(sensor_name), options};
  const lio::PipelineOptions pipeline;
  Scanner scanner(pipeline);
  const bool is_given = argc > 9;
  const nvm::VoxelMap map =
      is_given ? nvm::load_map(argv[5]) : map_of(setup, scanner, pipeline.map);
  const Pose T_world_map = is_given ? frame_at(argv + 6) : Pose::Identity();
  lio::PlaceSearch search(map, nvm::Executor(1));
  std::printf("%s, %s: %zu map points\n", scene_name.c_str(), sensor_name.c_str(), map.size());
  std::mt19937_64 random(seed);
  int found = 0, wrong = 0, refused = 0;
  std::vector<double> times;
  for (int i = 0; i < starts; ++i) {
    const sim::Route route = random_start(setup, random);
    const std::uint64_t luck = random();
    const sim::Motion motion(route, options.motion, luck, 0.5);
    const sim::Lidar lidar(setup.sensor, options.lidar, {scene, rays, motion}, luck);
    const PreparedScan scan = scanner.prepare(lidar, motion, 0);
    const double begin = nvm::benchmarks::cpu_seconds();
    const lio::Place place =
        search.anywhere(scan.points, scan.normals, scan.T_world_lidar.linear().transpose().col(2));
    times.push_back(nvm::benchmarks::cpu_seconds() - begin);
    const Pose error = (T_world_map * place.T_map_scan).inverse() * scan.T_world_lidar;
    const double distance = error.translation().norm();
    const bool is_right = distance < 0.1;
    const Eigen::Vector3d at = scan.T_world_lidar.translation();
    found += place.is_found() && is_right;
    wrong += place.is_found() && !is_right;
    refused += !place.is_found();
    std::printf(
        "%3d at %6.2f %6.2f  %s  off %.3f share %.3f cost %.4f  %.2f s %s\n",
        i,
        at.x(),
        at.y(),
        !place.is_found() ? "refused"
        : is_right        ? "found  "
                          : "WRONG  ",
        distance,
        place.share,
        place.cost,
        times.back(),
        place.why_not.c_str());
    std::fflush(stdout);
  }
  std::sort(times.begin(), times.end());
  std::printf(
      "%d starts: %d found, %d wrong, %d refused; CPU median %.2f s, largest %.2f s\n",
      starts,
      found,
      wrong,
      refused,
      times[times.size() / 2],
      times.back());
}
