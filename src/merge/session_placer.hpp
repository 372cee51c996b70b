// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/executor.hpp"
#include "lio/place/place_search.hpp"
#include "merge/session_fit.hpp"

namespace nvm::merge {

/// Which of so many keyframes propose places, in their order: each at most once, and spread over
/// the session however few of them come to vote.
std::vector<std::size_t> voting_order(std::size_t keyframes);

/// Finds how sessions lie in a map: keyframes propose places, those on which most of them agree are
/// refined, and all points of the session are asked which it is.
class SessionPlacer {
 public:
  /// `map` outlives the placer.
  SessionPlacer(const VoxelMap& map, const Executor& executor);

  /// The pose of a session with `keyframes`, level as the map is; near `guess` when there is one.
  SessionFit place(const std::vector<io::Keyframe>& keyframes, const std::optional<Pose>& guess);

 private:
  struct Proposal {
    Pose T_map_session;
    std::size_t votes;  ///< keyframes
  };

  void propose(
      const io::Keyframe& keyframe,
      const std::optional<Pose>& guess,
      std::vector<Proposal>& proposals);
  SessionFit best_of(
      const std::vector<Proposal>& proposals,
      const SessionBody& body,
      const std::optional<Pose>& guess) const;

  const VoxelMap& map_;
  Executor executor_;
  lio::PlaceSearch search_;
};

}  // namespace nvm::merge
