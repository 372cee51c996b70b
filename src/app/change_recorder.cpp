// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/change_recorder.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "app/is_on_from.hpp"
#include "io/cloud/ply.hpp"
#include "io/cloud/point_records.hpp"

namespace nvm::app {

namespace {

enum : std::uint8_t { kAdded = 1, kGone = 2 };

io::PointRecords empty_records() {
  io::PointRecords records;
  for (const char* name : {"x", "y", "z"}) {
    records.add_field(name, io::ScalarType::kFloat64);
  }
  for (const char* name : {"nx", "ny", "nz", "area"}) {
    records.add_field(name, io::ScalarType::kFloat32);
  }
  records.add_field("change", io::ScalarType::kUint8);
  return records;
}

void append(
    const std::vector<lio::ChangedPlace>& places,
    std::uint8_t change,
    const Eigen::Vector3d& origin,
    io::PointRecords& records) {
  for (const lio::ChangedPlace& place : places) {
    for (const lio::ChangedSurface& surface : place.surfaces) {
      for (const double coordinate : Eigen::Vector3d(surface.position + origin)) {
        io::append_bytes(coordinate, records.bytes);
      }
      for (const float coordinate : surface.normal) {
        io::append_bytes(coordinate, records.bytes);
      }
      io::append_bytes(static_cast<float>(surface.area), records.bytes);
      io::append_bytes(change, records.bytes);
      ++records.size;
    }
  }
}

/// "2 places that it lacks (1.9 m^2, the largest 1.2 m^2 at 3.1 4.0 0.5 m)"
std::string described(
    const std::vector<lio::ChangedPlace>& places,
    const std::string& what,
    const Eigen::Vector3d& origin) {
  std::string text =
      fmt::format("{} place{} {}", places.size(), places.size() == 1 ? "" : "s", what);
  double area = 0.0;
  for (const lio::ChangedPlace& place : places) {
    area += place.area;
  }
  if (!places.empty()) {
    const Eigen::Vector3d at = places.front().center + origin;
    text += fmt::format(
        " ({:.1f} m^2, the largest {:.1f} m^2 at {:.1f} {:.1f} {:.1f} m)",
        area,
        places.front().area,
        at.x(),
        at.y(),
        at.z());
  }
  return text;
}

}  // namespace

ChangeRecorder::ChangeRecorder(const lio::LioMap& map) {
  if (map.is_frozen() && map.voxel_map() != nullptr) {
    finder_.emplace(*map.voxel_map());
  }
}

void ChangeRecorder::add(const lio::FrameResult& frame, const lio::Pipeline& pipeline) {
  constexpr double kPause = 2.0;  // [s]
  if (!finder_ || frame.status != lio::FrameStatus::kTracking) {
    return;
  }
  const bool is_due = finder_->scans() == 0 || frame.time - last_time_ > kPause ||
                      is_on_from(last_pose_, frame.T_map_lidar);
  if (is_due) {
    finder_->add(pipeline.scan(), pipeline.normals(), frame.T_map_lidar);
    last_time_ = frame.time;
    last_pose_ = frame.T_map_lidar;
  }
}

std::string ChangeRecorder::write(const std::string& folder, const Eigen::Vector3d& origin) const {
  const std::vector<lio::ChangedPlace> added = finder_->added();
  const std::vector<lio::ChangedPlace> gone = finder_->gone();
  io::PointRecords records = empty_records();
  append(added, kAdded, origin, records);
  append(gone, kGone, origin, records);
  io::write_ply(folder + "/changes.ply", records);
  return fmt::format(
      "against the prior map: {}, {}",
      described(added, "that it lacks", origin),
      described(gone, "no longer there", origin));
}

}  // namespace nvm::app
