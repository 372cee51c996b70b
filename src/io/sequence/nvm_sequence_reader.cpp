// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/nvm_sequence_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/file/file.hpp"
#include "io/scan/repeat_watch.hpp"
#include "io/sequence/imu_file.hpp"
#include "io/sequence/left_out.hpp"
#include "io/sequence/nvm_scan_list.hpp"
#include "io/sequence/nvm_sequence_meta.hpp"
#include "io/sequence/time_unit.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

// The records of scan files are TimedPoints as they lie in memory.
constexpr std::size_t kRecordSize = 24;
static_assert(sizeof(TimedPoint) == kRecordSize && offsetof(TimedPoint, ring) == 20);
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

/// The points of the whole files.
std::size_t point_count(const std::vector<ScanEntry>& scans) {
  std::size_t points = 0;
  for (const ScanEntry& scan : scans) {
    std::error_code error;
    const std::size_t size = fs::file_size(scan.path, error);
    points += error || size % kRecordSize != 0 ? 0 : size / kRecordSize;
  }
  return points;
}

std::vector<TimedPoint> points_of(const std::string& path, const std::string& bytes) {
  if (bytes.size() % kRecordSize != 0) {
    fail(
        path,
        std::to_string(bytes.size()) +
            " bytes are no whole number of 24-byte points: truncated, or another layout");
  }
  std::vector<TimedPoint> points(bytes.size() / kRecordSize);
  if (!bytes.empty()) {
    std::memcpy(static_cast<void*>(points.data()), bytes.data(), bytes.size());
  }
  return points;
}

/// Whether `t_end` contradicts the points, which last until after it, or the next scan, which
/// begins before it and after the last point: then the points know better.
bool is_end_wrong(const ScanEntry& entry, double last_point) {
  constexpr double kSlack = 1e-3;    // [s]
  constexpr double kLongest = 10.0;  // of a scan [s]
  const double end = entry.t_begin + last_point;
  const bool is_before = entry.t_end < std::max(entry.t_begin, end - kSlack);
  const bool is_after = entry.t_end > entry.next_begin + kSlack && end < entry.t_end - kSlack;
  return (is_before || is_after) && last_point >= 0.0 && last_point < kLongest &&
         end <= entry.next_begin + kSlack;
}

/// Throws std::runtime_error unless the points are in order of time and within the scan.
void check_times(const std::string& path, const Scan& scan) {
  constexpr double kSlack = 1e-3;
  const double duration = scan.t_end - scan.t_begin;
  double previous = -kSlack;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const float dt = scan.points[i].dt;
    const auto fail_here = [&](const std::string& problem) {
      fail(path, "point " + std::to_string(i) + ": " + problem);
    };
    if (!(dt >= previous)) {
      fail_here("dt is below that of the point before: unsorted, or another layout");
    }
    if (!(dt <= duration + kSlack)) {
      fail_here("dt is after the scan's t_end");
    }
    previous = dt;
  }
}

/// All points are as of the begin.
void forget_times(Scan& scan) {
  scan.t_end = scan.t_begin;
  for (TimedPoint& point : scan.points) {
    point.dt = 0.0F;
  }
}

/// Directions without return are often not-a-number.
void drop_no_returns(std::vector<TimedPoint>& points) {
  const auto is_nothing = [](const TimedPoint& point) {
    return !std::isfinite(point.x + point.y + point.z);
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_nothing), points.end());
}

class NvmSequence : public SequenceReader {
 public:
  NvmSequence(const std::string& folder, bool has_point_times)
      : path_(folder), scans_(read_scan_list(folder, bad_rows_)) {
    info_.format = "nvm sequence";
    info_.has_point_times = has_point_times;
    bring_in_order();
    info_.scan_count = scans_.size();
    if (fs::exists(folder + "/meta.json")) {
      apply(read_nvm_sequence_meta(folder + "/meta.json"));
    } else {
      info_.notes.emplace_back("there is no meta.json, which would tell T_imu_lidar");
    }
    info_.has_imu = fs::exists(folder + "/imu.csv");
    if (info_.has_imu) {
      imu_.emplace(folder + "/imu.csv");
      note_unit("imu.csv", imu_->unit());
    } else {
      info_.notes.emplace_back("there is no imu.csv: the sequence is read without IMU");
    }
    fixed_notes_ = info_.notes.size();
  }

  const SequenceInfo& info() const override { return info_; }

  std::optional<Scan> next_scan() override {
    while (next_ < scans_.size()) {
      try {
        return read_scan(scans_[next_++]);
      } catch (const std::runtime_error& error) {
        bad_scans_.add(error.what());
        renew_notes();
      }
    }
    if (bad_scans_.count() == scans_.size()) {
      fail(path_, "no scan can be read: " + bad_scans_.note().value_or("scans.csv has none"));
    }
    return std::nullopt;
  }

