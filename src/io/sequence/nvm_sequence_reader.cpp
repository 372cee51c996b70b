// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/nvm_sequence_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>

#include "io/file/csv_reader.hpp"
#include "io/file/file.hpp"
#include "io/file/stays_below.hpp"
#include "io/sequence/imu_file.hpp"
#include "io/sequence/nvm_sequence_meta.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

// The records of scan files are TimedPoints as they lie in memory.
constexpr std::size_t kRecordSize = 24;
static_assert(sizeof(TimedPoint) == kRecordSize && offsetof(TimedPoint, ring) == 20);
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

constexpr double kNever = -std::numeric_limits<double>::infinity();

struct ScanEntry {
  std::string path;
  double t_begin = 0.0;
  double t_end = 0.0;
};

std::vector<ScanEntry> read_scan_list(const std::string& folder) {
  CsvReader rows(folder + "/scans.csv", {"index", "t_begin", "t_end", "file"});
  std::vector<ScanEntry> scans;
  double previous = kNever;
  while (const auto cells = rows.next()) {
    const double t_begin = rows.line().number((*cells)[1]);
    const double t_end = rows.line().number((*cells)[2]);
    if (t_begin <= previous) {
      rows.line().fail("t_begin is not above that of the scan before");
    }
    if (t_end < t_begin) {
      rows.line().fail("t_end is below t_begin");
    }
    const std::string file((*cells)[3]);
    if (!stays_below(file)) {
      rows.line().fail("the file " + quote(file) + " is outside of the folder");
    }
    previous = t_begin;
    scans.push_back({(fs::path(folder) / file).string(), t_begin, t_end});
  }
  return scans;
}

/// The number of points in a scan file of `size` bytes.
std::size_t point_count(const std::string& path, std::size_t size) {
  if (size % kRecordSize != 0) {
    fail(
        path,
        std::to_string(size) +
            " bytes are no whole number of 24-byte points: truncated, or another layout");
  }
  return size / kRecordSize;
}

std::size_t point_count(const std::vector<ScanEntry>& scans) {
  std::size_t points = 0;
  for (const ScanEntry& scan : scans) {
    std::error_code error;
    const std::size_t size = fs::file_size(scan.path, error);
    if (error) {
      fail(scan.path, "is missing: " + error.message());
    }
    points += point_count(scan.path, size);
  }
  return points;
}

Scan read_scan(const ScanEntry& entry) {
  const std::string bytes = read_file(entry.path);
  Scan scan{entry.t_begin, entry.t_end, {}};
  scan.points.resize(point_count(entry.path, bytes.size()));
  if (!bytes.empty()) {
    std::memcpy(static_cast<void*>(scan.points.data()), bytes.data(), bytes.size());
  }
  return scan;
}

/// Throws std::runtime_error unless the points are finite, in order of time and within the scan.
void check_points(const ScanEntry& entry, const Scan& scan) {
  constexpr double kSlack = 1e-3;
  const double duration = scan.t_end - scan.t_begin;
  double previous = -kSlack;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const TimedPoint& point = scan.points[i];
    const auto fail_here = [&](const std::string& problem) {
      fail(entry.path, "point " + std::to_string(i) + ": " + problem);
    };
    if (!std::isfinite(point.x + point.y + point.z)) {
      fail_here("a coordinate is not a finite number");
    }
    if (!(point.dt >= previous)) {
      fail_here("dt is below that of the point before: unsorted, or another layout");
    }
    if (!(point.dt <= duration + kSlack)) {
      fail_here("dt is after the scan's t_end");
    }
    previous = point.dt;
  }
}

class NvmSequence : public SequenceReader {
 public:
  explicit NvmSequence(const std::string& folder) : scans_(read_scan_list(folder)) {
    info_.format = "nvm sequence";
    info_.scan_count = scans_.size();
    info_.has_point_times = true;
    const std::string meta = folder + "/meta.json";
    apply(read_nvm_sequence_meta(meta), meta);
    info_.has_imu = fs::exists(folder + "/imu.csv");
    if (info_.has_imu) {
      imu_.emplace(folder + "/imu.csv");
    } else {
      info_.notes.emplace_back("there is no imu.csv: the sequence is read without IMU");
    }
    fixed_notes_ = info_.notes.size();
  }

  const SequenceInfo& info() const override { return info_; }

  std::optional<Scan> next_scan() override {
    if (next_ == scans_.size()) {
      return std::nullopt;
    }
    const ScanEntry& entry = scans_[next_++];
    Scan scan = read_scan(entry);
    check_points(entry, scan);
    return scan;
  }

  std::vector<ImuSample> imu_until(double time) override {
    if (!imu_) {
      return {};
    }
    auto samples = imu_->until(time);
    info_.notes.resize(fixed_notes_);
    info_.skipped_imu_samples = imu_->bad_rows().count();
    for (const auto& note : {imu_->bad_rows().note(), imu_->gaps().summary()}) {
      if (note) {
        info_.notes.push_back(*note);
      }
    }
    return samples;
  }

 private:
  void apply(const NvmSequenceMeta& meta, const std::string& path) {
    if (meta.T_imu_lidar) {
      info_.T_imu_lidar = *meta.T_imu_lidar;
      info_.has_T_imu_lidar = true;
    }
    const std::size_t points = point_count(scans_);
    if (meta.scans.value_or(scans_.size()) == scans_.size() &&
        meta.points.value_or(points) == points) {
      return;
    }
    const std::string problem = fmt::format(
        "\"counts\" differs from the {} scans with {} points that are there: a file is cut or lost",
        scans_.size(),
        points);
    if (meta.is_by_nvm) {  // others may count differently
      fail(path, problem);
    }
    info_.notes.push_back("meta.json: " + problem);
  }

  std::vector<ScanEntry> scans_;
  SequenceInfo info_;
  std::optional<ImuFile> imu_;
  std::size_t next_ = 0;
  std::size_t fixed_notes_ = 0;  ///< the notes before the one about IMU gaps
};

}  // namespace

bool is_nvm_sequence(const std::string& folder) { return fs::exists(folder + "/scans.csv"); }

std::unique_ptr<SequenceReader> open_nvm_sequence(const std::string& folder) {
  return std::make_unique<NvmSequence>(folder);
}

}  // namespace nvm::io
