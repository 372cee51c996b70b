// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/storage/byte_stream.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm {

// The file: 8 bytes of magic, u32 version, u64 length of the body, the body, u32 CRC-32 of
// everything before. All little endian. The body: the options, then the voxels from the least to
// the most recently used: index, whether it was used in a later epoch than the one before, and its
// surfaces with their points as stored. Loading gives back the same map bit by bit: the same
// answers, the same order of eviction.

/// Turns a VoxelMap into bytes and back; see save_map() and load_map().
class MapArchive {
 public:
  static std::vector<std::uint8_t> write(const VoxelMap& map) {
    detail::ByteWriter body;
    write_options(map.options(), body);
    write_voxels(map.storage_, body);

    detail::ByteWriter file;
    file.put(kMagic);
    file.put(kVersion);
    file.put(static_cast<std::uint64_t>(body.bytes().size()));
    file.append(body.bytes());
    file.put(detail::crc32(file.bytes().data(), file.bytes().size()));
    return file.take();
  }

  /// Throws std::runtime_error, saying what is wrong, unless `bytes` are exactly what write()
  /// gives.
  static VoxelMap read(const std::vector<std::uint8_t>& bytes) {
    detail::ByteReader file(bytes.data(), bytes.size());
    check(bytes.size() >= kHeaderBytes + sizeof(std::uint32_t), "is too short for an nvm map");
    check(file.get<std::uint64_t>() == kMagic, "is not an nvm map");
    const auto version = file.get<std::uint32_t>();
    check(
        version == kVersion,
        "has format version " + std::to_string(version) + "; this nvm reads version " +
            std::to_string(kVersion));
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
    VoxelMap map(read_options(body));
    read_voxels(body, map);
    check(body.left() == 0, "is corrupt: it does not end where it should");
    return map;
  }

 private:
  static constexpr std::uint64_t kMagic = 0x0a0d50414d4d564eULL;  // "NVMMAP\r\n"
  static constexpr std::uint32_t kVersion = 2;
  static constexpr std::size_t kHeaderBytes = 20;

  static void check(bool ok, const std::string& problem) {
    if (!ok) {
      throw std::runtime_error(problem);
    }
  }

  static void write_options(const MapOptions& options, detail::ByteWriter& out) {
    out.put(options.voxel_size);
    out.put(static_cast<std::uint64_t>(options.capacity));
    out.put(static_cast<std::uint64_t>(options.max_bytes));
    out.put(static_cast<std::int32_t>(options.points_per_surface));
    out.put(options.min_point_distance);
    out.put(static_cast<std::uint8_t>(options.space_across_voxels));
    out.put(static_cast<std::int32_t>(options.max_surfaces));
    out.put(static_cast<std::uint8_t>(options.surface_rule));
    out.put(options.max_surface_angle);
    out.put(options.max_point_angle);
    out.put(static_cast<std::uint8_t>(options.eviction));
    out.put(options.eviction_radius);
  }

  static MapOptions read_options(detail::ByteReader& in) {
    MapOptions options;
    options.voxel_size = in.get<double>();
    options.capacity = static_cast<std::size_t>(in.get<std::uint64_t>());
    options.max_bytes = static_cast<std::size_t>(in.get<std::uint64_t>());
    options.points_per_surface = in.get<std::int32_t>();
    options.min_point_distance = in.get<double>();
    const auto across = in.get<std::uint8_t>();
    options.max_surfaces = in.get<std::int32_t>();
    const auto rule = in.get<std::uint8_t>();
    options.max_surface_angle = in.get<double>();
    options.max_point_angle = in.get<double>();
    const auto eviction = in.get<std::uint8_t>();
    options.eviction_radius = in.get<double>();
    check(across <= 1 && rule <= 1 && eviction <= 1, "is corrupt: unknown rule");
    options.space_across_voxels = across == 1;
    options.surface_rule = static_cast<SurfaceRule>(rule);
    options.eviction = static_cast<Eviction>(eviction);
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(std::string("is corrupt: ") + error.what());
    }
    return options;
  }

  static void write_voxels(const detail::VoxelStorage& storage, detail::ByteWriter& out) {
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
          storage, voxel, [&](std::uint32_t head) { write_surface(storage, head, out); });
    }
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
      const detail::VoxelStorage& storage, std::uint32_t head, detail::ByteWriter& out) {
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
    });
  }

  static void read_voxels(detail::ByteReader& in, VoxelMap& map) {
    detail::VoxelStorage& storage = map.storage_;
    const auto count = in.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) {
      detail::VoxelIndex index;
      for (int axis = 0; axis < 3; ++axis) {
        index[axis] = in.get<std::int32_t>();
        check(
            index[axis] >= -detail::kMaxVoxelIndex && index[axis] < detail::kMaxVoxelIndex,
            "is corrupt: voxel out of range");
      }
      const auto listed = in.get<std::uint32_t>();
      const auto stamp = in.get<std::uint32_t>();
      const int surfaces = in.get<std::uint8_t>();
      check(
          surfaces >= 1 && surfaces <= map.options_.max_surfaces, "is corrupt: number of surfaces");
      const std::uint32_t brick = storage.find_brick(detail::index_key(detail::brick_index(index)));
      check(
          storage.head_in(brick, detail::cell_in_brick(index)) == detail::kNone,
          "is corrupt: a voxel comes twice");
      check(
          !storage.voxels_exhausted() && !storage.bricks_exhausted() && !storage.chunks_exhausted(),
          "is corrupt: it holds more than its limits allow");
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
    storage.recency().begin_epoch();
  }

  static void read_surface(
      detail::ByteReader& in, VoxelMap& map, const detail::VoxelIndex& index, std::uint32_t head) {
    const int size = in.get<std::uint8_t>();
    check(size >= 1 && size <= map.options_.points_per_surface, "is corrupt: number of points");
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
          i % detail::kLanes != 0 || i == 0 || !map.storage_.chunks_exhausted(),
          "is corrupt: it holds more than its limits allow");
      last = map.storage_.append(head, last, point, normal);
    }
  }
};

namespace detail {

struct FileCloser {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

}  // namespace detail

/// Writes `map` to `path`: to a temporary file beside it first, so that no broken map is ever left
/// there. Throws std::runtime_error, naming the path, when it cannot be written.
inline void save_map(const VoxelMap& map, const std::string& path) {
  const std::vector<std::uint8_t> bytes = MapArchive::write(map);
  const std::string temporary = path + ".part";
  detail::File file(std::fopen(temporary.c_str(), "wb"));
  bool ok =
      file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  ok = file != nullptr && std::fclose(file.release()) == 0 && ok;
  if (!ok || std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove(temporary.c_str());
    throw std::runtime_error(path + ": cannot be written");
  }
}

/// Reads a map written by save_map(). Throws std::runtime_error, naming the path and what is wrong,
/// when the file cannot be read, is truncated, corrupt or something else.
inline VoxelMap load_map(const std::string& path) {
  const detail::File file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) {
    throw std::runtime_error(path + ": cannot be opened");
  }
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> block(std::size_t{1} << 20);
  for (std::size_t count = block.size(); count == block.size();) {
    count = std::fread(block.data(), 1, block.size(), file.get());
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
  }
  if (std::ferror(file.get()) != 0) {
    throw std::runtime_error(path + ": cannot be read");
  }
  try {
    return MapArchive::read(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace nvm
