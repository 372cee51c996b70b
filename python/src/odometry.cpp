// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "config/schema.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/sighting.hpp"
#include "odometry_docs.hpp"
#include "settings.hpp"
#include "shared_map.hpp"
#include "timed_scan.hpp"

namespace nvm::python {

namespace {

using namespace nb::literals;

/// Settings of `nvm run`: a path of YAML, or a dict of sections or of "section.key".
lio::PipelineOptions options_from(const nb::object& config) {
  lio::PipelineOptions options;
  config::Schema schema;
  lio::bind(schema, options);
  if (!nb::isinstance<nb::dict>(config)) {
    if (!config.is_none()) {
      schema.read_file(path_from(config));
    }
    return options;
  }
  nb::dict sections;
  std::vector<std::string> assignments;
  for (const auto& [key, value] : nb::cast<nb::dict>(config)) {
    const std::string name = nb::str(key).c_str();
    if (name.find('.') == std::string::npos) {
      sections[key] = value;
    } else {
      assignments.push_back(name + "=" + as_json(value));
    }
  }
  schema.read_text(as_json(sections), "config");
  for (const std::string& assignment : assignments) {
    schema.set(assignment);
  }
  return options;
}

/// A pipeline that learns whether there is an IMU before its first scan.
class Odometry {
 public:
  Odometry(const nb::object& config, nb::handle T_imu_lidar)
      : options_(options_from(config)), has_extrinsic_(!T_imu_lidar.is_none()) {
    options_.inertial.T_imu_lidar = pose_from(T_imu_lidar, "T_imu_lidar");
    make(true);  // so that bad options are told here
  }

  void add_imu(nb::handle times, nb::handle gyro, nb::handle accel) {
    const std::vector<ImuSample> samples = imu_samples(times, gyro, accel);
    const nb::gil_scoped_release no_gil;
    const std::lock_guard lock(mutex_);
    if (is_alone_ && !samples.empty()) {
      throw std::runtime_error(
          "nvm: the first scan came before any IMU reading, so that poses come from scans alone: "
          "add readings before scans, or say so with {'pipeline': 'lidar_only'}");
    }
    for (const ImuSample& sample : samples) {
      pipeline_->add_imu(sample);
    }
    has_imu_ = has_imu_ || !samples.empty();
  }

  double imu_needed_until(double time) const {
    const nb::gil_scoped_release no_gil;
    const std::lock_guard lock(mutex_);
    return pipeline_->imu_needed_until(time);
  }

  lio::FrameResult add_scan(const Scan& scan) {
    const nb::gil_scoped_release no_gil;
    const std::lock_guard lock(mutex_);
    if (!is_started_ && !has_imu_ && options_.type == lio::PipelineType::kAutomatic) {
      make(false);
      is_alone_ = true;
    }
    is_started_ = true;
    return pipeline_->process(scan);
  }

  SharedMap* map() const {
    const nb::gil_scoped_release no_gil;
    const std::lock_guard lock(mutex_);
    const VoxelMap* map = pipeline_->map().voxel_map();
    if (map == nullptr) {
      throw std::runtime_error("nvm: a map of this map.type is no VoxelMap");
    }
    return new SharedMap(MapArchive::read(MapArchive::write(*map)));  // Python owns it
  }

  std::vector<std::string> findings() const {
    const nb::gil_scoped_release no_gil;
    const std::lock_guard lock(mutex_);
    std::vector<std::string> findings = pipeline_->findings();
    const bool uses_imu =
        has_imu_ && lio::resolve(options_.type, true) != lio::PipelineType::kLidarOnly;
    if (uses_imu && !has_extrinsic_) {
      findings.insert(
          findings.begin(),
          "T_imu_lidar was not given: the LiDAR is taken to sit in the IMU, which costs "
          "centimetres "
          "where it does not; give Odometry the pose that maps LiDAR to IMU coordinates");
    }
    return findings;
  }

  nb::tuple scan() const {
    std::vector<Eigen::Vector3f> points, normals;
    {
      const nb::gil_scoped_release no_gil;
      const std::lock_guard lock(mutex_);
      points = pipeline_->scan().points;
      normals = pipeline_->normals();
    }
    std::transform(normals.begin(), normals.end(), normals.begin(), plane_normal);
    normals.resize(points.size(), Eigen::Vector3f::Zero());
    return nb::make_tuple(to_array(points), to_array(normals));
  }

  nb::object scan_intensity() const {
    std::vector<float> intensities;
    {
      const nb::gil_scoped_release no_gil;
      const std::lock_guard lock(mutex_);
      for (const PointValues& values : pipeline_->scan().values) {
        intensities.push_back(values.intensity);
      }
    }
    return nb::cast(to_array(std::move(intensities)));
  }

 private:
  void make(bool has_imu) {
    lio::PipelineOptions resolved = options_;
    resolved.type = lio::resolve(options_.type, has_imu);
    pipeline_ = lio::make_pipeline(resolved);
  }

