// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/keyframes_beside.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include "io/file/file.hpp"
#include "io/result/session_file.hpp"

namespace nvm::survey {

KeyframeSource keyframes_beside(const std::string& map, const Eigen::Vector3d& origin) {
  const std::filesystem::path path =
      std::filesystem::path(map).parent_path() / io::SessionWriter::kFileName;
  if (!std::filesystem::exists(path)) {
    return nullptr;
  }
  // Which map they belong to stands at their end.
  io::SessionReader whole(path.string());
  while (whole.next()) {
  }
  if (!(whole.map() == io::stamp_of(map))) {
    io::fail(path.string(), "is of another map than " + map);
  }
  return [reader = std::make_shared<io::SessionReader>(path.string()), origin] {
    std::optional<io::Keyframe> keyframe = reader->next();
    if (keyframe) {
      keyframe->T_map_lidar.translation() += origin;
    }
    return keyframe;
  };
}

}  // namespace nvm::survey
