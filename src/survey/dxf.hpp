// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "survey/plan.hpp"
#include "survey/survey.hpp"

namespace nvm::survey {

/// `plan` of `survey` as a drawing for CAD programs: DXF of release 12 (AC1009), the one that all
/// of them read, in metres. Layers: WALLS, DOORS, OPENINGS, FURNITURE, SINGLE_FACES, THICKNESS
/// (texts in millimetres). Written here because Debian has no library that writes DXF; a test reads
/// it with ezdxf.
std::string plan_dxf(const Survey& survey, const Plan& plan);

}  // namespace nvm::survey
