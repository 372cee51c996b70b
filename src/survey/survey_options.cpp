// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey_options.hpp"

#include "nvm/core/require.hpp"

namespace nvm::survey {

void SurveyOptions::validate() const {
  const auto in = [](double value, double min, double max) { return value >= min && value <= max; };
  require(in(patch_size, 0.05, 2.0), "patch_size", patch_size, "0.05 to 2 m");
  require(in(min_area, 0.1, 100.0), "min_area", min_area, "0.1 to 100 m²");
  require(in(max_thickness, 0.05, 2.0), "max_thickness", max_thickness, "0.05 to 2 m");
  require(in(min_thickness, 0.0, 0.1), "min_thickness", min_thickness, "0 to 0.1 m");
  require(in(max_gap, 0.0, 20.0), "max_gap", max_gap, "0 to 20 m");
  require(in(plan_height, -100.0, 100.0), "plan_height", plan_height, "-100 to 100 m");
  require(in(drift, 0.0, 1.0), "drift", drift, "0 to 1 m");
}

}  // namespace nvm::survey
