// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/sweep_azimuth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace nvm::io {
namespace {

constexpr double kTurn = 6.283185307179586;

double wrapped(double angle) { return angle - kTurn * std::round(angle / kTurn); }

/// The points of one beam, in order.
struct Beam {
  double first = 0.0;     ///< azimuth [rad]
  double previous = 0.0;  ///< azimuth [rad]
  double turned = 0.0;    ///< from the first point on, with sign [rad]
  double path = 0.0;      ///< the same without sign
  std::size_t count = 0;
};

/// The beam that each point belongs to: its ring; where there are no rings, all are one beam.
using Beams = std::map<std::uint16_t, Beam>;

/// Follows the azimuth of each beam from point to point; `turned` gets the angle from the beam's
/// first point to each.
Beams follow(const std::vector<TimedPoint>& points, std::vector<double>& turned) {
  Beams beams;
  turned.reserve(points.size());
  for (const TimedPoint& point : points) {
    Beam& beam = beams[point.ring];
    const double azimuth = std::atan2(point.y, point.x);
    if (beam.count++ == 0) {
      beam.first = azimuth;
    } else {
      const double step = wrapped(azimuth - beam.previous);
      beam.turned += step;
      beam.path += std::abs(step);
    }
    beam.previous = azimuth;
    turned.push_back(beam.turned);
  }
  return beams;
}

/// +1 or -1 when the beams go round that way, about once; 0 when they do not.
int direction(const Beams& beams) {
  double turned = 0.0;
  double path = 0.0;
  double longest = 0.0;
  for (const auto& [ring, beam] : beams) {
    turned += beam.turned;
    path += beam.path;
    longest = std::max(longest, std::abs(beam.turned));
  }
  constexpr double kSameWay = 0.8;
  constexpr double kMaxTurn = 1.1 * kTurn;
  const bool is_sweep =
      longest >= 0.5 * kTurn && longest <= kMaxTurn && std::abs(turned) >= kSameWay * path;
  return is_sweep ? (turned > 0.0 ? 1 : -1) : 0;
}

}  // namespace

std::vector<float> sweep_fractions(const std::vector<TimedPoint>& points) {
  std::vector<double> turned;
  Beams beams = follow(points, turned);
  const int sign = direction(beams);
  if (sign == 0) {
    return {};
  }
  // Beams that begin late, for lack of returns, begin as much after the one that begins first.
  const double reference = beams.at(points.front().ring).first;
  double earliest = 0.0;
  for (auto& [ring, beam] : beams) {
    beam.first = sign * wrapped(beam.first - reference);
    earliest = std::min(earliest, beam.first);
  }
  std::vector<float> fractions(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = beams.at(points[i].ring).first + sign * turned[i] - earliest;
    fractions[i] = static_cast<float>(std::max(0.0, angle) / kTurn);  // the first may step back
  }
  return fractions;
}

}  // namespace nvm::io
