// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "io/file/byte_cursor.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::io {

/// A scan that stands for its surroundings, where a run saw it.
struct Keyframe {
  double time = 0.0;                     ///< [s]
  Pose T_map_lidar = Pose::Identity();   ///< in the map of its run, as map.nvm counts
  std::vector<Eigen::Vector3f> points;   ///< [m], thinned, LiDAR frame
  std::vector<Eigen::Vector3f> normals;  ///< unit, of equal number
};

/// Tells a file of a map from any other, without reading all of it.
struct MapStamp {
  std::uint64_t bytes = 0;     ///< of the file
  std::uint32_t checksum = 0;  ///< that stands at its end
};
inline bool operator==(const MapStamp& a, const MapStamp& b) {
  return a.bytes == b.bytes && a.checksum == b.checksum;
}

/// That of the file `map`. Throws std::runtime_error when it cannot be read.
MapStamp stamp_of(const std::string& map);

/// Writes the keyframes of a run one by one (docs/formats.md): takes the memory of one.
class SessionWriter {
 public:
  static constexpr const char* kFileName = "session.nvms";  ///< in a folder of results

  /// Throws std::runtime_error when `path` cannot be written.
  explicit SessionWriter(const std::string& path);

  /// Throws std::runtime_error.
  void add(const Keyframe& keyframe);

  /// Marks the file as whole, and as of that map. Throws std::runtime_error.
  void finish(const MapStamp& map);

 private:
  void put(const std::string& bytes);

  std::string path_;
  std::ofstream stream_;
  std::uint32_t count_ = 0;
};

/// Reads such a file, one keyframe in memory at a time.
class SessionReader {
 public:
  /// Throws std::runtime_error when `path` cannot be read, or is no session or one of a newer
  /// format.
  explicit SessionReader(const std::string& path);

  /// The next keyframe; nothing at the end. Throws std::runtime_error when the file is truncated or
  /// corrupt.
  std::optional<Keyframe> next();

  /// The map that the keyframes belong to, once next() has given nothing.
  const MapStamp& map() const { return map_; }

 private:
  void finish(ByteCursor end);
  std::string take(std::size_t size);

  std::string path_;
  std::ifstream stream_;
  std::uint32_t count_ = 0;
  MapStamp map_;
};

}  // namespace nvm::io
