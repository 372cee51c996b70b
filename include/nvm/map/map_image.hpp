// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/map/map_archive.hpp"
#include "nvm/map/storage/image_file.hpp"
#include "nvm/map/storage/image_state.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm {
inline namespace NVM_TARGET {

// The file: a page with the header; the state: an archive of the empty map, which has its options,
// and the numbers that VoxelStorage::visit_state() shows; its arrays, in that order. Each begins on
// a page.

/// Writes and maps images of a VoxelMap, which is `Map`; see save_map_image() and load_map().
template <class Map>
class BasicMapImage {
 public:
  /// Whether all was written.
  static bool write(const Map& map, std::FILE* file) {
    detail::StateWriter state;
    detail::VoxelStorage::visit_state(map.engine_.storage(), state);
    const std::vector<std::uint8_t> archive = Archive::write(Map(map.options()));
    const std::size_t number_bytes = state.numbers.size() * sizeof(std::uint64_t);
    std::vector<std::uint8_t> head(archive.size() + number_bytes);
    std::memcpy(head.data(), archive.data(), archive.size());
    std::memcpy(head.data() + archive.size(), state.numbers.data(), number_bytes);

    const std::uint8_t room[detail::kImagePage] = {};
    bool ok = std::fwrite(room, 1, sizeof(room), file) == sizeof(room);
    detail::ImageOutput output(file);
    output.write(head.data(), head.size());
    for (const detail::StateWriter::Part& array : state.arrays) {
      output.write(array.data, array.bytes);
    }
    const Header header{
        kMagic,
        kVersion,
        layout(),
        archive.size(),
        state.numbers.size(),
        output.checksum().value()};
    ok = ok && output.ok() && std::fseek(file, 0, SEEK_SET) == 0;
    return ok && std::fwrite(&header, sizeof(header), 1, file) == 1;
  }

  static bool is_image(const detail::ImageFile& file) {
    return file.size() >= detail::kImagePage && header_of(file).magic == kMagic;
  }

  /// Throws std::runtime_error, saying what is wrong.
  static Map read(const detail::ImageFile& file) {
    check(is_image(file), "is not an image of an nvm map");
    const Header header = header_of(file);
    check(
        header.version == kVersion && header.layout == layout(),
        "is the image of a map for another nvm or processor: export map.nvm again");
    const std::size_t room = file.size() - detail::kImagePage;
    check(
        header.archive_bytes <= room &&
            header.number_count <= (room - header.archive_bytes) / sizeof(std::uint64_t),
        "is truncated");
    const auto archive_bytes = static_cast<std::size_t>(header.archive_bytes);
    std::vector<std::uint64_t> numbers(static_cast<std::size_t>(header.number_count));
    const std::size_t number_bytes = numbers.size() * sizeof(std::uint64_t);
    std::vector<std::uint8_t> head(detail::whole_pages(archive_bytes + number_bytes));
    file.read(detail::kImagePage, head.data(), head.size());
    std::memcpy(numbers.data(), head.data() + archive_bytes, number_bytes);
    Map map = Archive::read({head.data(), head.data() + archive_bytes});
    detail::PageChecksum checksum;
    checksum.add(head.data(), head.size());
    detail::StateReader state(file, std::move(numbers), detail::kImagePage + head.size(), checksum);
    detail::VoxelStorage::visit_state(map.engine_.storage(), state);
    check(state.is_done(), "does not end where it should");
    check(state.checksum().value() == header.checksum, "is corrupt: its checksum is wrong");
    return map;
  }

 private:
  using Archive = BasicMapArchive<Map>;

  struct Header {
    std::uint64_t magic;
    std::uint32_t version;
    std::uint32_t layout;
    std::uint64_t archive_bytes;
    std::uint64_t number_count;
    std::uint64_t checksum;  ///< of all that follows
  };

  static constexpr std::uint64_t kMagic = 0x0a0d474d494d564eULL;  // "NVMIMG\r\n"
  static constexpr std::uint32_t kVersion = 2;

  static void check(bool ok, const char* problem) {
    if (!ok) {
      throw std::runtime_error(problem);
    }
  }

  static Header header_of(const detail::ImageFile& file) {
    Header header;
    file.read(0, &header, sizeof(header));
    return header;
  }

  /// Another number where arrays are laid out in another way. A processor of the other byte order
  /// reads another magic.
  static std::uint32_t layout() {
    std::size_t sum = 0;
    for (const std::size_t size :
         {sizeof(std::size_t),
          sizeof(detail::Brick),
          sizeof(detail::BrickTableShard::Slot),
          sizeof(detail::PointChunk),
          sizeof(detail::NormalChunk),
          detail::Recency::bytes(1)}) {
      sum = 31 * sum + size;
    }
    return static_cast<std::uint32_t>(sum);
  }
};

using MapImage = BasicMapImage<VoxelMap>;

}  // namespace NVM_TARGET
}  // namespace nvm
