// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <nanobind/nanobind.h>

#include <mutex>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "nvm/map/view_direction.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "options.hpp"
#include "threads.hpp"

namespace nvm::python {

namespace {

using namespace nb::literals;

constexpr char kEstimatorDoc[] = R"(Estimates the normals of scans.

Keeps its buffers from scan to scan. The neighbourhood of a point is a ball whose radius grows with
the range, from min_radius to max_radius. Threads may share an estimator: they wait for each other.)";

constexpr char kEstimateDoc[] = R"(Estimate the normals of a scan.

Parameters
----------
points : (N, 3) float
    [m], in any frame.
viewpoint : (3,) or (N, 3) float
    Where the sensor was [m], in the frame of the points: once, or for each point of a deskewed scan.
threads : int
    0: all cores, for scans that are worth it. The result does not depend on it.

Returns
-------
NormalResult)";

constexpr char kFunctionDoc[] = R"(Estimate the normals of one scan.

Parameters
----------
points : (N, 3) float
    [m], in any frame.
viewpoint : (3,) or (N, 3) float
    Where the sensor was [m], in the frame of the points: once, or for each point of a deskewed scan.
**options
    Those of `NormalEstimator`, as in ``max_radius=1.0``.

Returns
-------
(N, 3) float32
    Unit vectors that look back at the viewpoint; zero where there is none. `NormalEstimator` says
    why.)";

constexpr char kNormalResultDoc[] = R"(Normals of a scan, row by row of its points.

Attributes
----------
normals : (N, 3) float32
    Unit vectors that look back at the viewpoint; zero unless the status is 0.
plane_offsets : (N,) float32
    [m], signed: ``points + plane_offsets[:, None] * normals`` lie on the planes of their
    neighbourhoods.
plane_variances : (N,) float32
    [m^2], mean squared distance of the neighbours to that plane.
status : (N,) uint8
    Places in `STATUS`: why there is no normal.
STATUS : tuple of str)";

constexpr char kViewDirectionsDoc[] = R"(The directions from points to the sensor, as unit vectors.

A stand-in for normals where there are none: they tell the two faces of a wall apart, because a
sensor sees only faces that look at it.

Parameters
----------
points : (N, 3) float
    [m].
origin : (3,) float
    Where the sensor was [m], in the frame of the points.

Returns
-------
(N, 3) float32
    Zero for a point at the origin, or one that is not finite.)";

struct Estimator {
  explicit Estimator(const NormalOptions& options) : estimator(options) {}

  NormalEstimator estimator;
  std::mutex mutex;
};

/// One point as often as it is asked for, or one per point.
NormalResult estimate(
    Estimator& self, nb::handle points, nb::handle viewpoint, const Integer& threads) {
  constexpr std::size_t kWorthThreads = 4096;
  const Vectors positions(points, "points");
  const Executor executor = make_executor(threads, positions.size(), kWorthThreads);
  const auto run = [&](const auto& viewpoints) -> NormalResult {
    const nb::gil_scoped_release no_gil;
    const std::lock_guard lock(self.mutex);
    return self.estimator.estimate(positions, viewpoints, executor);
  };
  const nb::object array = as_array(viewpoint, "viewpoint");
  if (nb::cast<int>(array.attr("ndim")) != 2) {
    return run(vector_from(array, "viewpoint"));
  }
  const Vectors viewpoints(array, "viewpoint");
  require_same_size(viewpoints.size(), "viewpoint", positions.size(), "points");
  return run(viewpoints);
}

Array<float> estimate_normals(nb::handle points, nb::handle viewpoint, const nb::kwargs& options) {
  Estimator estimator(options_from<NormalOptions>(options));
  return to_array(estimate(estimator, points, viewpoint, {nb::int_(0)}).normals);
}

Array<float> directions(nb::handle points, nb::handle origin) {
  const Vectors positions(points, "points");
  const Eigen::Vector3d sensor = vector_from(origin, "origin");
  std::vector<Eigen::Vector3f> found(positions.size());
  {
    const nb::gil_scoped_release no_gil;
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i] = view_direction(positions[i], sensor);
    }
  }
  return to_array(found);
}

Array<std::uint8_t> status_of(const NormalResult& result) {
  std::vector<std::uint8_t> values;
  values.reserve(result.status.size());
  for (const NormalStatus status : result.status) {
    values.push_back(static_cast<std::uint8_t>(status));
  }
  return to_array(std::move(values));
}

void bind_result(nb::module_& module) {
  constexpr auto kCopy = nb::rv_policy::automatic;
  nb::class_<NormalResult> result(module, "NormalResult", kNormalResultDoc);
  result
      .def_prop_ro(
          "normals", [](const NormalResult& self) { return to_array(self.normals); }, kCopy)
      .def_prop_ro(
          "plane_offsets",
          [](const NormalResult& self) { return to_array(self.plane_offsets); },
          kCopy)
      .def_prop_ro(
          "plane_variances",
          [](const NormalResult& self) { return to_array(self.plane_variances); },
          kCopy)
      .def_prop_ro("status", &status_of, kCopy);
  result.attr("STATUS") = nb::make_tuple(
      "valid",
      "non_finite",
      "too_near",
      "too_far",
      "far_origin",
      "few_neighbors",
      "line_like",
      "not_planar");
}

}  // namespace

void bind_normals(nb::module_& module) {
  bind_result(module);
  nb::class_<Estimator>(module, "NormalEstimator", documented<NormalOptions>(kEstimatorDoc))
      .def(
          "__init__",
          [](Estimator* self, const nb::kwargs& options) {
            new (self) Estimator(options_from<NormalOptions>(options));
          },
          "options"_a)
      .def_prop_ro(
          "options",
          [](const Estimator& self) { return to_dict(self.estimator.options()); },
          "dict: the options that it was made with.")
      .def(
          "estimate",
          &estimate,
          "points"_a.none(),
          "viewpoint"_a.none() = nb::make_tuple(0.0, 0.0, 0.0),
          nb::kw_only(),
          "threads"_a = 0,
          kEstimateDoc);
  module.def(
      "estimate_normals",
      &estimate_normals,
      "points"_a.none(),
      "viewpoint"_a.none() = nb::make_tuple(0.0, 0.0, 0.0),
      "options"_a,
      kFunctionDoc);
  module.def(
      "view_directions", &directions, "points"_a.none(), "origin"_a.none(), kViewDirectionsDoc);
}

}  // namespace nvm::python