  lio::PipelineOptions options_;
  bool has_extrinsic_;
  std::unique_ptr<lio::Pipeline> pipeline_;
  mutable std::mutex mutex_;
  bool has_imu_ = false;
  bool is_started_ = false;
  bool is_alone_ = false;  // automatically: no IMU reading came before the first scan
};

nb::dict times_of(const lio::FrameResult& frame) {
  nb::dict times;
  times["deskew"] = frame.times.deskew;
  times["normals"] = frame.times.normals;
  times["optimize"] = frame.times.optimize;
  times["map_update"] = frame.times.map_update;
  return times;
}

nb::object vector_of(const Eigen::Vector3d& v) {
  return nb::cast(to_array(std::vector<double>{v.x(), v.y(), v.z()}));
}

nb::object directions_of(const std::vector<Eigen::Vector3d>& directions) {
  std::vector<double> rows;
  for (const Eigen::Vector3d& d : directions) {
    rows.insert(rows.end(), {d.x(), d.y(), d.z()});
  }
  return nb::cast(to_array(std::move(rows), 3));
}

nb::object matrix_of(const lio::Covariance6& covariance) {
  return nb::cast(to_array(std::vector<double>(covariance.data(), covariance.data() + 36), 6));
}

void bind_frame(nb::module_& module) {
  using Frame = lio::FrameResult;
  nb::class_<Frame>(module, "FrameResult", kFrameDoc)
      .def_prop_ro("status", [](const Frame& self) { return lio::name(self.status); })
      .def_ro("time", &Frame::time)
      .def_prop_ro("T_map_body", [](const Frame& self) { return to_array(self.T_map_body); })
      .def_prop_ro("T_map_lidar", [](const Frame& self) { return to_array(self.T_map_lidar); })
      .def_prop_ro("velocity", [](const Frame& self) { return vector_of(self.velocity); })
      .def_prop_ro("angular_rate", [](const Frame& self) { return vector_of(self.angular_rate); })
      .def_prop_ro(
          "pose_covariance", [](const Frame& self) { return matrix_of(self.pose_covariance); })
      .def_prop_ro(
          "twist_covariance", [](const Frame& self) { return matrix_of(self.twist_covariance); })
      .def_ro("points", &Frame::points)
      .def_ro("keypoints", &Frame::keypoints)
      .def_ro("residuals", &Frame::residuals)
      .def_ro("inlier_share", &Frame::inlier_share)
      .def_ro("residual_rms", &Frame::residual_rms)
      .def_ro("degenerate_directions", &Frame::degenerate_directions)
      .def_prop_ro(
          "unobserved_translations",
          [](const Frame& self) { return directions_of(self.unobserved.translations); })
      .def_prop_ro(
          "unobserved_rotations",
          [](const Frame& self) { return directions_of(self.unobserved.rotations); })
      .def_ro("iterations", &Frame::iterations)
      .def_ro("inserted", &Frame::inserted)
      .def_prop_ro("times_ms", &times_of)
      .def_ro("message", &Frame::message)
      .def("__repr__", [](const Frame& self) {
        return std::string("FrameResult(status='") + lio::name(self.status) +
               "', time=" + nb::repr(nb::cast(self.time)).c_str() + ")";
      });
}

}  // namespace

void bind_odometry(nb::module_& module) {
  bind_frame(module);
  nb::class_<Odometry>(module, "Odometry", kOdometryDoc)
      .def(
          nb::init<const nb::object&, nb::handle>(),
          "config"_a = nb::none(),
          "T_imu_lidar"_a = nb::none())
      .def(
          "add_imu",
          &Odometry::add_imu,
          "times"_a.none(),
          "gyro"_a.none(),
          "accel"_a.none(),
          kAddImuDoc)
      .def("imu_needed_until", &Odometry::imu_needed_until, "time"_a, kImuNeededDoc)
      .def(
          "register",
          [](Odometry& self,
             nb::handle points,
             nb::handle times,
             nb::handle begin,
             nb::handle end,
             nb::handle intensity) {
            return self.add_scan(timed_scan(points, times, begin, end, intensity));
          },
          "points"_a.none(),
          "times"_a.none(),
          "begin"_a = nb::none(),
          "end"_a = nb::none(),
          nb::kw_only(),
          "intensity"_a = nb::none(),
          kRegisterDoc)
      .def("register", &Odometry::add_scan, "scan"_a, "A Scan, which `ScanStream.convert` gives.")
      .def("findings", &Odometry::findings, kFindingsDoc)
      .def_prop_ro("scan", &Odometry::scan, kScanDoc)
      .def_prop_ro(
          "scan_intensity",
          &Odometry::scan_intensity,
          "float32 (N,): what `scan`'s points returned, as the sensor gives it; 0 where it does "
          "not.")
      .def_prop_ro(
          "map", &Odometry::map, nb::rv_policy::take_ownership, "VoxelMap: a copy of the map.");
}

}  // namespace nvm::python
