// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "nvm/core/option.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/storage/byte_stream.hpp"
#include "nvm/map/storage/value_row.hpp"
#include "nvm/map/storage/value_stream.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm {
inline namespace NVM_TARGET {

// The file: 8 bytes of magic, u32 version, u64 length of the body, the body, u32 CRC-32 of
// everything before. All little endian. The body: the options in the order of visit_options(), the
// voxels from the least to the most recently used, and the present epoch (see recency.hpp). A
// voxel: its index, the epochs of the list that it stands in and of its last use, and its surfaces
// with their points as stored and, in a map that merges points, how many each stands for; then the
// values of its columns. Loading gives back the same map bit by bit: the same answers, and the same
// map after whatever is done to either.
//
// Older versions that are still read: 3 had no columns; 2 had neither max_merged_points nor what it
// counts nor the present epoch either, and counted the epochs without gaps.

/// Turns a VoxelMap, which is `Map`, into bytes and back; see save_map() and load_map().
template <class Map>
class BasicMapArchive {
 public:
  static std::vector<std::uint8_t> write(const Map& map) {
    detail::ByteWriter body;
    visit_options(map.options(), OptionWriter{body});
    write_voxels(map.engine_.storage(), map.options().columns, body);

    detail::ByteWriter file;
    file.put(kMagic);
    file.put(kVersion);
    file.put(static_cast<std::uint64_t>(body.bytes().size()));
    file.append(body.bytes());
    file.put(detail::crc32(file.bytes().data(), file.bytes().size()));
    return file.take();
  }

  /// Throws std::runtime_error, saying what is wrong, unless `bytes` are exactly what write()
  /// gives, or gave in an older version that is still read.
  static Map read(const std::vector<std::uint8_t>& bytes) {
    detail::ByteReader file(bytes.data(), bytes.size());
    check(bytes.size() >= kHeaderBytes + sizeof(std::uint32_t), "is too short for an nvm map");
    check(file.get<std::uint64_t>() == kMagic, "is not an nvm map");
    const auto version = file.get<std::uint32_t>();
    check(
        version >= kOldestVersion && version <= kVersion,
        "has format version " + std::to_string(version) + "; this nvm reads versions " +
            std::to_string(kOldestVersion) + " to " + std::to_string(kVersion));
    const auto length = file.get<std::uint64_t>();
    check(
        length == bytes.size() - kHeaderBytes - sizeof(std::uint32_t),
        "is truncated or has bytes at its end");
    const std::size_t end = bytes.size() - sizeof(std::uint32_t);
    detail::ByteReader checksum(bytes.data() + end, sizeof(std::uint32_t));
    check(
        checksum.get<std::uint32_t>() == detail::crc32(bytes.data(), end),
        "is corrupt: its checksum is wrong");

    detail::ByteReader body(bytes.data() + kHeaderBytes, end - kHeaderBytes);
    Map map(read_options(body, version));
    read_voxels(body, version, map);
    check(body.left() == 0, "is corrupt: it does not end where it should");
    return map;
  }

 private:
  static constexpr std::uint64_t kMagic = 0x0a0d50414d4d564eULL;  // "NVMMAP\r\n"
  static constexpr std::uint32_t kVersion = 4;
  static constexpr std::uint32_t kOldestVersion = 2;
  static constexpr std::size_t kHeaderBytes = 20;

  static void check(bool ok, const std::string& problem) {
    if (!ok) {
      throw std::runtime_error(problem);
    }
  }

  struct OptionWriter {
    detail::ByteWriter& out;

    void operator()(const OptionInfo&, double value) const { out.put(value); }
    void operator()(const OptionInfo&, std::size_t value) const {
      out.put(static_cast<std::uint64_t>(value));
    }
    void operator()(const OptionInfo&, int value) const {
      out.put(static_cast<std::int32_t>(value));
    }
    void operator()(const OptionInfo&, bool value) const {
      out.put(static_cast<std::uint8_t>(value));
    }
    template <class Enum, class Choices>
    void operator()(const OptionInfo&, Enum value, const Choices&) const {
      out.put(static_cast<std::uint8_t>(value));
    }
  };

  struct OptionReader {
    detail::ByteReader& in;
    std::uint32_t version;

    void operator()(const OptionInfo&, double& value) const { value = in.get<double>(); }
    void operator()(const OptionInfo&, std::size_t& value) const {
      const auto stored = in.get<std::uint64_t>();
      value = static_cast<std::size_t>(stored);
      check(value == stored, "is too large for this machine");
    }
    void operator()(const OptionInfo& info, int& value) const {
      if (version > 2 || info.name != std::string("max_merged_points")) {
        value = in.get<std::int32_t>();
      }
    }
    void operator()(const OptionInfo& info, bool& value) const {
      if (version > 3 || info.name == std::string("space_across_voxels")) {
        value = get_below(2) == 1;
      }
    }
    template <class Enum, std::size_t kCount>
    void operator()(const OptionInfo&, Enum& value, const OptionChoices<Enum, kCount>&) const {
      value = static_cast<Enum>(get_below(kCount));
    }
    std::uint8_t get_below(std::size_t end) const {
      const auto value = in.get<std::uint8_t>();
      check(value < end, "is corrupt: unknown rule");
      return value;
    }
  };

  static MapOptions read_options(detail::ByteReader& in, std::uint32_t version) {
    MapOptions options;
    visit_options(options, OptionReader{in, version});
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(std::string("is corrupt: ") + error.what());
    }
    return options;
  }

  static void write_voxels(
      const detail::VoxelStorage& storage, const MapColumns& columns, detail::ByteWriter& out) {
    out.put(static_cast<std::uint64_t>(storage.voxel_count()));
    for (const detail::Recency::Standing& standing : storage.recency().standings()) {
      const std::uint32_t voxel = standing.id;
      const detail::VoxelIndex index = storage.index_of(voxel);
      std::uint8_t surfaces = 0;
      for_each_surface(storage, voxel, [&](std::uint32_t) { ++surfaces; });
      for (int axis = 0; axis < 3; ++axis) {
        out.put(static_cast<std::int32_t>(index[axis]));
      }
      out.put(standing.listed);
      out.put(standing.stamp);
      out.put(surfaces);
      for_each_surface(
          storage, voxel, [&](std::uint32_t head) { write_surface(storage, columns, head, out); });
    }
    out.put(storage.recency().epoch());
  }

  template <class Visitor>
  static void for_each_surface(
      const detail::VoxelStorage& storage, std::uint32_t voxel, const Visitor& visit) {
    for (std::uint32_t head = storage.head_of(voxel); head != detail::kNone;
         head = storage.chunk(head).next_surface) {
      visit(head);
    }
  }

  static void write_surface(
      const detail::VoxelStorage& storage,
      const MapColumns& columns,
      std::uint32_t head,
      detail::ByteWriter& out) {
    out.put(static_cast<std::uint8_t>(storage.chunk(head).size));
    detail::for_each_id(storage, head, [&](PointId id) {
      const detail::WrappedPoint point = detail::stored_point(storage, id);
      const detail::StoredNormal normal = detail::stored_normal(storage, id);
      for (const std::int16_t coordinate : {point.x, point.y, point.z}) {
        out.put(coordinate);
      }
      for (const std::int8_t component : {normal.x, normal.y, normal.z}) {
        out.put(component);
      }
      if (storage.counts_merged()) {
        const int lane = static_cast<int>(id % detail::kLanes);
        out.put(static_cast<std::uint8_t>(storage.merged_points(id / detail::kLanes, lane)));
      }
      detail::write_values(columns, detail::stored_values(storage, columns, id), out);
    });
  }

  static void read_voxels(detail::ByteReader& in, std::uint32_t version, Map& map) {
    detail::Recency& recency = map.engine_.storage().recency();
    const auto count = in.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) {
      read_voxel(in, map);
    }
    if (version > 2) {
      check(recency.restore_epoch(in.get<std::uint32_t>()), "is corrupt: impossible order of use");
    } else {
      recency.begin_epoch();
    }
  }

  static detail::VoxelIndex read_index(detail::ByteReader& in) {
    detail::VoxelIndex index;
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = in.get<std::int32_t>();
      check(
          index[axis] >= -detail::kMaxVoxelIndex && index[axis] < detail::kMaxVoxelIndex,
          "is corrupt: voxel out of range");
    }
    return index;
  }

  static void read_voxel(detail::ByteReader& in, Map& map) {
    detail::VoxelStorage& storage = map.engine_.storage();
    const detail::VoxelIndex index = read_index(in);
    const auto listed = in.get<std::uint32_t>();
    const auto stamp = in.get<std::uint32_t>();
    const int surfaces = in.get<std::uint8_t>();
    check(
        surfaces >= 1 && surfaces <= map.options().max_surfaces, "is corrupt: number of surfaces");
    const std::uint32_t brick = storage.find_brick(detail::index_key(detail::brick_index(index)));
    check(
        storage.head_in(brick, detail::cell_in_brick(index)) == detail::kNone,
        "is corrupt: a voxel comes twice");
    check(storage.has_room_for_voxel(brick), "is corrupt: it holds more than its limits allow");
    std::uint32_t last_head = storage.restore_voxel(index, brick, listed, stamp);
    check(last_head != detail::kNone, "is corrupt: impossible order of use");
    const std::uint32_t voxel = storage.chunk(last_head).voxel;
    read_surface(in, map, index, last_head);
    for (int surface = 1; surface < surfaces; ++surface) {
      check(!storage.chunks_exhausted(), "is corrupt: it holds more than its limits allow");
      const std::uint32_t head =
          storage.create_surface(voxel, detail::wrap(detail::LatticePoint{index, {0, 0, 0}}));
      storage.link_surface(last_head, head);
      read_surface(in, map, index, head);
      last_head = head;
    }
  }

  static void read_surface(
      detail::ByteReader& in, Map& map, const detail::VoxelIndex& index, std::uint32_t head) {
    const int size = in.get<std::uint8_t>();
    check(size >= 1 && size <= map.options().points_per_surface, "is corrupt: number of points");
    std::uint32_t last = head;
    for (int i = 0; i < size; ++i) {
      detail::WrappedPoint point{};
      for (std::int16_t* coordinate : {&point.x, &point.y, &point.z}) {
        *coordinate = in.get<std::int16_t>();
      }
      detail::StoredNormal normal;
      for (std::int8_t* component : {&normal.x, &normal.y, &normal.z}) {
        *component = in.get<std::int8_t>();
      }
      const detail::LatticePoint inside{
          index,
          {detail::step_in_voxel(point.x),
           detail::step_in_voxel(point.y),
           detail::step_in_voxel(point.z)}};
      const detail::WrappedPoint expected = detail::wrap(inside);
      check(
          point.x == expected.x && point.y == expected.y && point.z == expected.z,
          "is corrupt: a point lies outside its voxel");
      check(
          i % detail::kLanes != 0 || i == 0 || !map.engine_.storage().chunks_exhausted(),
          "is corrupt: it holds more than its limits allow");
      last = map.engine_.storage().append(head, last, point, normal);
      if (map.engine_.storage().counts_merged()) {
        const int merged = in.get<std::uint8_t>();
        check(
            merged >= 1 && merged <= map.options().max_merged_points,
            "is corrupt: number of merged points");
        map.engine_.storage().restore_merged_points(last, i % detail::kLanes, merged);
      }
      detail::ValueRow row;
      detail::pack(map.options().columns, detail::read_values(map.options().columns, in), row);
      map.engine_.storage().set_row(last, i % detail::kLanes, row);
    }
  }
};

using MapArchive = BasicMapArchive<VoxelMap>;

}  // namespace NVM_TARGET
}  // namespace nvm
