// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/timing.hpp"

#include <filesystem>

#include "eval/json_file.hpp"
#include "io/file.hpp"

namespace nvm::eval {

std::vector<StageTiming> read_timing(const std::string& path) {
  std::vector<StageTiming> stages;
  if (!std::filesystem::exists(path)) {
    return stages;
  }
  const auto timing = read_json(path);
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
