// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "io/file/file.hpp"
#include "io/sequence/nvm_sequence_writer.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"

namespace nvm::io {

inline constexpr char kMeta[] = R"({
  "format": "nvm sequence", "version": 1, "more": {"of": ["anything"]},
  "T_imu_lidar": {"translation": [0.1, -2e-1, 3], "quaternion_xyzw": [0, 0, 1, 0]},
  "counts": {"scans": 3, "points": 12}
})";

inline Scan some_scan(double t_begin) {
  Scan scan{t_begin, t_begin + 0.1, {}};
  for (int i = 0; i < 4; ++i) {
    const float value = static_cast<float>(i);
    scan.points.push_back(
        {1.0F + value, -value, 0.5F, 10.0F * value, 0.03F * value, static_cast<std::uint16_t>(i)});
  }
  return scan;
}

inline std::vector<ImuSample> some_imu() {
  std::vector<ImuSample> samples;
  for (int i = 0; i < 250; ++i) {
    samples.push_back({10.0 + 0.005 * i, {0.1, -0.2, 1e-9 * i}, {0.0, 0.0, 9.81}});
  }
  return samples;
}

/// A small sequence in a folder, to be read or damaged.
class NvmSequence : public test::TemporaryFolder {
 protected:
  /// Writes a sequence of three scans of four points, at 10.0, 10.1 and 10.2 s.
  void SetUp() override {
    TemporaryFolder::SetUp();
    NvmSequenceWriter writer(path("s"));
    for (const double time : {10.0, 10.1, 10.2}) {
      writer.add_scan(some_scan(time));
    }
    const auto imu = some_imu();
    writer.write_imu({imu.begin(), imu.begin() + 100});
    writer.write_imu({imu.begin() + 100, imu.end()});
    writer.write_groundtruth({{10.0, Pose::Identity()}});
    writer.write_text("meta.json", kMeta);
    writer.commit();
  }

  /// Reads everything and gives the notes.
  std::vector<std::string> read() const {
    const auto reader = open_sequence(path("s"));
    while (const auto scan = reader->next_scan()) {
      reader->imu_until(scan->t_end);
    }
    reader->imu_until(1e9);
    return reader->info().notes;
  }

  std::string error() const {
    return test::runtime_error_of([&] { read(); });
  }

  /// Replaces the first `from` in a file of the sequence.
  void edit(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read_file(path("s/" + name));
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    write("s/" + name, text.replace(at, from.size(), to));
  }

  /// Overwrites one float of a record of the second scan.
  void poke(std::size_t point, std::size_t float_index, float value) const {
    std::string bytes = read_file(path("s/scans/000001.bin"));
    std::memcpy(&bytes[24 * point + 4 * float_index], &value, sizeof(value));
    write("s/scans/000001.bin", bytes);
  }
};

}  // namespace nvm::io
