// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/session_placer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nvm::merge {

namespace {

/// A line of sight through a wall weighs more than a point on one, which may be a gap in the map.
constexpr double kWeight = 10.0;
constexpr const char* kNoPlace =
    "does not overlap: no keyframe finds a place in the other sessions";

/// Whether the two put the point `center` of a session at about the same pose.
bool is_same(const Pose& a, const Pose& b, const Eigen::Vector3d& center) {
  constexpr double kNear = 0.4;   // [m]
  constexpr double kAlike = 0.1;  // [rad]
  return (a * center - b * center).norm() < kNear &&
         so3_log(a.linear().transpose() * b.linear()).norm() < kAlike;
}

/// A session that was placed for a trial, with what its points say.
struct Trial {
  SessionFit fit;
  lio::Testimonies testimonies;
};

/// Whether the points of a session tell `best` from `other` beyond doubt.
bool is_clearly_better(const Trial& best, const Trial& other) {
  constexpr double kTimes = 2.0;
  constexpr double kShare = 0.01;  // of all points
  const auto only = [](const Trial& a, const Trial& b, lio::Testimony testimony) {
    return static_cast<double>(lio::count_only(a.testimonies, b.testimonies, testimony));
  };
  using lio::Testimony;
  const double gain =
      only(best, other, Testimony::kFor) + kWeight * only(other, best, Testimony::kAgainst);
  const double loss =
      only(other, best, Testimony::kFor) + kWeight * only(best, other, Testimony::kAgainst);
  return gain > kTimes * loss + kShare * static_cast<double>(best.testimonies.size());
}

double merit(const SessionFit& fit) { return fit.overlap - kWeight * fit.contradiction; }

/// That `pose` is not where `guess` may have meant, which tells about 1 m and 5 degrees; empty when
/// it is.
std::string distance_from(const Pose& guess, const Pose& pose) {
  constexpr double kMostDistance = 3.0;  // [m]
  constexpr double kMostTurn = 0.4;      // [rad]
  constexpr double kDegrees = 57.29577951308232;
  const double distance = (pose.translation() - guess.translation()).norm();
  const double turn = so3_log(guess.linear().transpose() * pose.linear()).norm();
  if (distance <= kMostDistance && turn <= kMostTurn) {
    return "";
  }
  return fmt::format(
      "finds no place near the guess: it fits best {:.1f} m and {:.0f} degrees away from it, and a "
      "guess must be right to about 1 m and 5 degrees: mend it, or leave it out",
      distance,
      kDegrees * turn);
}

/// Why `fit` is not good enough; empty when it is. Rooms of another part of a building that lie on
/// those of the map contradict it by 1 % and more, a session at its place by 0.2 %. Somebody who
/// gives a guess may know of furniture that was moved.
std::string doubt(const SessionFit& fit, const std::optional<Pose>& guess) {
  constexpr std::size_t kLeastShared = 3;
  const double most_contradiction = guess ? 0.03 : 0.0075;
  if (fit.shared_keyframes < kLeastShared) {
    return fmt::format(
        "does not overlap: {} of {} keyframes lie on the other sessions, and {} must",
        fit.shared_keyframes,
        fit.keyframes,
        kLeastShared);
  }
  if (fit.contradiction > most_contradiction) {
    return fmt::format(
        "does not overlap, or much was moved: at the best place {:.1f} % of its lines of sight "
        "pass walls or furniture of the others, and {:.2f} % may",
        100.0 * fit.contradiction,
        100.0 * most_contradiction);
  }
  return guess ? distance_from(*guess, fit.T_map_session) : "";
}

}  // namespace

std::vector<std::size_t> voting_order(std::size_t keyframes) {
  constexpr std::size_t kMostVoters = 48;
  constexpr std::size_t kBits = 6;  // of the numbers that, with their bits reversed, are spread
  constexpr std::size_t kNumbers = std::size_t{1} << kBits;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < kNumbers && order.size() < kMostVoters && keyframes > 0; ++i) {
    std::size_t reversed = 0;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
      reversed |= (i >> bit & 1) << (kBits - 1 - bit);
    }
    const std::size_t keyframe = reversed * keyframes / kNumbers;
    if (std::find(order.begin(), order.end(), keyframe) == order.end()) {
      order.push_back(keyframe);
    }
  }
  return order;
}

