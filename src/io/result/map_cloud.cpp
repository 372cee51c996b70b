// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/map_cloud.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

#include "io/cloud/pcd.hpp"
#include "io/cloud/ply.hpp"
#include "io/file/file.hpp"

namespace nvm::io {
namespace {

using Names = std::initializer_list<std::string_view>;

/// Reads one coordinate of all points; false, and no change, when no field has one of the names.
template <class Vector>
bool read_coordinate(
    const PointRecords& records, Names names, int axis, std::vector<Vector>& vectors) {
  const Field* field = records.find(names);
  if (field == nullptr) {
    return false;
  }
  vectors.resize(records.size);
  for_each_value(records, *field, [&](std::size_t i, double value) {
    vectors[i][axis] = static_cast<typename Vector::Scalar>(value);
  });
  return true;
}

bool needs_double(const MapCloud& cloud) {
  constexpr double kFloatLimit = 4096.0;
  return std::any_of(
      cloud.positions.begin(), cloud.positions.end(), [](const Eigen::Vector3d& position) {
        return position.cwiseAbs().maxCoeff() >= kFloatLimit;
      });
}

template <class Scalar>
void append_records(const MapCloud& cloud, std::string& bytes) {
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    for (const double coordinate : cloud.positions[i]) {
      append_bytes(static_cast<Scalar>(coordinate), bytes);
    }
    if (!cloud.normals.empty()) {
      for (const float coordinate : cloud.normals[i]) {
        append_bytes(coordinate, bytes);
      }
    }
    if (!cloud.sides.empty()) {
      append_bytes(cloud.sides[i], bytes);
    }
  }
}

PointRecords records_of(const MapCloud& cloud, const std::array<const char*, 3>& normal_names) {
  PointRecords records;
  const bool is_double = needs_double(cloud);
  for (const char* name : {"x", "y", "z"}) {
    records.add_field(name, is_double ? ScalarType::kFloat64 : ScalarType::kFloat32);
  }
  for (const char* name : normal_names) {
    if (!cloud.normals.empty()) {
      records.add_field(name, ScalarType::kFloat32);
    }
  }
  if (!cloud.sides.empty()) {
    records.add_field("side", ScalarType::kUint8);
  }
  records.size = cloud.positions.size();
  records.bytes.reserve(records.size * records.record_size);
  is_double ? append_records<double>(cloud, records.bytes)
            : append_records<float>(cloud, records.bytes);
  return records;
}

void check_lengths(const MapCloud& cloud) {
  const std::size_t size = cloud.positions.size();
  if ((!cloud.normals.empty() && cloud.normals.size() != size) ||
      (!cloud.sides.empty() && cloud.sides.size() != size)) {
    throw std::invalid_argument(
        "map cloud: " + std::to_string(cloud.normals.size()) + " normals and " +
        std::to_string(cloud.sides.size()) + " sides for " + std::to_string(size) + " positions");
  }
}

}  // namespace

MapCloud map_cloud_from(const PointRecords& records) {
  MapCloud cloud;
  if (!read_coordinate(records, {"x"}, 0, cloud.positions) ||
      !read_coordinate(records, {"y"}, 1, cloud.positions) ||
      !read_coordinate(records, {"z"}, 2, cloud.positions)) {
    fail(records.source, "has no fields x, y and z");
  }
  if (!read_coordinate(records, {"nx", "normal_x"}, 0, cloud.normals) ||
      !read_coordinate(records, {"ny", "normal_y"}, 1, cloud.normals) ||
      !read_coordinate(records, {"nz", "normal_z"}, 2, cloud.normals)) {
    cloud.normals.clear();
  }
  if (const Field* side = records.find({"side"})) {
    cloud.sides.resize(records.size);
    for_each_value(records, *side, [&](std::size_t i, double value) {
      cloud.sides[i] = static_cast<std::uint8_t>(value >= 0.0 ? std::min(value, 255.0) : 0.0);
    });
  }
  return cloud;
}

MapCloud read_map_cloud(const std::string& path) {
  const PointRecords records = read_points(path);
  if (records.missing > 0) {
    fail(path, "is truncated: " + std::to_string(records.missing) + " points are missing");
  }
  return map_cloud_from(records);
}

void write_map_cloud(const std::string& path, const MapCloud& cloud) {
  check_lengths(cloud);
  if (extension_of(path) == ".ply") {
    write_ply(path, records_of(cloud, {"nx", "ny", "nz"}));
  } else if (extension_of(path) == ".pcd") {
    write_pcd(path, records_of(cloud, {"normal_x", "normal_y", "normal_z"}));
  } else {
    fail(path, "a map is written as .ply or .pcd");
  }
}

}  // namespace nvm::io
