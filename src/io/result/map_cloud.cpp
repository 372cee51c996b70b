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

void add_field(const std::string& name, float /*of*/, PointRecords& records) {
  records.add_field(name, ScalarType::kFloat32);
}
void add_field(const std::string& name, double /*of*/, PointRecords& records) {
  records.add_field(name, ScalarType::kFloat64);
}
void add_field(const std::string& name, std::uint16_t /*of*/, PointRecords& records) {
  records.add_field(name, ScalarType::kUint16);
}
void add_field(const std::string& /*name*/, const Color& /*of*/, PointRecords& records) {
  for (const char* part : {"red", "green", "blue"}) {  // as viewers know them
    records.add_field(part, ScalarType::kUint8);
  }
}

template <class Number>
void append_value(Number value, std::string& bytes) {
  append_bytes(value, bytes);
}
void append_value(const Color& color, std::string& bytes) {
  for (const std::uint8_t part : {color.red, color.green, color.blue}) {
    append_bytes(part, bytes);
  }
}

/// Calls visit(name, &PointValues::value) for the columns that there are.
template <class Visitor>
void for_each_column(const MapCloud& cloud, const Visitor& visit) {
  visit_columns([&](const OptionInfo& info, auto kept, auto value) {
    if (cloud.columns.*kept && !cloud.values.empty()) {
      visit(info.name, value);
    }
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
    for_each_column(cloud, [&](const char* /*name*/, auto value) {
      append_value(cloud.values[i].*value, bytes);
    });
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
  for_each_column(
      cloud, [&](const char* name, auto value) { add_field(name, PointValues{}.*value, records); });
  records.size = cloud.positions.size();
  records.bytes.reserve(records.size * records.record_size);
  is_double ? append_records<double>(cloud, records.bytes)
            : append_records<float>(cloud, records.bytes);
  return records;
}

void check_lengths(const MapCloud& cloud) {
  const std::size_t size = cloud.positions.size();
  const auto fits = [size](const auto& vector) { return vector.empty() || vector.size() == size; };
  if (!fits(cloud.normals) || !fits(cloud.sides) || !fits(cloud.values)) {
    throw std::invalid_argument(
        "map cloud: " + std::to_string(cloud.normals.size()) + " normals, " +
        std::to_string(cloud.sides.size()) + " sides and " + std::to_string(cloud.values.size()) +
        " values for " + std::to_string(size) + " positions");
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
