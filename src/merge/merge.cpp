// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "merge/session_placer.hpp"

namespace nvm::merge {

namespace {

void check_alike(const std::vector<Session>& sessions) {
  const MapOptions& first = sessions.front().map.options();
  for (const Session& session : sessions) {
    const MapOptions& options = session.map.options();
    if (options.voxel_size != first.voxel_size || options.max_surfaces != first.max_surfaces) {
      throw std::runtime_error(fmt::format(
          "{}: its map has voxels of {} m and {} surfaces, that of {} has {} m and {}: map both "
          "with the same options",
          session.name,
          options.voxel_size,
          options.max_surfaces,
          sessions.front().name,
          first.voxel_size,
          first.max_surfaces));
    }
  }
}

/// Those of the first session, with room for all, and for what any of them carries.
MapOptions options_for(const std::vector<Session>& sessions) {
  MapOptions options = sessions.front().map.options();
  std::size_t capacity = 0;
  for (const Session& session : sessions) {
    capacity += session.map.options().capacity;
    visit_columns([&](const OptionInfo&, auto kept, auto /*value*/) {
      options.columns.*kept = options.columns.*kept || session.map.options().columns.*kept;
    });
  }
  options.capacity = std::min(capacity, MapOptions::kMaxCapacity);
  options.max_bytes = 0;
  options.eviction = Eviction::kLeastRecentlyUsed;
  return options;
}

/// Adds the points of a session's map, by the map's own rules, so that sides stay apart.
void insert(const Session& session, const Pose& T_map_session, VoxelMap& map) {
  constexpr std::size_t kBlock = 65536;  // so that large maps are not held twice
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<PointValues> values;
  std::size_t evicted = 0;
  const auto insert_block = [&] {
    evicted += map.insert(points, normals, T_map_session, values).evicted_points;
    points.clear();
    normals.clear();
    values.clear();
  };
  session.map.for_each_point([&](const MapPoint& point) {
    points.push_back(point.position.cast<float>());
    normals.push_back(point.normal);
    values.push_back(point.values);
    if (points.size() == kBlock) {
      insert_block();
    }
  });
  insert_block();
  if (evicted > 0) {
    throw std::runtime_error(
        session.name + ": the merged map is full: merge fewer sessions, or use tiles");
  }
}

/// Sessions that are still to be placed, and what has been placed.
struct Assembly {
  const std::vector<Session>& sessions;
  const std::vector<Pose>& guesses;
  std::vector<std::size_t> waiting;
  std::vector<SessionFit> fits;
  VoxelMap map;

  /// What is wrong with those that wait and what helps, in one line.
  std::string why_stuck() const {
    std::string text;
    for (const std::size_t index : waiting) {
      text += sessions[index].name + ": " + fits[index].why_not + "; ";
    }
    return text +
           "record more of what they share, or say where it lies with --guess, which maps that are "
           "not level need";
  }

  /// As a guess or two origins say.
  std::optional<Pose> expected_pose(std::size_t index) const {
    Pose pose = Pose::Identity();
    if (index <= guesses.size()) {
      pose = guesses[index - 1];
    } else if (sessions.front().origin.isZero(0.0) || sessions[index].origin.isZero(0.0)) {
      return std::nullopt;
    } else {
      pose.translation() = sessions[index].origin;
    }
    pose.translation() -= sessions.front().origin;
    return pose;
  }

  SessionFit fit_of(std::size_t index, SessionPlacer& placer) const {
    const std::vector<io::Keyframe>& keyframes = sessions[index].keyframes;
    const std::optional<Pose> expected = expected_pose(index);
    const SessionFit fit = placer.place(keyframes, expected);
    const bool is_final = fit.why_not.empty() || !expected || index <= guesses.size();
    return is_final ? fit : placer.place(keyframes, std::nullopt);
  }

  /// Places the sessions that overlap with the map as it is now, then adds them. False when there
  /// are none.
  bool grow(const Executor& executor) {
    SessionPlacer placer(map, executor);
    std::vector<std::size_t> placed;
    for (const std::size_t index : waiting) {
      fits[index] = fit_of(index, placer);
      if (fits[index].why_not.empty()) {
        placed.push_back(index);
      }
    }
    for (const std::size_t index : placed) {
      insert(sessions[index], fits[index].T_map_session, map);
      waiting.erase(std::find(waiting.begin(), waiting.end(), index));
    }
    return !placed.empty();
  }
};

}  // namespace

Merged merge_sessions(
    const std::vector<Session>& sessions,
    const std::vector<Pose>& guesses,
    const Executor& executor) {
  if (sessions.size() < 2) {
    throw std::invalid_argument("merging needs two sessions or more");
  }
  check_alike(sessions);
  Assembly assembly{
      sessions,
      guesses,
      {},
      std::vector<SessionFit>(sessions.size()),
      VoxelMap(options_for(sessions))};
  insert(sessions.front(), Pose::Identity(), assembly.map);
  for (std::size_t i = 1; i < sessions.size(); ++i) {
    assembly.waiting.push_back(i);
  }
  while (!assembly.waiting.empty()) {
    if (!assembly.grow(executor)) {
      throw std::runtime_error(assembly.why_stuck());
    }
  }
  return {std::move(assembly.map), std::move(assembly.fits)};
}

}  // namespace nvm::merge
