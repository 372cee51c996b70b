// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "timed_scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "common/printed.hpp"

namespace nvm::python {

namespace {

/// Throws ValueError for times that lost their digits: float32 tells 2026 to two minutes.
void require_fine(const Numbers& times) {
  constexpr double kMaxSingle = 1e4;  // [s]; float32 steps by 1 ms there
  for (std::size_t i = 0; !times.is_double() && i < times.size(); ++i) {
    if (std::abs(times[i]) > kMaxSingle) {
      throw std::invalid_argument(
          "nvm: times above 10000 s in float32 are too coarse: give float64, or times since begin");
    }
  }
}

double finite_number(nb::handle object, const char* name) {
  double number = 0.0;
  if (!nb::try_cast<double>(object, number) || !std::isfinite(number)) {
    throw std::invalid_argument(std::string("nvm: ") + name + " must be a finite number [s]");
  }
  return number;
}

struct GivenPoint {
  double time;
  Eigen::Vector3d position;
  double intensity;
};

/// The finite points with finite times, by ascending time.
std::vector<GivenPoint> finite_points(
    const Vectors& points, const Numbers& times, const std::optional<Numbers>& intensity) {
  std::vector<GivenPoint> finite;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = points[i];
    if (point.allFinite() && std::isfinite(times[i])) {
      finite.push_back({times[i], point, intensity ? (*intensity)[i] : 0.0});
    }
  }
  std::stable_sort(finite.begin(), finite.end(), [](const GivenPoint& a, const GivenPoint& b) {
    return a.time < b.time;
  });
  return finite;
}

TimedPoint timed_point(const GivenPoint& given, double dt) {
  const Eigen::Vector3d& position = given.position;
  TimedPoint point;
  point.x = static_cast<float>(position.x());
  point.y = static_cast<float>(position.y());
  point.z = static_cast<float>(position.z());
  point.intensity = static_cast<float>(given.intensity);
  point.dt = static_cast<float>(dt);
  return point;
}

/// An array of as many times as there are points, of a number or an array.
nb::object expanded(nb::handle times, const Vectors& points) {
  nb::object array = as_array(times, "times");
  if (nb::cast<int>(array.attr("ndim")) != 0) {
    return array;
  }
  return nb::module_::import_("numpy").attr("full")(points.size(), finite_number(times, "times"));
}

/// As a batch: the rows of `object`, or itself as the only one.
nb::object rows_of(nb::handle object, const char* name, bool is_single) {
  const nb::object array = as_array(object, name);
  return is_single ? nb::object(array.attr("reshape")(1, -1)) : array;
}

}  // namespace

Scan timed_scan(
    nb::handle points, nb::handle times, nb::handle begin, nb::handle end, nb::handle intensity) {
  const Vectors positions(points, "points");
  const Numbers stamps(expanded(times, positions), "times");
  require_same_size(stamps.size(), "times", positions.size(), "points");
  std::optional<Numbers> intensities;
  if (!intensity.is_none()) {
    intensities.emplace(intensity, "intensity");
    require_same_size(intensities->size(), "intensity", positions.size(), "points");
  }
  const std::vector<GivenPoint> finite = finite_points(positions, stamps, intensities);
  const double first = finite.empty() ? 0.0 : finite.front().time;
  const double last = finite.empty() ? 0.0 : finite.back().time;
  Scan scan;
  double origin = 0.0;  // of the times, to make them count from t_begin
  if (begin.is_none()) {
    require_fine(stamps);
    scan.t_begin = origin = first;
    scan.t_end = last;
  } else {
    scan.t_begin = finite_number(begin, "begin");
    scan.t_end = scan.t_begin + last;
  }
  if (!end.is_none()) {
    scan.t_end = finite_number(end, "end");
  }
  constexpr double kRounding = 1e-5;  // [s]
  if (first - origin < 0.0 || scan.t_begin + (last - origin) > scan.t_end + kRounding) {
    throw std::invalid_argument("nvm: times must lie from begin to end");
  }
  constexpr double kLongest = 10.0;  // [s]; 0.1 s in ms are 100
  if (last - first > kLongest) {
    throw std::invalid_argument(printed(
        "nvm: times of one scan span %.6g s: give them in seconds, and one scan at a time",
        last - first));
  }
  scan.points.reserve(finite.size());
  for (const GivenPoint& point : finite) {
    scan.points.push_back(timed_point(point, point.time - origin));
  }
  return scan;
}

std::vector<ImuSample> imu_samples(nb::handle times, nb::handle gyro, nb::handle accel) {
  const nb::object array = as_array(times, "times");
  const bool is_single = nb::cast<int>(array.attr("ndim")) == 0;
  const Numbers stamps(is_single ? nb::object(array.attr("reshape")(1)) : array, "times");
  const Vectors rates(rows_of(gyro, "gyro", is_single), "gyro");
  const Vectors forces(rows_of(accel, "accel", is_single), "accel");
  require_same_size(rates.size(), "gyro", stamps.size(), "times");
  require_same_size(forces.size(), "accel", stamps.size(), "times");
  require_fine(stamps);
  std::vector<ImuSample> samples;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const ImuSample sample{stamps[i], rates[i], forces[i]};
    if (!std::isfinite(sample.time) || !sample.gyro.allFinite() || !sample.accel.allFinite()) {
      throw std::invalid_argument(
          "nvm: row " + std::to_string(i) + " of the IMU readings is not finite: leave it out");
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace nvm::python
