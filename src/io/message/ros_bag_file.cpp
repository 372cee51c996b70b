// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/ros_bag_file.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "io/file/decompress.hpp"
#include "io/file/file.hpp"
#include "io/message/ros_bag_record.hpp"

namespace nvm::io {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::uint32_t kMaxChunk = 1U << 28;   // [bytes]
constexpr std::uint32_t kMaxHeader = 1U << 20;  // [bytes]

double seconds(std::uint64_t ros_time) {
  constexpr std::uint64_t kLow = 0xFFFFFFFF;
  return static_cast<double>(ros_time & kLow) + 1e-9 * static_cast<double>(ros_time >> 32U);
}

}  // namespace

RosBagFile::RosBagFile(const std::string& path) : path_(path), file_(open_to_read(path)) {
  file_size_ = std::filesystem::file_size(path);
  if (file_size_ < kMagic.size() || read(0, kMagic.size()) != kMagic) {
    fail(path, "is not a ROS 1 bag of format 2.0");
  }
  scan();
  for (const Chunk& chunk : chunks_) {
    if (is_built_without(chunk.compression)) {
      fail(
          path,
          "is compressed (" + chunk.compression +
              "), which this nvm was built without: the command nvm of the Python package reads "
              "whole bags of that kind, and rosbag decompress expands them");
    }
  }
}

std::string RosBagFile::read(std::uint64_t position, std::size_t size) {
  if (position > file_size_ || size > file_size_ - position) {
    throw std::runtime_error("a length goes beyond the end");
  }
  std::string bytes(size, '\0');
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position));
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw std::runtime_error("the file ends earlier than when it was opened");
  }
  return bytes;
}

/// The header of the record at `position`, which moves behind it.
std::string RosBagFile::read_header(std::uint64_t& position) {
  const auto size = ByteCursor(read(position, sizeof(std::uint32_t))).next<std::uint32_t>();
  if (size > kMaxHeader) {
    throw std::runtime_error("a record's header has " + std::to_string(size) + " bytes");
  }
  std::string header = read(position + sizeof(size), size);
  position += sizeof(size) + size;
  return header;
}

void RosBagFile::scan() {
  std::uint64_t position = kMagic.size();
  try {
    while (position < file_size_ && scan_record(position)) {
    }
  } catch (const std::runtime_error& error) {
    problem_ = "is cut off or damaged at byte " + std::to_string(position) + " of " +
               std::to_string(file_size_) + " (" + error.what() +
               "): what comes before is read; `rosbag reindex` may repair it";
  }
  finish_chunk();
  if (lacks_connection_) {
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
      scan_chunk(i);
    }
  }
}

/// Notes the record at `position`, which moves behind it; false when that is beyond the file.
bool RosBagFile::scan_record(std::uint64_t& position) {
  std::uint64_t at = position;
  const std::string header = read_header(at);
  const auto data_size = ByteCursor(read(at, sizeof(std::uint32_t))).next<std::uint32_t>();
  at += sizeof(data_size);
  const RosBagRecord record{std::string_view(header)};
  switch (record.operation()) {
    case RosBagRecord::kChunk:
      finish_chunk();
      add_chunk(header, at, data_size);
      break;
    case RosBagRecord::kIndex:
      add_index(header, at, data_size);
      break;
    case RosBagRecord::kConnection:
      add_connection(header, read(at, data_size));
      break;
    case RosBagRecord::kBagHeader:
    case RosBagRecord::kChunkInfo:
      break;
    default:
      throw std::runtime_error("a record of an unknown kind");
  }
  if (data_size > file_size_ - at) {
    throw std::runtime_error("a length goes beyond the end");
  }
  position = at + data_size;
  return true;
}

void RosBagFile::add_chunk(
    std::string_view header, std::uint64_t position, std::uint32_t data_size) {
  const RosBagRecord record(header);
  Chunk chunk;
  chunk.data_position = position;
  chunk.data_size = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(data_size, file_size_ - std::min(position, file_size_)));
  chunk.size = record.number<std::uint32_t>("size");
  chunk.compression = record.text("compression");
  if (chunk.size > kMaxChunk || chunk.data_size > kMaxChunk) {
    throw std::runtime_error("a chunk says that it has more than 256 MiB");
  }
  chunks_.push_back(std::move(chunk));
  is_chunk_indexed_ = false;
}