SessionPlacer::SessionPlacer(const VoxelMap& map, const Executor& executor)
    : map_(map), executor_(executor), search_(map, executor) {}

SessionFit SessionPlacer::place(
    const std::vector<io::Keyframe>& keyframes, const std::optional<Pose>& guess) {
  constexpr std::size_t kFirstVoters = 12;
  const SessionBody body(keyframes);
  std::vector<Proposal> proposals;
  SessionFit fit;
  fit.why_not = kNoPlace;
  const std::vector<std::size_t> voters = voting_order(keyframes.size());
  std::size_t next_look = kFirstVoters;
  for (std::size_t i = 0; i < voters.size(); ++i) {
    propose(keyframes[voters[i]], guess, proposals);
    if (i + 1 == next_look || i + 1 == voters.size()) {
      next_look *= 2;
      fit = best_of(proposals, body, guess);
      if (fit.why_not.empty()) {
        return fit;
      }
    }
  }
  return fit;
}

void SessionPlacer::propose(
    const io::Keyframe& keyframe,
    const std::optional<Pose>& guess,
    std::vector<Proposal>& proposals) {
  const Pose T_lidar_session = keyframe.T_map_lidar.inverse();
  const Eigen::Vector3d up = keyframe.T_map_lidar.linear().row(2);
  std::vector<lio::Place> places;
  if (guess) {
    places.push_back(
        search_.near(keyframe.points, keyframe.normals, *guess * keyframe.T_map_lidar));
    if (!places.front().is_found()) {
      return;
    }
  } else {
    places = search_.candidates(keyframe.points, keyframe.normals, up);
  }
  const Eigen::Vector3d center = keyframe.T_map_lidar.translation();
  for (const lio::Place& place : places) {
    const Pose T_map_session = place.T_map_scan * T_lidar_session;
    const auto like = std::find_if(proposals.begin(), proposals.end(), [&](const Proposal& other) {
      return is_same(T_map_session, other.T_map_session, center);
    });
    if (like == proposals.end()) {
      proposals.push_back({T_map_session, 1});
    } else {
      ++like->votes;
    }
  }
}

SessionFit SessionPlacer::best_of(
    const std::vector<Proposal>& proposals,
    const SessionBody& body,
    const std::optional<Pose>& guess) const {
  constexpr std::size_t kMostTrials = 8;
  std::vector<Proposal> ranked = proposals;
  std::stable_sort(ranked.begin(), ranked.end(), [](const Proposal& a, const Proposal& b) {
    return a.votes > b.votes;
  });
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < std::min(kMostTrials, ranked.size()); ++i) {
    Trial trial{body.aligned(map_, ranked[i].T_map_session, executor_), {}};
    const bool is_new = std::none_of(trials.begin(), trials.end(), [&](const Trial& other) {
      return is_same(trial.fit.T_map_session, other.fit.T_map_session, body.center());
    });
    if (is_new) {
      trial.testimonies = body.testify(map_, trial.fit);
      trials.push_back(std::move(trial));
    }
  }
  if (trials.empty()) {
    SessionFit none;
    none.why_not = kNoPlace;
    return none;
  }
  const auto best =
      std::max_element(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
        return merit(a.fit) < merit(b.fit);
      });
  best->fit.why_not = doubt(best->fit, guess);
  for (auto other = trials.begin(); other != trials.end() && best->fit.why_not.empty(); ++other) {
    if (other != best && doubt(other->fit, guess).empty() && !is_clearly_better(*best, *other)) {
      best->fit.why_not = "fits at two places about equally well";
    }
  }
  return best->fit;
}

}  // namespace nvm::merge
