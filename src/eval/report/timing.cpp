// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/timing.hpp"

#include <filesystem>

#include "io/file/file.hpp"
#include "io/file/json_file.hpp"

namespace nvm::eval {

std::vector<StageTiming> read_timing(const std::string& path) {
  std::vector<StageTiming> stages;
  if (!std::filesystem::exists(path)) {
    return stages;
  }
  const auto timing = io::read_json(path);
  try {
    for (const auto& [stage, times] : timing.at("cpu").items()) {
      stages.push_back({stage, times.at("mean").get<double>(), times.at("max").get<double>()});
    }
  } catch (const nlohmann::json::exception& error) {
    io::fail(path, error.what());
  }
  return stages;
}

}  // namespace nvm::eval
