// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "io/result/session_file.hpp"
#include "survey/face.hpp"
#include "survey/pairing.hpp"

namespace nvm::survey {

/// Gives the keyframes of the run that made a map, one by one, in its map's frame; then nothing.
using KeyframeSource = std::function<std::optional<io::Keyframe>()>;

/// One side of a wall in one keyframe.
struct Sighting {
  double time = 0.0;      ///< [s]
  double offset = 0.0;    ///< mean distance of the keyframe's points to the face [m]
  double sq_error = 0.0;  ///< variance of `offset`, if each point errs on its own [m²]
};

/// Those of a wall, by side, in the order of the keyframes.
using WallSightings = std::array<std::vector<Sighting>, 2>;

/// When each side of `pairs` was seen, where both faces are in the map; an entry for each pair.
std::vector<WallSightings> find_sightings(
    const SurveyCloud& cloud,
    const std::vector<Face>& faces,
    const std::vector<FacePair>& pairs,
    const KeyframeSource& next);

}  // namespace nvm::survey
