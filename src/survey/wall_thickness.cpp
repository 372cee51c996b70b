// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/wall_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "eval/walls/thickness.hpp"

namespace nvm::survey {

namespace {

constexpr double kPieceLength = 3.0;  // [m]
constexpr double kBlock = 0.5;        // [m]

/// The region that is measured: off the edges of the overlap, unless little is left then.
Mask inner(const Mask& overlap) {
  Mask inside = eroded(overlap, 1);
  return 2 * inside.count() >= overlap.count() ? inside : overlap;
}

/// The points of both faces by the piece of the wall that they lie on.
std::map<int, eval::SidedPoints> split(
    const SurveyCloud& cloud, const std::vector<Face>& faces, const FacePair& pair) {
  const Mask region = inner(pair.overlap);
  const PlaneFrame& frame = faces[pair.first].frame;
  PlaneBox box;
  region.for_each([&](int column, int row) {
    box.extend(region.u(column), region.v(row));
    box.extend(region.u(column + 1), region.v(row + 1));
  });
  const bool along_u = box.width() >= box.height();
  const double length = along_u ? box.width() : box.height();
  const double piece = length / std::ceil(std::max(length / kPieceLength, 1.0));
  std::map<int, eval::SidedPoints> pieces;
  for (const std::size_t side : {0U, 1U}) {
    for (const std::uint32_t i : faces[side == 0 ? pair.first : pair.second].points) {
      const Eigen::Vector3d& p = cloud.positions[i];
      const double u = frame.coordinate_u(p);
      const double v = frame.coordinate_v(p);
      if (region.covers(u, v)) {
        const double at = along_u ? u - box.min_u : v - box.min_v;
        pieces[static_cast<int>(at / piece)][side].push_back(p);
      }
    }
  }
  return pieces;
}

/// Adds what the residuals of one fitted face tell. Three of its degrees of freedom went into the
/// plane, which lowers the sums over blocks as it lowers those over points.
void add_scatter(const eval::FaceFit& fit, const PlaneFrame& frame, BlockScatter& scatter) {
  std::map<std::pair<int, int>, std::pair<double, double>> blocks;
  for (const Eigen::Vector3d& p : fit.points) {
    auto& [sum, count] = blocks[{
        static_cast<int>(std::floor(frame.coordinate_u(p) / kBlock)),
        static_cast<int>(std::floor(frame.coordinate_v(p) / kBlock))}];
    sum += fit.plane.distance(p);
    count += 1.0;
  }
  const double freedom = static_cast<double>(blocks.size()) - 3.0;
  if (freedom < 1.0 || !(fit.spread > 0.0)) {
    return;
  }
  const auto points = static_cast<double>(fit.points.size());
  const double sq_noise = fit.spread * fit.spread * points / std::max(points - 3.0, 1.0);
  const double share = freedom / static_cast<double>(blocks.size());
  double slow = 0.0;
  for (const auto& [index, block] : blocks) {
    const auto& [sum, count] = block;
    scatter.found += sum * sum / (sq_noise * points);
    slow += sum * sum / (count * count) - share * sq_noise / count;
    scatter.sq_slow_error += 2.0 * std::pow(share * sq_noise / count, 2);
  }
  scatter.expected += share;
  scatter.blocks += freedom;
  scatter.slow += slow;
}

double sq_standard_error(const eval::FaceFit& fit) {
  const auto points = static_cast<double>(fit.points.size());
  return fit.spread * fit.spread / std::max(points - 3.0, 1.0);
}

void add_piece(
    const eval::Thickness& piece,
    const PlaneFrame& frame,
    double& weight_sum,
    WallThickness& wall) {
  double weight = 0.0;
  double sq_noise = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const eval::FaceFit& fit = piece.faces[side];
    const auto points = static_cast<double>(fit.points.size());
    weight += points;
    sq_noise += sq_standard_error(fit);
    wall.points[side] += fit.points.size();
    wall.rms[side] += fit.spread * fit.spread * points;
    add_scatter(fit, frame, wall.scatter);
  }
  weight_sum += weight;
  wall.value += weight * piece.value;
  wall.sq_noise += weight * weight * sq_noise;
}

}  // namespace

BlockScatter& BlockScatter::operator+=(const BlockScatter& other) {
  expected += other.expected;
  found += other.found;
  blocks += other.blocks;
  slow += other.slow;
  sq_slow_error += other.sq_slow_error;
  return *this;
}

double BlockScatter::inflation(double prior, double prior_blocks) const {
  const double own = expected > 0.0 ? found / expected : prior;
  return (own * blocks + prior * prior_blocks) / std::max(blocks + prior_blocks, 1.0);
}

std::optional<WallThickness> measure_wall(
    const SurveyCloud& cloud, const std::vector<Face>& faces, const FacePair& pair) {
  const Face& first = faces[pair.first];
  const Face& second = faces[pair.second];
  WallThickness wall;
  double weight_sum = 0.0;
  for (const auto& [index, points] : split(cloud, faces, pair)) {
    const auto piece = eval::measure_thickness(points, {first.plane, second.plane}, {});
    if (piece) {
      add_piece(*piece, first.frame, weight_sum, wall);
    }
  }
  if (weight_sum == 0.0) {
    return std::nullopt;
  }
  wall.value /= weight_sum;
  wall.sq_noise /= weight_sum * weight_sum;
  for (std::size_t side = 0; side < 2; ++side) {
    wall.rms[side] = std::sqrt(wall.rms[side] / static_cast<double>(wall.points[side]));
  }
  return wall;
}

}  // namespace nvm::survey
