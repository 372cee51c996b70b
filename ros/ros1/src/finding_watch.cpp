// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "finding_watch.hpp"

#include <algorithm>

namespace nvm_ros {

namespace {

/// The words before the first details, without numbers.
std::string kind_of(const std::string& finding) {
  std::string kind = finding.substr(0, finding.find_first_of(":;("));
  const auto is_of_number = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
  kind.erase(std::remove_if(kind.begin(), kind.end(), is_of_number), kind.end());
  return kind;
}

}  // namespace

std::vector<std::string> FindingWatch::new_ones(
    double time, const std::vector<std::string>& findings) {
  constexpr double kLasting = 5.0;  // [s]
  std::vector<std::string> found;
  std::map<std::string, Kind> kinds;
  for (const std::string& finding : findings) {
    const std::string name = kind_of(finding);
    Kind kind = kinds_.emplace(name, Kind{time}).first->second;
    if (!kind.is_said && time - kind.since >= kLasting) {
      kind.is_said = true;
      found.push_back(finding);
    }
    kinds[name] = kind;
  }
  for (const auto& [name, kind] : kinds_) {
    if (kind.is_said) {
      kinds.emplace(name, kind);
    }
  }
  kinds_ = std::move(kinds);
  return found;
}

}  // namespace nvm_ros
