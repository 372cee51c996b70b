// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "config/value.hpp"
#include "io/file.hpp"
#include "io/left_out.hpp"
#include "io/line_reader.hpp"
#include "io/natural_order.hpp"
#include "io/scan_converter.hpp"
#include "io/trajectory_io.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

struct ScanFile {
  fs::path path;
  double time = 0.0;  ///< [s]
};

bool is_scan(const fs::path& path) {
  const std::string extension = extension_of(path.string());
  return extension == ".pcd" || extension == ".ply" || extension == ".bin";
}

std::vector<ScanFile> scans_in(const fs::path& folder) {
  std::vector<ScanFile> scans;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_scan(entry.path())) {
      scans.push_back({entry.path()});
    }
  }
  std::sort(scans.begin(), scans.end(), [](const ScanFile& a, const ScanFile& b) {
    return precedes_naturally(a.path.filename().string(), b.path.filename().string());
  });
  return scans;
}

std::vector<ScanFile> find_scans(const std::string& path) {
  for (const char* subfolder : {"", "scans", "velodyne"}) {
    const fs::path folder = fs::path(path) / subfolder;
    auto scans = fs::is_directory(folder) ? scans_in(folder) : std::vector<ScanFile>{};
    if (!scans.empty()) {
      return scans;
    }
  }
  fail(path, "has no .pcd, .ply or .bin scans, and no subfolder 'scans' or 'velodyne' with some");
}

/// The file `name` beside the scans or one folder above; empty without one.
std::string find_beside(const std::vector<ScanFile>& scans, const char* name) {
  const fs::path folder = fs::absolute(scans.front().path).parent_path();
  for (const fs::path& candidate : {folder / name, folder.parent_path() / name}) {
    if (fs::is_regular_file(candidate)) {
      return candidate.string();
    }
  }
  return {};
}

/// The scans that `timestamps.txt` lists, with its times and in its order.
std::vector<ScanFile> listed_scans(const std::vector<ScanFile>& scans, const std::string& path) {
  std::map<std::string, fs::path> paths;
  for (const ScanFile& scan : scans) {
    paths[scan.path.filename().string()] = scan.path;
  }
  std::vector<ScanFile> listed;
  LineReader lines(path);
  while (const auto words = lines.next()) {
    if (words->size() != 2) {
      lines.fail("is not of the form 'file time'");
    }
    const std::string name = fs::path(std::string((*words)[0])).filename().string();
    const double time = lines.number((*words)[1]);
    if (paths.count(name) == 0) {
      lines.fail("there is no scan " + quote(name));
    }
    if (!listed.empty() && time <= listed.back().time) {
      lines.fail("the time is not above the one before");
    }
    listed.push_back({paths[name], time});
  }
  return listed;
}

/// The time [s] that a file name without its extension spells; nothing when it is a mere number.
std::optional<double> time_of_name(const std::string& stem) {
  constexpr std::size_t kTimeDigits = 10;
  const bool is_digits = std::all_of(
      stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) || c == '.'; });
  const auto number = config::parse_number(stem);
  if (!is_digits || !number || (stem.size() < kTimeDigits && stem.find('.') == std::string::npos)) {
    return std::nullopt;
  }
  double time = *number;
  while (time > 1e11) {  // beyond the year 5000: the unit must be smaller by 1000
    time /= 1000.0;
  }
  return time;
}

/// Takes the times from the files' names; false, and no change, unless all are times.
bool set_times_by_name(std::vector<ScanFile>& scans) {
  std::vector<ScanFile> timed = scans;
  for (ScanFile& scan : timed) {
    const auto time = time_of_name(scan.path.stem().string());
    if (!time) {
      return false;
    }
    scan.time = *time;
  }
  std::sort(timed.begin(), timed.end(), [](const ScanFile& a, const ScanFile& b) {
    return a.time < b.time;
  });
  scans = std::move(timed);
  return true;
}

void set_times_by_line(std::vector<ScanFile>& scans, const std::string& path) {
  const std::vector<double> times = read_times(path);
  if (times.size() != scans.size()) {
    fail(
        path,
        "has " + std::to_string(times.size()) + " times for " + std::to_string(scans.size()) +
            " scans");
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].time = times[i];
  }
}

PointTimeOptions point_time_options(const SequenceOptions& options) {
  PointTimeOptions times;
  times.field = options.point_time_field;
  times.unit = options.point_time_unit;
  times.stamp = options.stamp;
  times.has_assumed_stamps = true;
  return times;
}

class ScanFolder : public SequenceReader {
 public:
  ScanFolder(const std::string& path, const SequenceOptions& options)
      : path_(path), scans_(find_scans(path)), converter_(point_time_options(options)) {
    set_times(options.scan_rate);
    learn_times();
    info_.format = "folder of " + extension_of(scans_.front().path.string()) + " scans";
    info_.scan_count = scans_.size();
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
    return info_;
  }

  std::optional<lio::Scan> next_scan() override {
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

  std::vector<lio::ImuSample> imu_until(double) override { return {}; }

 private:
  void set_times(double scan_rate) {
    if (const std::string list = find_beside(scans_, "timestamps.txt"); !list.empty()) {
      const std::size_t found = scans_.size();
      scans_ = listed_scans(scans_, list);
      if (scans_.empty()) {
        fail(list, "lists no scan");
      }
      if (scans_.size() < found) {
        info_.notes.push_back(
            fmt::format("{} scans without a time in {} are left out", found - scans_.size(), list));
      }
    } else if (const std::string times = find_beside(scans_, "times.txt"); !times.empty()) {
      set_times_by_line(scans_, times);
    } else if (!set_times_by_name(scans_)) {
      for (std::size_t i = 0; i < scans_.size(); ++i) {
        scans_[i].time = static_cast<double>(i) / scan_rate;
      }
      info_.notes.push_back(
          fmt::format("no times of the scans are known: {} Hz is assumed", scan_rate));
    }
  }

  lio::Scan read_scan(const ScanFile& file) {
    lio::Scan scan = converter_.convert(read_points(file.path.string()), file.time);
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
        first.push_back({scans_[i].time, read_points(scans_[i].path.string())});
        first.back().records.source = path_;
      } catch (const std::runtime_error&) {
        continue;  // next_scan() counts it
      }
    }
    converter_.learn(first);
    info_.has_point_times = converter_.has_point_times();
  }

  std::string path_;
  std::vector<ScanFile> scans_;
  ScanConverter converter_;
  LeftOut bad_scans_{"scans are"};
  mutable SequenceInfo info_;
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
