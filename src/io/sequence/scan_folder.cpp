// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/scan_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>

#include "io/file/file.hpp"
#include "io/scan/repeat_watch.hpp"
#include "io/scan/scan_converter.hpp"
#include "io/sequence/left_out.hpp"
#include "io/sequence/scan_files.hpp"
#include "io/sequence/sequence_options.hpp"

namespace nvm::io {
namespace {

PointTimeOptions with_assumed_stamps(PointTimeOptions times) {
  times.has_assumed_stamps = true;
  return times;
}

class ScanFolder : public SequenceReader {
 public:
  ScanFolder(const std::string& path, const SequenceOptions& options)
      : path_(path),
        bin_fields_(options.bin_fields),
        scans_(find_scans(path, info_.notes)),
        converter_(with_assumed_stamps(point_time_options(options))) {
    date_scans(scans_, options.scan_rate, info_.notes);
    learn_times();
    info_.format = "folder of " + extension_of(scans_.front().path.string()) + " scans";
    info_.scan_count = scans_.size();
    if (std::filesystem::exists(path + "/imu.csv")) {
      info_.notes.emplace_back(
          "imu.csv is not read: it belongs to an nvm sequence, whose scans.csv is missing");
    }
    fixed_notes_ = info_.notes.size();
  }

  const SequenceInfo& info() const override {
    info_.skipped_scans = bad_scans_.count();
    info_.notes.resize(fixed_notes_);
    const auto notes = converter_.notes();
    info_.notes.insert(info_.notes.end(), notes.begin(), notes.end());
    if (const auto note = bad_scans_.note()) {
      info_.notes.push_back(*note);
    }
    if (!cut_files_.empty()) {
      info_.notes.push_back(fmt::format(
          "{} files are cut off, and read as far as they go; the first: {}",
          cut_files_.size(),
          *cut_files_.begin()));
    }
    return info_;
  }

  std::optional<Scan> next_scan() override {
    while (next_ < scans_.size()) {
      try {
        return read_scan(scans_[next_++]);
      } catch (const std::runtime_error& error) {
        bad_scans_.add(error.what());
      }
    }
    if (bad_scans_.count() == scans_.size()) {
      fail(path_, "no scan can be read: " + *bad_scans_.note());
    }
    return std::nullopt;
  }

  std::vector<ImuSample> imu_until(double) override { return {}; }

 private:
  PointRecords read(const ScanFile& file) const {
    PointRecords records = read_points(file.path.string(), bin_fields_);
    if (records.missing > 0) {
      cut_files_.insert(file.path.filename().string());
    }
    return records;
  }

  /// Files without header are read alike, as the first one is.
  void note_fields(const PointRecords& records, const ScanFile& file) {
    if (extension_of(file.path.string()) != ".bin" || bin_fields_ != 0 || records.size == 0 ||
        records.fields.back().count > 1) {
      return;
    }
    bin_fields_ = records.fields.size();
    std::string names;
    for (const Field& field : records.fields) {
      names += " " + field.name;
    }
    if (bin_fields_ != 4) {
      info_.notes.push_back(
          ".bin files are read as float32" + names +
          ", by their numbers; input.bin_fields sets it");
    }
  }

  Scan read_scan(const ScanFile& file) {
    const PointRecords records = read(file);
    if (repeats_.is_repeat(records.bytes)) {
      fail(file.path.string(), "has the points of the scan before");
    }
    Scan scan = converter_.convert(records, file.time);
    if (scan.t_begin <= previous_time_) {
      fail(file.path.string(), "begins no later than the scan before it");
    }
    previous_time_ = scan.t_begin;
    return scan;
  }

  /// Judges the points' times over the first scans, as any one of them may be bad.
  void learn_times() {
    constexpr std::size_t kCount = 5;
    std::vector<CloudMessage> first;
    for (std::size_t i = 0; i < std::min(kCount, scans_.size()); ++i) {
      try {
        first.push_back({scans_[i].time, read(scans_[i])});
        first.back().records.source = path_;
        note_fields(first.back().records, scans_[i]);
      } catch (const std::runtime_error&) {
        continue;  // next_scan() counts it
      }
    }
    converter_.learn(first);
    info_.has_point_times = converter_.has_point_times();
    info_.origin = converter_.origin();
  }

  mutable SequenceInfo info_;
  std::string path_;
  std::size_t bin_fields_;
  std::vector<ScanFile> scans_;
  ScanConverter converter_;
  RepeatWatch repeats_;
  LeftOut bad_scans_{"scans are"};
  mutable std::set<std::string> cut_files_;
  std::size_t fixed_notes_ = 0;  ///< the notes before those that change while reading
  std::size_t next_ = 0;
  double previous_time_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::unique_ptr<SequenceReader> open_scan_folder(
    const std::string& path, const SequenceOptions& options) {
  return std::make_unique<ScanFolder>(path, options);
}

}  // namespace nvm::io
