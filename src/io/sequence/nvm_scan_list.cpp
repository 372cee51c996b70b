// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/nvm_scan_list.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/median.hpp"
#include "io/file/csv_reader.hpp"
#include "io/file/file.hpp"
#include "io/file/stays_below.hpp"
#include "io/sequence/time_unit.hpp"

namespace nvm::io {

namespace {

namespace fs = std::filesystem;

/// The row of one scan; nothing at the end. Throws std::runtime_error for a bad row.
std::optional<ScanEntry> read_scan_row(CsvReader& rows, const std::string& folder) {
  const auto cells = rows.next();
  if (!cells) {
    return std::nullopt;
  }
  const ScanEntry entry{
      (fs::path(folder) / (*cells)[3]).string(),
      rows.line().number((*cells)[1]),
      rows.line().number((*cells)[2])};
  if (!stays_below(std::string((*cells)[3]))) {
    rows.line().fail("the file " + quote((*cells)[3]) + " is outside of the folder");
  }
  return entry;
}

}  // namespace

std::vector<ScanEntry> read_scan_list(const std::string& folder, LeftOut& bad_rows) {
  CsvReader rows(folder + "/scans.csv", {"index", "t_begin", "t_end", "file"});
  std::vector<ScanEntry> scans;
  while (true) {
    try {
      auto entry = read_scan_row(rows, folder);
      if (!entry) {
        return scans;
      }
      scans.push_back(std::move(*entry));
    } catch (const std::runtime_error& error) {
      bad_rows.add(error.what());
    }
  }
}

double scan_time_unit(const std::vector<ScanEntry>& scans) {
  constexpr double kLongestScan = 10.0;    // [s]
  constexpr double kLongestStep = 1000.0;  // of a scanner that is carried from place to place [s]
  std::vector<double> durations, steps;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    durations.push_back(scans[i].t_end - scans[i].t_begin);
    steps.push_back(i == 0 ? 0.0 : std::abs(scans[i].t_begin - scans[i - 1].t_begin));
  }
  if (scans.empty()) {
    return 1.0;
  }
  const double duration = median(std::move(durations));
  return duration > 0.0 ? time_unit(duration, kLongestScan)
                        : time_unit(median(std::move(steps)), kLongestStep);
}

}  // namespace nvm::io
