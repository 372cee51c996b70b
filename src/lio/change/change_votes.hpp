// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace nvm::lio {

/// A piece of a surface on which a map and later scans do not agree.
struct ChangedSurface {
  Eigen::Vector3d position;  ///< of one of its points [m], map frame
  Eigen::Vector3f normal;    ///< unit
  double area = 0.0;         ///< [m^2], about
};

/// What scans say for and against a change, for each cube of kCell and main direction of a surface.
/// A scan has one vote for each and one against each. Takes 120 MB at most.
class ChangeVotes {
 public:
  static constexpr double kCell = 0.1;  ///< [m]

  /// The next scan votes.
  void next_scan() { ++scan_; }
  /// For a change of the surface at `position` [m] with the unit `normal`.
  void vote(const Eigen::Vector3d& position, const Eigen::Vector3f& normal);
  /// Against it; of no effect where no scan has voted for it.
  void object(const Eigen::Vector3d& position, const Eigen::Vector3f& normal);

  /// Objects to all that has votes, but none of this scan, where `is_wrong(position)` says so.
  template <class Predicate>
  void object_where(const Predicate& is_wrong) {
    for (auto& [key, entry] : entries_) {
      if (entry.last_vote != scan_ && is_wrong(entry.position)) {
        entry.objections += 1;
      }
    }
  }

  /// On which enough scans agree, in an order that depends on nothing but the votes.
  std::vector<ChangedSurface> elected() const;

 private:
  struct Entry {
    Eigen::Vector3d position;
    Eigen::Vector3f normal;
    std::uint32_t votes = 0;
    std::uint32_t objections = 0;
    std::uint32_t last_vote = 0;  ///< scan
    std::uint32_t last_objection = 0;
  };

  std::unordered_map<std::uint64_t, Entry> entries_;
  std::uint32_t scan_ = 0;
};

}  // namespace nvm::lio
