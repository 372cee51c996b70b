// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nvm::io {

/// One topic's messages of one type in a bag.
struct RosBagConnection {
  std::string topic;
  std::string type;
};

/// Where a message of a bag is.
struct RosBagEntry {
  double time = 0.0;  ///< of recording [s]
  std::uint32_t connection = 0;
  std::uint32_t offset = 0;  ///< in its chunk [bytes]
  std::size_t chunk = 0;     ///< number of the chunk
};

/// Reads ROS 1 bags (format 2.0; chunks none, bz2, lz4) by lengths and positions that are checked:
/// bytes that are damaged cost the messages that they belong to. Bags without an index (not
/// closed, or cut off) are read as far as they go. A few chunks are in memory at a time.
class RosBagFile {
 public:
  /// Throws std::runtime_error, naming the file, when it cannot be read or is no ROS 1 bag.
  explicit RosBagFile(const std::string& path);

  const std::string& path() const { return path_; }
  const std::map<std::uint32_t, RosBagConnection>& connections() const { return connections_; }

  /// All messages in the order of the file.
  const std::vector<RosBagEntry>& entries() const { return entries_; }

  /// What is wrong with the file as a whole, for the user; empty when nothing is.
  const std::string& problem() const { return problem_; }

  /// The bytes of a message as it is serialised, valid until the next call. Throws
  /// std::runtime_error when they are not there or damaged.
  std::string_view message(const RosBagEntry& entry);

 private:
  struct Chunk {
    std::uint64_t data_position = 0;
    std::uint32_t data_size = 0;
    std::uint32_t size = 0;  ///< expanded
    std::string compression;
  };

  std::string read(std::uint64_t position, std::size_t size);
  std::string read_header(std::uint64_t& position);
  void scan();
  bool scan_record(std::uint64_t& position);
  void add_chunk(std::string_view header, std::uint64_t position, std::uint32_t data_size);
  void add_index(std::string_view header, std::uint64_t position, std::uint32_t data_size);
  void add_connection(std::string_view header, std::string_view data);
  void scan_chunk(std::size_t number);
  void finish_chunk();
  const std::string& expanded(std::size_t number);

  std::string path_;
  std::ifstream file_;
  std::uint64_t file_size_ = 0;
  std::map<std::uint32_t, RosBagConnection> connections_;
  std::vector<Chunk> chunks_;
  std::vector<RosBagEntry> entries_;
  bool is_chunk_indexed_ = true;  ///< the last of chunks_
  bool lacks_connection_ = false;
  std::deque<std::pair<std::size_t, std::string>> expanded_;  ///< the chunks used last, by number
  std::string problem_;
};

}  // namespace nvm::io
