// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/stages.hpp"

namespace nvm::app {

const std::array<Stage, 7>& stages() {
  using Times = lio::StageTimes;
  static constexpr std::array<Stage, 7> kStages = {
      {{"Deskew", "deskew_ms", [](const Times& t) { return t.deskew; }},
       {"Normals", "normals_ms", [](const Times& t) { return t.normals; }},
       {"Map update", "map_update_ms", [](const Times& t) { return t.map_update; }},
       {"Optimise", "optimize_ms", [](const Times& t) { return t.optimize; }},
       {"Pose estimation",
        "pose_estimation_ms",
        [](const Times& t) { return t.pose_estimation(); }},
       {"Process measurement", "measurement_ms", [](const Times& t) { return t.measurement(); }},
       {"Total", "total_ms", [](const Times& t) { return t.total(); }}}};
  return kStages;
}

}  // namespace nvm::app