  std::vector<ImuSample> imu_until(double time) override {
    if (!imu_) {
      return {};
    }
    auto samples = imu_->until(time);
    info_.skipped_imu_samples = imu_->bad_rows().count();
    renew_notes();
    return samples;
  }

 private:
  void bring_in_order() {
    const double unit = scan_time_unit(scans_);
    note_unit("scans.csv", unit);
    for (ScanEntry& scan : scans_) {
      scan.t_begin *= unit;
      scan.t_end *= unit;
    }
    const auto is_earlier = [](const ScanEntry& a, const ScanEntry& b) {
      return a.t_begin < b.t_begin;
    };
    if (!std::is_sorted(scans_.begin(), scans_.end(), is_earlier)) {
      info_.notes.emplace_back("scans.csv is not in order of time: the scans are taken in it");
      std::stable_sort(scans_.begin(), scans_.end(), is_earlier);
    }
    for (std::size_t i = 1; i < scans_.size(); ++i) {
      scans_[i - 1].next_begin = scans_[i].t_begin;
      scans_[i].next_begin = 2.0 * scans_[i].t_begin - scans_[i - 1].t_begin;  // of the last
    }
    if (bad_rows_.count() > 0) {
      info_.notes.push_back(*bad_rows_.note());
    }
  }

  void note_unit(const std::string& file, double unit) {
    if (unit != 1.0) {
      info_.notes.push_back(time_unit_note(file, unit));
    }
  }

  void apply(const NvmSequenceMeta& meta) {
    if (meta.T_imu_lidar) {
      info_.T_imu_lidar = *meta.T_imu_lidar;
      info_.has_T_imu_lidar = true;
    }
    const std::size_t points = point_count(scans_);
    if (meta.scans.value_or(scans_.size()) != scans_.size() ||
        meta.points.value_or(points) != points) {
      info_.notes.push_back(fmt::format(
          "meta.json: \"counts\" differs from the {} scans with {} points that are there: a "
          "file is cut or lost",
          scans_.size(),
          points));
    }
  }

  Scan read_scan(const ScanEntry& entry) {
    if (entry.t_begin <= previous_) {
      fail(entry.path, "begins when the scan before it does");
    }
    const std::string bytes = read_file(entry.path);
    if (repeats_.is_repeat(bytes)) {
      fail(entry.path, "has the points of the scan before");
    }
    Scan scan{entry.t_begin, entry.t_end, points_of(entry.path, bytes)};
    if (!scan.points.empty() && is_end_wrong(entry, scan.points.back().dt)) {
      scan.t_end = entry.t_begin + scan.points.back().dt;
      ++wrong_ends_;
      renew_notes();
    }
    check_times(entry.path, scan);
    drop_no_returns(scan.points);
    if (!info_.has_point_times) {
      forget_times(scan);
    }
    previous_ = entry.t_begin;
    return scan;
  }

  void renew_notes() {
    info_.notes.resize(fixed_notes_);
    std::vector<std::optional<std::string>> notes = {bad_scans_.note()};
    if (wrong_ends_ > 0) {
      notes.emplace_back(fmt::format(
          "scans.csv: the t_end of {} scans contradicts the times of their points or the next "
          "scan's t_begin: the last point's time is taken",
          wrong_ends_));
    }
    if (imu_) {
      notes.push_back(imu_->bad_rows().note());
      notes.push_back(imu_->order_note());
      notes.push_back(imu_->gaps().summary());
    }
    for (const auto& note : notes) {
      if (note) {
        info_.notes.push_back(*note);
      }
    }
  }

  std::string path_;
  LeftOut bad_rows_{"rows of scans.csv are"};
  std::vector<ScanEntry> scans_;
  SequenceInfo info_;
  std::optional<ImuFile> imu_;
  RepeatWatch repeats_;
  LeftOut bad_scans_{"scans are"};
  std::size_t wrong_ends_ = 0;
  std::size_t next_ = 0;
  double previous_ = -std::numeric_limits<double>::infinity();  ///< begin of the last scan [s]
  std::size_t fixed_notes_ = 0;  ///< the notes before those that change while reading
};

}  // namespace

bool is_nvm_sequence(const std::string& folder) { return fs::exists(folder + "/scans.csv"); }

std::unique_ptr<SequenceReader> open_nvm_sequence(const std::string& folder, bool has_point_times) {
  return std::make_unique<NvmSequence>(folder, has_point_times);
}

}  // namespace nvm::io
