// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/map_origin.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/file/line_reader.hpp"
#include "io/file/pending_path.hpp"

namespace nvm::io {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = "_origin.txt";

/// Where the origin of the map file `map` is written.
fs::path origin_file(const fs::path& map) {
  return map.parent_path() / (map.stem().string() + kEnding);
}

}  // namespace

Eigen::Vector3d choose_origin(const Trajectory& poses) {
  constexpr double kFar = 1e4;  // [m]
  constexpr double kStep = 100.0;
  if (poses.empty()) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d first = poses.front().pose.translation();
  return first.cwiseAbs().maxCoeff() < kFar
             ? Eigen::Vector3d(Eigen::Vector3d::Zero())
             : Eigen::Vector3d(kStep * (first / kStep).array().round());
}

Trajectory moved(Trajectory trajectory, const Eigen::Vector3d& offset) {
  for (StampedPose& stamped : trajectory) {
    stamped.pose.translation() += offset;
  }
  return trajectory;
}

void write_origin(const std::string& map, const Eigen::Vector3d& origin) {
  AtomicFile file(origin_file(map).string());
  file.stream() << "# x y z [m] of the origin of the .nvm file in the coordinates of the poses\n"
                << fmt::format("{} {} {}\n", origin.x(), origin.y(), origin.z());
  file.commit();
}

void write_origin_unless_told(
    const std::string& map, const Eigen::Vector3d& origin, const std::string& pending) {
  if (read_origin(map) != origin) {
    write_origin(pending, origin);
  }
}

Eigen::Vector3d read_origin(const std::string& map) {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  fs::path path = origin_file(map);
  if (!fs::exists(path)) {  // a map.nvm that was given another name
    path = fs::path(map).parent_path() / (std::string("map") + kEnding);
  }
  if (!fs::exists(path)) {
    return origin;
  }
  LineReader lines(path.string());
  const auto words = lines.next();
  if (!words || words->size() != 3) {
    lines.fail("must be the three coordinates of an origin");
  }
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = lines.number((*words)[static_cast<std::size_t>(axis)]);
  }
  return origin;
}

}  // namespace nvm::io
