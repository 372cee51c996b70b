// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/change/change_votes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nvm::lio {

namespace {

std::uint64_t key_of(const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
  constexpr std::uint64_t kMask = (1U << 20) - 1;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  std::uint64_t key = static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0.0F ? 1 : 0));
  for (const double coordinate : position) {
    const auto cell = static_cast<std::int64_t>(std::floor(coordinate / ChangeVotes::kCell));
    key = (key << 20) | (static_cast<std::uint64_t>(cell) & kMask);
  }
  return key;
}

}  // namespace

void ChangeVotes::vote(const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
  constexpr std::size_t kMostEntries = 1'000'000;
  const std::uint64_t key = key_of(position, normal);
  auto found = entries_.find(key);
  if (found == entries_.end()) {
    if (entries_.size() == kMostEntries) {
      return;
    }
    found = entries_.emplace(key, Entry{position, normal}).first;
  }
  Entry& entry = found->second;
  entry.votes += entry.last_vote != scan_ ? 1 : 0;
  entry.last_vote = scan_;
}

void ChangeVotes::object(const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
  const auto found = entries_.find(key_of(position, normal));
  if (found != entries_.end()) {
    Entry& entry = found->second;
    entry.objections += entry.last_objection != scan_ ? 1 : 0;
    entry.last_objection = scan_;
  }
}

std::vector<ChangedSurface> ChangeVotes::elected() const {
  constexpr std::uint32_t kLeast = 3;  // scans
  constexpr std::uint32_t kTimes = 3;  // as many as object
  std::vector<std::pair<std::uint64_t, ChangedSurface>> elected;
  for (const auto& [key, entry] : entries_) {
    if (entry.votes >= kLeast && entry.votes >= kTimes * entry.objections) {
      // A plane passes through so many cells per area, on average.
      const double cells = static_cast<double>(entry.normal.cwiseAbs().sum()) / (kCell * kCell);
      elected.emplace_back(key, ChangedSurface{entry.position, entry.normal, 1.0 / cells});
    }
  }
  std::sort(elected.begin(), elected.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  std::vector<ChangedSurface> surfaces;
  surfaces.reserve(elected.size());
  for (const auto& [key, surface] : elected) {
    surfaces.push_back(surface);
  }
  return surfaces;
}

}  // namespace nvm::lio
