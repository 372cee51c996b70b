// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/place_judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

namespace nvm::lio {

namespace {

/// Where nobody says where to look, so much of the scan must fit.
constexpr double kMinJudgedShare = 0.75;
/// A point that lies on nothing may do so because the map has a gap; one whose line of sight passes
/// a wall has no such excuse, and weighs so many times as much.
constexpr double kWeight = 20.0;

/// A place with what the points of the scan say of it.
struct Hearing {
  Place place;
  Testimonies testimonies;

  double merit() const {
    return static_cast<double>(count(testimonies, Testimony::kFor)) -
           kWeight * static_cast<double>(count(testimonies, Testimony::kAgainst));
  }
};

std::vector<Hearing> heard(
    const std::vector<Place>& places, const VoxelMap& map, const ScanWitness& witness) {
  constexpr std::size_t kMost = 16;
  constexpr double kWorthHearing = 0.15;  // of the share, below the best
  std::vector<Hearing> hearings;
  for (const Place& place : places) {
    if (hearings.size() < kMost && place.share > places.front().share - kWorthHearing) {
      hearings.push_back({place, witness.testify(map, place.T_map_scan)});
    }
  }
  return hearings;
}

/// Whether all that is known agrees that `a` is the one: how well the scan lies there, and what its
/// points say.
bool is_clearly_better(const Hearing& a, const Hearing& b) {
  constexpr double kTimes = 2.0;
  constexpr double kLeast = 100.0;
  const auto only = [](const Hearing& one, const Hearing& other, Testimony testimony) {
    return static_cast<double>(count_only(one.testimonies, other.testimonies, testimony));
  };
  const double against_a = only(a, b, Testimony::kAgainst);
  const double against_b = only(b, a, Testimony::kAgainst);
  const double gain = kWeight * against_b + only(a, b, Testimony::kFor);
  const double loss = kWeight * against_a + only(b, a, Testimony::kFor);
  return a.place.cost <= b.place.cost && against_b >= against_a && gain >= kTimes * loss + kLeast;
}

/// Why `best` is in doubt though nothing looks like it; empty when it is not.
std::string doubt(const Hearing& best) {
  constexpr double kMostAgainst = 0.01;
  const double against = static_cast<double>(count(best.testimonies, Testimony::kAgainst)) /
                         static_cast<double>(best.testimonies.size());
  if (best.place.share < kMinJudgedShare) {
    return "at the best place " + misfit(best.place.share, kMinJudgedShare);
  }
  if (best.place.open_directions > 0) {
    return "the scan does not tell all directions of its pose, as in a corridor";
  }
  if (against > kMostAgainst) {
    std::ostringstream text;
    text << "at the best place " << std::round(1000.0 * against) / 10.0
         << " % of the lines of sight pass walls or furniture of the map, and 1 % may";
    return text.str();
  }
  return "";
}

}  // namespace

std::string misfit(double share, double min_share) {
  std::ostringstream text;
  text << std::round(100.0 * share) << " % of the scan fit the map there, and "
       << std::round(100.0 * min_share) << " % must";
  return text.str();
}

Place judged(const std::vector<Place>& places, const VoxelMap& map, const ScanWitness& witness) {
  const std::vector<Hearing> hearings = heard(places, map, witness);
  const auto best =
      std::max_element(hearings.begin(), hearings.end(), [](const Hearing& a, const Hearing& b) {
        return a.merit() < b.merit();
      });
  Place place = best->place;
  place.why_not = doubt(*best);
  const auto rivals = std::count_if(hearings.begin(), hearings.end(), [&](const Hearing& other) {
    return &other != &*best && !is_clearly_better(*best, other);
  });
  if (place.is_found() && rivals > 0) {
    place.why_not =
        std::to_string(rivals + 1) +
        " places look alike: show the sensor more of the surroundings, or give the start";
  }
  return place;
}

}  // namespace nvm::lio
