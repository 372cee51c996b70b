// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

namespace nvm::lio {

namespace {

constexpr KeypointOptions kKeypoints{0.35, 1500};
constexpr std::size_t kMinKeypoints = 100;
constexpr const char* kTooFew = "the scan shows too few surfaces";
/// Furniture that was moved and people are in the way of some of a scan, never of most of it.
constexpr double kMinShare = 0.6;
/// Where nobody says where to look, more of it must fit, and at any other place it must lie so many
/// times farther off.
constexpr double kMinShareAnywhere = 0.75;
constexpr double kMaxRivalry = 1.5;

/// A coarse alignment leaves a few centimetres, as does a scan made in motion.
AlignOptions fine_options() {
  AlignOptions align;
  align.association.neighbors = 8;
  align.association.max_neighbor_distance = 0.6;
  align.association.max_plane_distance = 0.15;
  align.kernel.scale = 0.05;
  return align;
}

std::vector<Pose> around(const Pose& guess) {
  constexpr double kStep = 0.7;  // [m]
  constexpr double kTurn = 0.3;  // [rad]
  std::vector<Pose> guesses;
  for (const double turn : {0.0, -kTurn, kTurn}) {
    for (const auto& [x, y] :
         {std::pair(0.0, 0.0), {kStep, 0.0}, {-kStep, 0.0}, {0.0, kStep}, {0.0, -kStep}}) {
      guesses.push_back(guess);
      guesses.back().pretranslate(Eigen::Vector3d(x, y, 0.0));
      guesses.back().linear() = so3_exp({0.0, 0.0, turn}) * guess.linear();
    }
  }
  return guesses;
}

std::string misfit(double share, double min_share) {
  std::ostringstream text;
  text << std::round(100.0 * share) << " % of the scan fit the map there, and "
       << std::round(100.0 * min_share) << " % must";
  return text.str();
}

bool is_elsewhere(const Pose& a, const Pose& b) {
  constexpr double kFar = 0.5;     // [m]
  constexpr double kTurned = 0.2;  // [rad]
  return (a.translation() - b.translation()).norm() > kFar ||
         so3_log(a.linear().transpose() * b.linear()).norm() > kTurned;
}

/// The best of `places`, found unless another one is about as good, or it slides.
Place judged(const std::vector<Place>& places) {
  Place best = places.front();
  const auto rival = std::find_if(places.begin(), places.end(), [&](const Place& place) {
    return is_elsewhere(place.T_map_scan, best.T_map_scan);
  });
  if (best.share < kMinShareAnywhere) {
    best.why_not = "at the best place " + misfit(best.share, kMinShareAnywhere);
  } else if (best.open_directions > 0) {
    best.why_not = "the scan does not tell all directions of its pose, as in a corridor";
  } else if (rival != places.end() && rival->cost < kMaxRivalry * best.cost) {
    best.why_not = "two places look alike: show the sensor more of the surroundings";
  }
  return best;
}

}  // namespace

PlaceSearch::PlaceSearch(const VoxelMap& map, const Executor& executor)
    : map_(map),
      executor_(executor),
      sampler_(kKeypoints),
      coarse_(StartSearchOptions{}, executor),
      aligner_(fine_options()) {
  coarse_.insert(map);
  map.for_each_point(
      [&](const MapPoint& point) { outline_.add(point.position, point.normal.cast<double>()); });
}

Place PlaceSearch::near(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan) {
  if (!choose_keypoints(points, normals)) {
    return {T_map_scan, 0.0, 1.0, 0, kTooFew};
  }
  Place place = places_from({T_map_scan}).front();
  if (place.share < kMinShare) {
    place = places_from(around(T_map_scan)).front();
  }
  place.why_not = place.share >= kMinShare ? "" : misfit(place.share, kMinShare);
  return place;
}

bool PlaceSearch::choose_keypoints(
    const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals) {
  const std::vector<std::uint32_t>& keypoints = sampler_.sample(points, normals);
  pick(points, keypoints, key_points_);
  pick(normals, keypoints, key_normals_);
  return key_points_.size() >= kMinKeypoints;
}

/// Levelled, the scan must agree with the map's walls, floors and ceilings.
std::vector<Pose> PlaceSearch::guesses_for(const Eigen::Matrix3d& R_level_scan) const {
  constexpr std::size_t kMostHeights = 5;
  constexpr std::size_t kMostPoints = 120;
  constexpr std::size_t kMostPlaces = 80;
  Outline scan;
  for (std::size_t i = 0; i < key_points_.size(); ++i) {
    scan.add(
        R_level_scan * key_points_[i].cast<double>(),
        R_level_scan * key_normals_[i].cast<double>());
  }
  const std::vector<Outline::Upright>& upright = scan.walls();
  std::vector<WallPoint> walls;
  for (std::size_t i = 0; i < std::min(kMostPoints, upright.size()); ++i) {
    walls.push_back(upright[i * upright.size() / std::min(kMostPoints, upright.size())].wall);
  }
  std::vector<std::pair<std::size_t, Pose>> ranked;
  for (const double height : outline_.heights_of(scan, kMostHeights)) {
    for (const PlanarPlace& place :
         outline_.grid_for(scan, height).search(walls, kMostPlaces, walls.size() / 2)) {
      Pose guess = Pose::Identity();
      guess.linear() = so3_exp({0.0, 0.0, place.heading}) * R_level_scan;
      guess.translation() << place.position, height;
      ranked.emplace_back(place.hits, guess);
    }
  }
  std::stable_sort(
      ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Pose> guesses;
  for (std::size_t i = 0; i < std::min(kMostPlaces, ranked.size()); ++i) {
    guesses.push_back(ranked[i].second);
  }
  return guesses;
}

Place PlaceSearch::anywhere(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Eigen::Vector3d& up) {
  if (!choose_keypoints(points, normals)) {
    return {Pose::Identity(), 0.0, 1.0, 0, kTooFew};
  }
  const Eigen::Matrix3d R_level_scan =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const std::vector<Place> places = places_from(guesses_for(R_level_scan));
  return places.empty() ? Place{Pose::Identity(), 0.0, 1.0, 0, "no place has such walls"}
                        : judged(places);
}

Place PlaceSearch::refined(const Pose& T_map_scan) {
  const AlignResult aligned =
      aligner_.align(map_, key_points_, key_normals_, T_map_scan, executor_);
  return {
      aligned.T_map_scan, aligned.inlier_share(), aligned.cost, aligned.degenerate_directions, ""};
}

/// Best first.
std::vector<Place> PlaceSearch::places_from(const std::vector<Pose>& guesses) {
  constexpr std::size_t kMostRefined = 40;
  const std::vector<Pose> found = coarse_.search(key_points_, key_normals_, guesses);
  std::vector<Place> places;
  for (std::size_t i = 0; i < std::min(found.size(), kMostRefined); ++i) {
    places.push_back(refined(found[i]));
  }
  std::stable_sort(
      places.begin(), places.end(), [](const Place& a, const Place& b) { return a.cost < b.cost; });
  return places;
}

}  // namespace nvm::lio