/// The index that follows a chunk: the times and offsets of one connection's messages.
void RosBagFile::add_index(
    std::string_view header, std::uint64_t position, std::uint32_t data_size) {
  const RosBagRecord record(header);
  const auto connection = record.number<std::uint32_t>("conn");
  if (chunks_.empty()) {
    throw std::runtime_error("an index before all chunks");
  }
  const std::string data = read(position, data_size);
  ByteCursor cursor(data);
  for (auto left = record.number<std::uint32_t>("count"); left > 0; --left) {
    const double time = seconds(cursor.next<std::uint64_t>());
    entries_.push_back({time, connection, cursor.next<std::uint32_t>(), chunks_.size() - 1});
  }
  lacks_connection_ = lacks_connection_ || connections_.count(connection) == 0;
  is_chunk_indexed_ = true;
}

void RosBagFile::add_connection(std::string_view header, std::string_view data) {
  const RosBagRecord record(header);
  const auto fields = RosBagRecord::fields_of(data);
  const auto type = fields.find("type");
  connections_[record.number<std::uint32_t>("conn")] = {
      std::string(record.text("topic")),
      std::string(type == fields.end() ? std::string_view() : type->second)};
}

/// A chunk that no index follows, as the file was cut off behind it, is looked through.
void RosBagFile::finish_chunk() {
  if (!is_chunk_indexed_) {
    is_chunk_indexed_ = true;
    const std::size_t number = chunks_.size() - 1;
    scan_chunk(number);
    try {
      for (ByteCursor cursor(expanded(number)); !cursor.is_at_end();) {
        const std::size_t offset = expanded(number).size() - cursor.left();
        const RosBagRecord record(cursor);
        if (record.operation() == RosBagRecord::kMessage) {
          entries_.push_back(
              {seconds(record.number<std::uint64_t>("time")),
               record.number<std::uint32_t>("conn"),
               static_cast<std::uint32_t>(offset),
               number});
        }
      }
    } catch (const std::runtime_error&) {
      return;  // the end of what is there
    }
  }
}

/// Looks for connections in a chunk.
void RosBagFile::scan_chunk(std::size_t number) {
  try {
    for (ByteCursor cursor(expanded(number)); !cursor.is_at_end();) {
      const std::size_t offset = expanded(number).size() - cursor.left();
      const std::string_view rest = std::string_view(expanded(number)).substr(offset);
      const RosBagRecord record(cursor);
      if (record.operation() == RosBagRecord::kConnection) {
        add_connection(ByteCursor(rest).sized_block(), record.data());
      }
    }
  } catch (const std::runtime_error&) {
    return;  // its messages are judged one by one
  }
}

const std::string& RosBagFile::expanded(std::size_t number) {
  constexpr std::size_t kKept = 4;  // messages are read in order of time, chunks may overlap
  for (const auto& [kept_number, bytes] : expanded_) {
    if (kept_number == number) {
      return bytes;
    }
  }
  const Chunk& chunk = chunks_.at(number);
  std::string bytes = read(chunk.data_position, chunk.data_size);
  if (chunk.compression != "none") {
    bytes = decompress(chunk.compression, bytes, chunk.size);
  }
  if (expanded_.size() == kKept) {
    expanded_.pop_front();
  }
  expanded_.emplace_back(number, std::move(bytes));
  return expanded_.back().second;
}

std::string_view RosBagFile::message(const RosBagEntry& entry) {
  const std::string_view chunk = expanded(entry.chunk);
  if (entry.offset >= chunk.size()) {
    throw std::runtime_error("its chunk is damaged");
  }
  ByteCursor cursor(chunk.substr(entry.offset));
  const RosBagRecord record(cursor);
  if (record.operation() != RosBagRecord::kMessage ||
      record.number<std::uint32_t>("conn") != entry.connection) {
    throw std::runtime_error("its chunk is damaged: there is no message where the index says");
  }
  return record.data();
}

}  // namespace nvm::io
