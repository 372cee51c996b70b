// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "survey/face.hpp"
#include "survey/survey_options.hpp"

namespace nvm::survey {

/// True when the normals of a map seem to point into its walls instead of to where their points
/// were seen from: of the large level faces the lowest looks down and the highest, a storey above,
/// up; or, where those do not tell, no two faces stand back to back and some would if all were
/// turned around. `up`: unit vector; `has_pairs`: whether any stand back to back.
bool is_inside_out(
    const std::vector<Face>& faces,
    const Eigen::Vector3d& up,
    const SurveyOptions& options,
    bool has_pairs);

}  // namespace nvm::survey
