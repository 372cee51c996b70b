// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <vector>

#include "common/executor.hpp"
#include "merge/session.hpp"
#include "merge/session_fit.hpp"

namespace nvm::merge {

/// Several sessions in one map.
struct Merged {
  VoxelMap map;                  ///< in the frame of the first session
  std::vector<SessionFit> fits;  ///< of each session; of the first: identity
};

/// Puts sessions together, in rounds: in each, those that overlap with the map as it is are placed
/// in it as rigid bodies and then added in their order; those that overlap only with these are
/// placed in the next. `guesses`, of the second session and so on as far as they go: the pose of
/// its map, as map.nvm counts, in the coordinates of the first one's poses. Without one, two
/// origins in one grid tell it; else, or when that is not true, places are searched for, and the
/// maps must be level. Throws std::runtime_error with one line when the maps do not go together or
/// a session cannot be placed beyond doubt, std::invalid_argument for fewer than two sessions. The
/// same for any number of threads.
Merged merge_sessions(
    const std::vector<Session>& sessions,
    const std::vector<Pose>& guesses,
    const Executor& executor);

}  // namespace nvm::merge
