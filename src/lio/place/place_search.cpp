// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lio/place/place_judge.hpp"
#include "lio/place/scan_witness.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

constexpr KeypointOptions kKeypoints{0.35, 1500};
constexpr std::size_t kMinKeypoints = 100;
constexpr const char* kTooFew = "the scan shows too few surfaces";
/// Furniture that was moved and people are in the way of some of a scan, never of most of it.
constexpr double kMinShare = 0.6;

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

bool is_elsewhere(const Pose& a, const Pose& b) {
  constexpr double kFar = 0.5;     // [m]
  constexpr double kTurned = 0.2;  // [rad]
  return (a.translation() - b.translation()).norm() > kFar ||
         so3_log(a.linear().transpose() * b.linear()).norm() > kTurned;
}

bool is_new(const Pose& pose, const std::vector<Pose>& poses) {
  constexpr double kNear = 0.2;   // [m]
  constexpr double kAlike = 0.1;  // [rad]
  return std::none_of(poses.begin(), poses.end(), [&](const Pose& other) {
    return (pose.translation() - other.translation()).norm() < kNear &&
           so3_log(pose.linear().transpose() * other.linear()).norm() < kAlike;
  });
}

}  // namespace

PlaceSearch::PlaceSearch(const VoxelMap& map, const Executor& executor)
    : map_(map),
      executor_(executor),
      sampler_(kKeypoints),
      coarse_(StartSearchOptions{}, executor),
      aligner_(fine_options()) {
  coarse_.insert(map);
  map.for_each_point([&](const MapPoint& point) {
    outline_.add(point.position, plane_normal(point.normal).cast<double>());
  });
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

std::vector<Place> PlaceSearch::candidates(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Eigen::Vector3d& up,
    const std::optional<Pose>& likely) {
  if (!choose_keypoints(points, normals)) {
    return {};
  }
  const Eigen::Matrix3d R_level_scan =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Pose> guesses = guesses_for(R_level_scan);
  if (likely) {
    const std::vector<Pose> near = around(*likely);
    guesses.insert(guesses.begin(), near.begin(), near.end());
  }
  std::vector<Place> distinct;
  for (Place& place : places_from(guesses)) {
    const bool is_new = std::all_of(distinct.begin(), distinct.end(), [&](const Place& other) {
      return is_elsewhere(place.T_map_scan, other.T_map_scan);
    });
    if (is_new && place.share >= kMinShare) {
      distinct.push_back(std::move(place));
    }
  }
  return distinct;
}

Place PlaceSearch::anywhere(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Eigen::Vector3d& up,
    const std::optional<Pose>& likely) {
  const std::vector<Place> places = candidates(points, normals, up, likely);
  if (!places.empty()) {
    return judged(places, map_, ScanWitness(points, normals));
  }
  const bool is_poor = key_points_.size() < kMinKeypoints;
  return {Pose::Identity(), 0.0, 1.0, 0, is_poor ? kTooFew : "no place has such walls"};
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
  std::vector<Pose> coarse;
  for (const Pose& pose : coarse_.search(key_points_, key_normals_, guesses)) {
    if (coarse.size() < kMostRefined && is_new(pose, coarse)) {
      coarse.push_back(pose);
    }
  }
  std::vector<Place> places;
  places.reserve(coarse.size());
  for (const Pose& pose : coarse) {
    places.push_back(refined(pose));
  }
  std::stable_sort(
      places.begin(), places.end(), [](const Place& a, const Place& b) { return a.cost < b.cost; });
  return places;
}

}  // namespace nvm::lio
