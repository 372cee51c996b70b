// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/scan_times.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "config/value.hpp"
#include "io/file/file.hpp"
#include "io/file/line_reader.hpp"
#include "io/file/natural_order.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

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

/// The time [s] of "2011-09-26" and "13:02:25.594360375", UTC; nothing for other words.
std::optional<double> time_of_date(std::string_view date, std::string_view clock) {
  const auto number = [](std::string_view text, std::size_t at, std::size_t size) {
    return at <= text.size() ? config::parse_number(text.substr(at, size)) : std::nullopt;
  };
  const auto year = number(date, 0, 4);
  const auto month = number(date, 5, 2);
  const auto day = number(date, 8, 2);
  const auto hour = number(clock, 0, 2);
  const auto minute = number(clock, 3, 2);
  const auto second = number(clock, 6, clock.size());
  constexpr std::size_t kDateSize = 10;
  if (date.size() != kDateSize || !year || !month || !day || !hour || !minute || !second) {
    return std::nullopt;
  }
  std::tm time{};
  time.tm_year = static_cast<int>(*year) - 1900;
  time.tm_mon = static_cast<int>(*month) - 1;
  time.tm_mday = static_cast<int>(*day);
  time.tm_hour = static_cast<int>(*hour);
  time.tm_min = static_cast<int>(*minute);
  return static_cast<double>(timegm(&time)) + *second;
}

/// The times of the lines of a date or a number each; nothing when the first line has another form.
std::optional<std::vector<double>> times_by_line(const std::string& path) {
  LineReader lines(path);
  std::vector<double> times;
  while (const auto words = lines.next()) {
    const auto time = words->size() == 2   ? time_of_date((*words)[0], (*words)[1])
                      : words->size() == 1 ? config::parse_number((*words)[0])
                                           : std::nullopt;
    if (!time || !std::isfinite(*time)) {
      if (times.empty()) {
        return std::nullopt;
      }
      lines.fail("is no time as in the lines before");
    }
    if (!times.empty() && *time <= times.back()) {
      lines.fail("the time is not above the one before");
    }
    times.push_back(*time);
  }
  return times.empty() ? std::nullopt : std::optional(times);
}

void set_times(
    std::vector<ScanFile>& scans, const std::vector<double>& times, const std::string& path) {
  const auto number_of = [](const ScanFile& scan) {
    return parse_whole_number(scan.path.stem().string());
  };
  const auto is_line = [&](const ScanFile& scan) {
    const auto number = number_of(scan);
    return number && *number < times.size();
  };
  const bool names_are_lines = std::all_of(scans.begin(), scans.end(), is_line);
  if (times.size() != scans.size() && !(names_are_lines && times.size() > scans.size())) {
    fail(
        path,
        "has " + std::to_string(times.size()) + " times for " + std::to_string(scans.size()) +
            " scans");
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].time = times[times.size() == scans.size() ? i : *number_of(scans[i])];
  }
}

/// The time [s] of a whole number of s, ms, us or ns since 1970; nothing for a count.
std::optional<double> epoch_time(double number) {
  constexpr double kFirst = 1e8;        // [s]: 1973
  constexpr double kThousandth = 1e11;  // [s]: beyond the year 5000 the unit must be smaller
  while (number > kThousandth) {
    number /= 1000.0;
  }
  return number >= kFirst ? std::optional(number) : std::nullopt;
}

/// The time [s] that a name without its extension spells, behind any letters; nothing without one.
std::optional<double> time_of_name(std::string_view stem) {
  const auto begin = std::find_if(stem.begin(), stem.end(), [&](const char& c) {
    constexpr std::size_t kTimeDigits = 9;
    const auto rest = stem.substr(static_cast<std::size_t>(&c - stem.data()));
    const auto run = std::find_if_not(rest.begin(), rest.end(), is_digit) - rest.begin();
    const auto digits = static_cast<std::size_t>(run);
    return digits >= kTimeDigits || (digits > 0 && digits < rest.size() && rest[digits] == '.');
  });
  const std::string_view time = stem.substr(static_cast<std::size_t>(begin - stem.begin()));
  const auto end = std::find_if_not(time.begin(), time.end(), is_digit);
  const std::string_view whole = time.substr(0, static_cast<std::size_t>(end - time.begin()));
  const std::string_view rest = time.substr(whole.size());
  const auto seconds = config::parse_number(whole);
  if (!seconds) {
    return std::nullopt;
  }
  if (rest.empty()) {
    return epoch_time(*seconds);
  }
  const auto fraction = parse_whole_number(rest.substr(1));
  if (!fraction) {
    return std::nullopt;
  }
  if (rest[0] == '.') {
    return config::parse_number(time);
  }
  constexpr std::size_t kNanosecondDigits = 10;
  const bool is_pair = (rest[0] == '_' || rest[0] == '-') && rest.size() <= kNanosecondDigits;
  return is_pair && epoch_time(*seconds) == seconds
             ? std::optional(*seconds + 1e-9 * static_cast<double>(*fraction))
             : std::nullopt;
}

}  // namespace

void date_by_list(std::vector<ScanFile>& scans, const std::string& path) {
  if (const auto times = times_by_line(path)) {
    set_times(scans, *times, path);
  } else {
    scans = listed_scans(scans, path);
  }
}

void date_by_line(std::vector<ScanFile>& scans, const std::string& path) {
  set_times(scans, read_times(path), path);
}

bool date_by_name(std::vector<ScanFile>& scans) {
  std::vector<ScanFile> dated = scans;
  for (ScanFile& scan : dated) {
    const auto time = time_of_name(scan.path.stem().string());
    if (!time) {
      return false;
    }
    scan.time = *time;
  }
  std::sort(dated.begin(), dated.end(), [](const ScanFile& a, const ScanFile& b) {
    return a.time < b.time;
  });
  const auto repeated =
      std::adjacent_find(dated.begin(), dated.end(), [](const ScanFile& a, const ScanFile& b) {
        return a.time == b.time;
      });
  if (repeated != dated.end()) {
    return false;
  }
  scans = std::move(dated);
  return true;
}

}  // namespace nvm::io
