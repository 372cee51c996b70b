// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/nvm_sequence_meta.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/file/file.hpp"

namespace nvm::io {
namespace {

using Json = nlohmann::json;

Pose pose_from(const Json& json) {
  const auto t = json.at("translation").get<std::array<double, 3>>();
  const auto q = json.at("quaternion_xyzw").get<std::array<double, 4>>();
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  Pose pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() << t[0], t[1], t[2];
  constexpr double kTolerance = 0.01;
  if (!(std::abs(rotation.norm() - 1.0) <= kTolerance) || !is_rigid(pose)) {
    throw std::invalid_argument("quaternion_xyzw does not have length 1");
  }
  return pose;
}

std::optional<std::size_t> count_from(const Json& meta, const char* name) {
  const auto counts = meta.find("counts");
  if (counts == meta.end() || !counts->is_object() || !counts->contains(name) ||
      !counts->at(name).is_number_unsigned()) {
    return std::nullopt;
  }
  return counts->at(name).get<std::size_t>();
}

}  // namespace

NvmSequenceMeta read_nvm_sequence_meta(const std::string& path) {
  const std::string text = read_file(path);
  NvmSequenceMeta meta;
  try {
    const Json json = Json::parse(text);
    if (!json.is_object()) {
      throw std::invalid_argument("is no JSON object");
    }
    if (json.contains("T_imu_lidar")) {
      meta.T_imu_lidar = pose_from(json.at("T_imu_lidar"));
    }
    meta.scans = count_from(json, "scans");
    meta.points = count_from(json, "points");
  } catch (const std::exception& error) {
    fail(path, error.what());
  }
  return meta;
}

}  // namespace nvm::io
