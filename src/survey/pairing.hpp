// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <vector>

#include "survey/face.hpp"
#include "survey/survey_options.hpp"

namespace nvm::survey {

/// Two faces that look away from each other, back to back.
struct FacePair {
  std::size_t first = 0;  ///< index of a face
  std::size_t second = 0;
  double distance = 0.0;  ///< between them, mean over `overlap` [m]
  Mask overlap;           ///< cells of the first face's `seen` that both faces cover
};

/// The pairs whose faces are min_thickness to max_thickness apart over at least min_area. Nearer
/// pairs go first, and no part of a face is paired twice: what lies between two faces of a pair is
/// never another face of a pair.
std::vector<FacePair> pair_faces(const std::vector<Face>& faces, const SurveyOptions& options);

}  // namespace nvm::survey
