// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <nanobind/nanobind.h>

#include <memory>
#include <mutex>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "nvm/registration/scan_aligner.hpp"
#include "options.hpp"
#include "shared_map.hpp"
#include "threads.hpp"

namespace nvm::python {

namespace {

using namespace nb::literals;

constexpr char kAlignerDoc[] =
    R"(Aligns scans to a map: Gauss-Newton on weighted point-to-plane residuals.

Keeps its buffers from scan to scan. Threads may share an aligner: they wait for each other.)";

constexpr char kAlignDoc[] = R"(Align a scan to a map.

Parameters
----------
map : VoxelMap
points : (N, 3) float
    [m], in the frame scan.
normals : (N, 3) float
    Unit vectors in the frame scan; zero where unknown.
T_map_scan : (4, 4) float, optional
    Where to start; the identity without it.
threads : int
    0: all cores, for scans that are worth it. The result does not depend on it.

Returns
-------
AlignResult)";

constexpr char kAlignResultDoc[] = R"(Outcome of an alignment.

Attributes
----------
T_map_scan : (4, 4) float64
status : str
    'converged', 'max_iterations' (the pose is the last iterate) or 'too_few_residuals' (the pose is
    the start).
iterations : int
inlier_share : float
    Of the points that found their plane, 0 to 1.
rms_distance : float
    Of those to their planes [m].
cost : float
    0 (perfect) to 1 (nothing fits): ranks poses of one scan.
information : (6, 6) float64
    Weighted, of rotation and translation.
observability : (6,) float64
    Ascending.
degenerate_directions : int
    Of the pose's six, that the scan does not tell.)";

struct Aligner {
  explicit Aligner(const AlignOptions& options) : aligner(options) {}

  ScanAligner<VoxelMap> aligner;
  std::mutex mutex;
};

AlignResult align(
    Aligner& self,
    const SharedMap& map,
    nb::handle points,
    nb::handle normals,
    nb::handle T_map_scan,
    const Integer& threads) {
  constexpr std::size_t kWorthThreads = 1024;
  const Vectors positions(points, "points");
  const Vectors directions(normals, "normals");
  require_same_size(directions.size(), "normals", positions.size(), "points");
  const Pose start = pose_from(T_map_scan, "T_map_scan");
  const Executor executor = make_executor(threads, positions.size(), kWorthThreads);
  return map.read([&](const VoxelMap& voxel_map) {
    const std::lock_guard lock(self.mutex);
    return self.aligner.align(voxel_map, positions, directions, start, executor);
  });
}

const char* status_name(const AlignResult& result) {
  switch (result.status) {
    case AlignStatus::kConverged:
      return "converged";
    case AlignStatus::kMaxIterations:
      return "max_iterations";
    case AlignStatus::kTooFewResiduals:
      break;
  }
  return "too_few_residuals";
}

Array<double> information_of(const AlignResult& result) {
  const double* begin = result.information.data();
  return to_array(std::vector<double>(begin, begin + 36), 6);
}

Array<double> observability_of(const AlignResult& result) {
  return to_array(std::vector<double>(result.observability.begin(), result.observability.end()));
}

}  // namespace

void bind_registration(nb::module_& module) {
  nb::class_<AlignResult>(module, "AlignResult", kAlignResultDoc)
      .def_prop_ro("T_map_scan", [](const AlignResult& self) { return to_array(self.T_map_scan); })
      .def_prop_ro("status", &status_name)
      .def_ro("iterations", &AlignResult::iterations)
      .def_prop_ro("inlier_share", &AlignResult::inlier_share)
      .def_ro("rms_distance", &AlignResult::rms_distance)
      .def_ro("cost", &AlignResult::cost)
      .def_prop_ro("information", &information_of, nb::rv_policy::automatic)
      .def_prop_ro("observability", &observability_of, nb::rv_policy::automatic)
      .def_ro("degenerate_directions", &AlignResult::degenerate_directions);
  nb::class_<Aligner>(module, "ScanAligner", documented<AlignOptions>(kAlignerDoc))
      .def(
          "__init__",
          [](Aligner* self, const nb::kwargs& options) {
            new (self) Aligner(options_from<AlignOptions>(options));
          },
          "options"_a)
      .def_prop_ro(
          "options",
          [](const Aligner& self) { return to_dict(self.aligner.options()); },
          "dict: the options that it was made with.")
      .def(
          "align",
          &align,
          "map"_a,
          "points"_a.none(),
          "normals"_a.none(),
          "T_map_scan"_a = nb::none(),
          nb::kw_only(),
          "threads"_a = 0,
          kAlignDoc);
}

}  // namespace nvm::python
