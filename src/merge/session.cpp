// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/session.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/file/file.hpp"
#include "io/result/map_origin.hpp"
#include "lio/map/has_planes.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm::merge {

namespace {

namespace fs = std::filesystem;

/// Every keyframe, or every second, every fourth and so on, so that they are at most `most`.
std::vector<io::Keyframe> read_keyframes(io::SessionReader& reader, std::size_t most) {
  std::vector<io::Keyframe> keyframes;
  std::size_t step = 1;
  for (std::size_t index = 0; std::optional<io::Keyframe> keyframe = reader.next(); ++index) {
    if (index % step != 0) {
      continue;
    }
    if (keyframes.size() == most) {
      for (std::size_t i = 0; 2 * i < keyframes.size(); ++i) {
        keyframes[i] = std::move(keyframes[2 * i]);
      }
      keyframes.resize((keyframes.size() + 1) / 2);
      step *= 2;
      if (index % step != 0) {
        continue;
      }
    }
    keyframes.push_back(std::move(*keyframe));
  }
  return keyframes;
}

std::string map_in(const std::string& folder) { return folder + "/map.nvm"; }

std::string keyframes_in(const std::string& folder) {
  return folder + "/" + io::SessionWriter::kFileName;
}

void check_files(const std::string& folder) {
  if (!fs::is_directory(folder)) {
    io::fail(folder, "is no folder: give those that nvm run had as --out");
  }
  for (const std::string& file : {map_in(folder), keyframes_in(folder)}) {
    if (!fs::exists(file)) {
      io::fail(
          file,
          "is missing: merging needs a map and keyframes, which nvm run leaves without --map or "
          "with --extend, and with map.type=nvm");
    }
  }
}

/// Does `action`, and says what helps when a file is not what it should be.
template <class Action>
auto reading(const Action& action) {
  try {
    return action();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        std::string(error.what()) + "; copy the results again, or run nvm run again");
  }
}

Session read_session(const std::string& folder, const io::MapStamp& stamp) {
  constexpr std::size_t kMostKeyframes = 400;
  const std::string map = map_in(folder);
  io::SessionReader reader(keyframes_in(folder));
  Session session{
      folder, load_map(map), read_keyframes(reader, kMostKeyframes), io::read_origin(map)};
  if (!(reader.map() == stamp)) {
    io::fail(keyframes_in(folder), "belongs to another map than the map.nvm beside it");
  }
  return session;
}

void check_usable(const Session& session) {
  if (!lio::has_planes(session.map)) {
    io::fail(map_in(session.name), "has no points with normals: run nvm run with map.type=nvm");
  }
  if (session.keyframes.empty()) {
    io::fail(
        keyframes_in(session.name),
        "has no keyframes, because no scan fitted the map: give a run whose frames.csv says "
        "tracking");
  }
}

}  // namespace

std::vector<Session> read_sessions(const std::vector<std::string>& folders) {
  std::vector<Session> sessions;
  std::vector<io::MapStamp> stamps;  // tell whether a run comes twice, by whatever names
  for (const std::string& folder : folders) {
    check_files(folder);
    const io::MapStamp stamp = reading([&] { return io::stamp_of(map_in(folder)); });
    const auto same = std::find(stamps.begin(), stamps.end(), stamp);
    if (same != stamps.end()) {
      const std::string& other = sessions[static_cast<std::size_t>(same - stamps.begin())].name;
      io::fail(folder, "has the same map as " + other + ": give each run once");
    }
    stamps.push_back(stamp);
    sessions.push_back(reading([&] { return read_session(folder, stamp); }));
    check_usable(sessions.back());
  }
  return sessions;
}

}  // namespace nvm::merge
