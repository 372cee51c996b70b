// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "nvm/geometry/pose.hpp"

namespace nvm::io {

/// What reading an nvm sequence needs of its meta.json.
struct NvmSequenceMeta {
  std::optional<Pose> T_imu_lidar;    ///< "T_imu_lidar"
  std::optional<std::size_t> scans;   ///< "counts.scans"
  std::optional<std::size_t> points;  ///< "counts.points"
};

/// Throws std::runtime_error, naming the file, when it cannot be read, is no JSON object, or has a
/// T_imu_lidar that is no pose. Other keys are left out.
NvmSequenceMeta read_nvm_sequence_meta(const std::string& path);

}  // namespace nvm::io
