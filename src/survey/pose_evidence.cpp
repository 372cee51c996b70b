// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/pose_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nvm::survey {

namespace {

/// Mean of what half the squared difference of two sightings has beyond their own noise [m²].
class HalfSquares {
 public:
  explicit HalfSquares(double sq_floor) : sq_floor_(sq_floor) {}

  void add(const Sighting& a, const Sighting& b) {
    const double sq_error = a.sq_error + b.sq_error;
    const double difference = a.offset - b.offset;
    const double weight = 1.0 / (sq_error + sq_floor_);
    sum_ += weight * 0.5 * (difference * difference - sq_error);
    weights_ += weight;
  }

  double mean() const { return weights_ > 0.0 ? std::max(0.0, sum_ / weights_) : 0.0; }

 private:
  double sq_floor_;
  double sum_ = 0.0;
  double weights_ = 0.0;
};

}  // namespace

PoseEvidence::PoseEvidence(const std::vector<WallSightings>& walls, double noise) {
  constexpr double kNext = 3.0;   // [s]
  constexpr double kTiny = 1e-6;  // [m]; of maps without any noise
  HalfSquares near(noise * noise + kTiny * kTiny);
  HalfSquares far = near;
  for (const WallSightings& wall : walls) {
    for (const std::vector<Sighting>& side : wall) {
      for (std::size_t i = 0; i < side.size(); ++i) {
        if (i + 1 < side.size() && side[i + 1].time - side[i].time < kNext) {
          near.add(side[i], side[i + 1]);
        }
        for (std::size_t j = i + 1; j < side.size(); ++j) {
          if (side[j].time - side[i].time >= kPassGap) {
            far.add(side[i], side[j]);
          }
        }
      }
    }
  }
  sq_jitter_ = near.mean();
  sq_drift_ = std::max(0.0, far.mean() - sq_jitter_);
}

double PoseEvidence::sq_shift(const std::vector<Sighting>& side) const {
  constexpr double kPriorSightings = 5.0;  // that a side's own jitter is drawn towards all by
  const auto count = static_cast<double>(side.size());
  double weights = 0.0;
  double mean = 0.0;
  for (const Sighting& sighting : side) {
    const double weight = 1.0 / (sighting.sq_error + sq_jitter_);
    weights += weight;
    mean += weight * sighting.offset;
  }
  double own = 0.0;
  for (const Sighting& sighting : side) {
    const double weight = 1.0 / (sighting.sq_error + sq_jitter_);
    own += weight * (std::pow(sighting.offset - mean / weights, 2) - sighting.sq_error) / weights;
  }
  own = count > 1.0 ? std::max(0.0, own) * count / (count - 1.0) : sq_jitter_;
  const double sq_jitter = (count * own + kPriorSightings * sq_jitter_) / (count + kPriorSightings);
  return sq_jitter / std::max(1.0, count);
}

double time_between_sides(const WallSightings& wall) {
  double least = std::numeric_limits<double>::infinity();
  for (const Sighting& a : wall[0]) {
    for (const Sighting& b : wall[1]) {
      least = std::min(least, std::abs(a.time - b.time));
    }
  }
  return least;
}

}  // namespace nvm::survey
