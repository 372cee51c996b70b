// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/ros_bag_check.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "io/file.hpp"
#include "io/mapped_file.hpp"

namespace nvm::io {
namespace {

using Bytes = std::string_view;

enum class Operation : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

[[noreturn]] void refuse(const std::string& problem) {
  throw std::runtime_error("is truncated or corrupt: " + problem);
}

void expect(bool holds, const char* problem) {
  if (!holds) {
    refuse(problem);
  }
}

Bytes take(Bytes& rest, std::size_t size) {
  expect(size <= rest.size(), "a length goes beyond the end");
  const Bytes taken = rest.substr(0, size);
  rest.remove_prefix(size);
  return taken;
}

template <class Number>
Number take_number(Bytes& rest) {
  Number number = 0;
  const Bytes bytes = take(rest, sizeof(Number));
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return number;
}

/// A length, and as many bytes.
Bytes take_block(Bytes& rest) { return take(rest, take_number<std::uint32_t>(rest)); }

/// The fields "name=value" of a header.
std::map<Bytes, Bytes> read_fields(Bytes header) {
  std::map<Bytes, Bytes> fields;
  while (!header.empty()) {
    const Bytes field = take_block(header);
    const std::size_t equals = field.find('=');
    expect(equals != Bytes::npos, "a header has a field without '='");
    fields[field.substr(0, equals)] = field.substr(equals + 1);
  }
  return fields;
}

class Record {
 public:
  explicit Record(Bytes& rest) : fields_(read_fields(take_block(rest))), data_(take_block(rest)) {}

  Operation operation() const { return static_cast<Operation>(number<std::uint8_t>("op")); }
  Bytes data() const { return data_; }

  Bytes text(const char* name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) {
      refuse(std::string("a record has no field ") + name);
    }
    return found->second;
  }

  template <class Number>
  Number number(const char* name) const {
    Bytes value = text(name);
    expect(value.size() == sizeof(Number), "a field has the wrong size");
    return take_number<Number>(value);
  }

  /// The number of entries of `size` bytes that the data consist of.
  void expect_entries(std::size_t size) const {
    expect(number<std::uint32_t>("ver") == 1, "an index has an unknown version");
    const std::size_t count = number<std::uint32_t>("count");
    expect(data_.size() == size * count, "an index has not as many entries as it says");
  }

 private:
  std::map<Bytes, Bytes> fields_;
  Bytes data_;
};

class BagCheck {
 public:
  void run(Bytes bag) {
    constexpr Bytes kMagic = "#ROSBAG V2.0\n";
    if (bag.substr(0, kMagic.size()) != kMagic) {
      throw std::runtime_error("is not a ROS 1 bag of format 2.0");
    }
    Bytes rest = bag.substr(kMagic.size());
    const Record header(rest);
    expect(header.operation() == Operation::kBagHeader, "it does not begin with a bag header");
    const auto index_position = header.number<std::uint64_t>("index_pos");
    if (index_position == 0) {
      throw std::runtime_error("has no index, as it was not closed; `rosbag reindex` repairs it");
    }
    bool has_index = false;
    while (!rest.empty()) {
      const std::size_t position = bag.size() - rest.size();
      has_index = has_index || position == index_position;
      const Record record(rest);
      if (!has_index) {
        check_in_body(record, position);
      } else {
        check_in_index(record);
      }
    }
    expect(has_index, "its index is not where it says");
    expect(header.number<std::uint32_t>("conn_count") == connections_, "connections are missing");
    expect(header.number<std::uint32_t>("chunk_count") == chunk_infos_, "chunks are missing");
  }

 private:
  void check_in_body(const Record& record, std::size_t position) {
    switch (record.operation()) {
      case Operation::kChunk:
        chunk_positions_.insert(position);
        return check_chunk(record);
      case Operation::kIndex:
        return check_entries(record);
      default:
        refuse("there is a record that does not belong between chunks");
    }
  }

  void check_in_index(const Record& record) {
    switch (record.operation()) {
      case Operation::kConnection:
        ++connections_;
        return check_connection(record);
      case Operation::kChunkInfo:
        ++chunk_infos_;
        record.expect_entries(2 * sizeof(std::uint32_t));
        expect(
            chunk_positions_.count(record.number<std::uint64_t>("chunk_pos")) > 0,
            "the index points to no chunk");
        return;
      default:
        refuse("there is a record that does not belong into the index");
    }
  }

  static void check_connection(const Record& record) {
    record.number<std::uint32_t>("conn");
    record.text("topic");
    read_fields(record.data());
  }

  void check_chunk(const Record& chunk) {
    constexpr std::uint32_t kMaxSize = 1U << 30;
    chunk_size_ = chunk.number<std::uint32_t>("size");
    is_compressed_ = chunk.text("compression") != "none";
    connection_of_message_.clear();
    expect(chunk_size_ <= kMaxSize, "a chunk says that it has more than 1 GiB");
    if (!is_compressed_) {
      expect(chunk_size_ == chunk.data().size(), "a chunk has not the size that it says");
      check_records(chunk.data());
    }
  }

  void check_records(Bytes rest) {
    while (!rest.empty()) {
      const std::size_t offset = chunk_size_ - rest.size();
      const Record record(rest);
      if (record.operation() == Operation::kConnection) {
        check_connection(record);
      } else {
        expect(record.operation() == Operation::kMessage, "a chunk holds an unknown record");
        connection_of_message_[offset] = record.number<std::uint32_t>("conn");
      }
    }
  }

  /// Entries are a time of eight bytes and the offset of a message of the chunk before.
  void check_entries(const Record& index) const {
    constexpr std::size_t kTimeSize = 8;
    index.expect_entries(kTimeSize + sizeof(std::uint32_t));
    const auto connection = index.number<std::uint32_t>("conn");
    for (Bytes rest = index.data(); !rest.empty();) {
      take(rest, kTimeSize);
      const std::size_t offset = take_number<std::uint32_t>(rest);
      const auto message = connection_of_message_.find(offset);
      const bool is_there =
          is_compressed_ ? offset < chunk_size_
                         : message != connection_of_message_.end() && message->second == connection;
      expect(is_there, "the index points to no message");
    }
  }

  std::set<std::size_t> chunk_positions_;
  std::uint32_t connections_ = 0;
  std::uint32_t chunk_infos_ = 0;
  // Of the last chunk:
  std::size_t chunk_size_ = 0;
  bool is_compressed_ = false;
  std::unordered_map<std::size_t, std::uint32_t> connection_of_message_;
};

}  // namespace

void check_ros_bag(const std::string& path) {
  const MappedFile file(path);
  try {
    BagCheck().run(file.bytes());
  } catch (const std::runtime_error& problem) {
    fail(path, problem.what());
  }
}

}  // namespace nvm::io
