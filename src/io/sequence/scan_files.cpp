// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/scan_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "io/file/file.hpp"
#include "io/file/natural_order.hpp"
#include "io/sequence/scan_times.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

std::vector<ScanFile> scans_in(const fs::path& folder) {
  std::vector<ScanFile> scans;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_scan_file(entry.path().string())) {
      scans.push_back({entry.path()});
    }
  }
  std::sort(scans.begin(), scans.end(), [](const ScanFile& a, const ScanFile& b) {
    return precedes_naturally(a.path.filename().string(), b.path.filename().string());
  });
  return scans;
}

/// A file's name with each number as '#'.
std::string pattern_of(const fs::path& path) {
  std::string pattern;
  for (const char c : path.filename().string()) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) {
      pattern += c;
    } else if (pattern.empty() || pattern.back() != '#') {
      pattern += '#';
    }
  }
  return pattern;
}

bool is_output_of_nvm(const fs::path& path) {
  return path.stem() == "map" && fs::exists(path.parent_path() / "map.nvm");
}

/// Leaves out the files that are named unlike more than half of them, and nvm's own maps.
void leave_out_strays(std::vector<ScanFile>& scans, std::vector<std::string>& notes) {
  std::map<std::string, std::size_t> counts;
  for (const ScanFile& scan : scans) {
    ++counts[pattern_of(scan.path)];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      });
  const bool has_form = most != counts.end() && most->first.find('#') != std::string::npos &&
                        2 * most->second > scans.size();
  std::string names;
  const auto is_stray = [&](const ScanFile& scan) {
    const bool is_odd = has_form && pattern_of(scan.path) != most->first;
    if (is_odd || is_output_of_nvm(scan.path)) {
      names += (names.empty() ? "" : ", ") + scan.path.filename().string();
      return true;
    }
    return false;
  };
  scans.erase(std::remove_if(scans.begin(), scans.end(), is_stray), scans.end());
  if (!names.empty()) {
    notes.push_back("not named as the scans, and left out: " + names);
  }
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

}  // namespace

bool is_scan_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".pcd" || extension == ".ply" || extension == ".bin";
}

std::vector<ScanFile> find_scans(const std::string& path, std::vector<std::string>& notes) {
  if (!fs::is_directory(path)) {
    return {{path}};
  }
  for (const char* subfolder :
       {"",
        "scans",
        "velodyne",
        "velodyne_points/data",
        "velodyne_points",
        "data",
        "lidar",
        "pcd",
        "bin"}) {
    const fs::path folder = fs::path(path) / subfolder;
    auto scans = fs::is_directory(folder) ? scans_in(folder) : std::vector<ScanFile>{};
    leave_out_strays(scans, notes);
    if (!scans.empty()) {
      return scans;
    }
  }
  fail(
      path,
      "has no .pcd, .ply or .bin scans, no subfolder 'scans' or 'velodyne' with some, and no .bag");
}

void date_scans(std::vector<ScanFile>& scans, double scan_rate, std::vector<std::string>& notes) {
  const std::size_t found = scans.size();
  if (const std::string list = find_beside(scans, "timestamps.txt"); !list.empty()) {
    date_by_list(scans, list);
    if (scans.empty()) {
      fail(list, "lists no scan");
    }
    if (scans.size() < found) {
      notes.push_back(
          fmt::format("{} scans without a time in {} are left out", found - scans.size(), list));
    }
  } else if (const std::string times = find_beside(scans, "times.txt"); !times.empty()) {
    date_by_line(scans, times);
  } else if (!date_by_name(scans)) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      scans[i].time = static_cast<double>(i) / scan_rate;
    }
    notes.push_back(fmt::format(
        "no times of the scans are known: {} Hz is assumed (input.scan_rate)", scan_rate));
  }
}

}  // namespace nvm::io
