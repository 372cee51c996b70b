// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/wall_thickness.hpp"

#include <Eigen/Cholesky>
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

/// What half a metre of a face holds: sums over its points.
struct Block {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< of (1, u, v)
  double distance = 0.0;                            ///< to a plane [m]
  double sq_distance = 0.0;
};

/// One side of a wall, all its pieces, as blocks.
class SideBlocks {
 public:
  SideBlocks(
      const std::vector<Eigen::Vector3d>& points,
      const PlaneFrame& frame,
      const eval::OrientedPlane& plane) {
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d place(1.0, frame.coordinate_u(p), frame.coordinate_v(p));
      Block& block = blocks_[{
          static_cast<int>(std::floor(place[1] / kBlock)),
          static_cast<int>(std::floor(place[2] / kBlock))}];
      const double distance = plane.distance(p);
      block.place += place;
      block.distance += distance;
      block.sq_distance += distance * distance;
      moments_ += place * place.transpose();
      sums_ += distance * place;
    }
    points_ = static_cast<double>(points.size());
  }

  /// Adds what the blocks differ by from the plane of least squares. That plane takes a share of
  /// each block: its leverage, which is small in the middle of a face and large at its corners.
  void add_to(BlockScatter& scatter) const {
    constexpr std::size_t kMinBlocks = 4;
    const Eigen::LDLT<Eigen::Matrix3d> solver(moments_);
    const double sq_noise = within();
    if (blocks_.size() < kMinBlocks || !solver.isPositive() || !(sq_noise > 0.0)) {
      return;
    }
    const Eigen::Vector3d shift = solver.solve(sums_);
    BlockScatter own;
    for (const auto& [index, block] : blocks_) {
      const double free = 1.0 - block.place.dot(solver.solve(block.place)) / block.place[0];
      own.found += std::pow(residual(block, shift), 2) / (sq_noise * points_);
      own.expected += free * block.place[0] / points_;
    }
    own.blocks = static_cast<double>(blocks_.size()) - 3.0;
    scatter += own;
    add_neighbors(shift, sq_noise * std::max(1.0, own.found / own.expected), solver, scatter);
  }

 private:
  /// Of the points of `block` from the plane of least squares, `shift` off the given one, summed.
  static double residual(const Block& block, const Eigen::Vector3d& shift) {
    return block.distance - shift.dot(block.place);
  }

  /// Adds what blocks that touch have in common, and what the fit, to points that err by
  /// `sq_error` [m²], took of it.
  void add_neighbors(
      const Eigen::Vector3d& shift,
      double sq_error,
      const Eigen::LDLT<Eigen::Matrix3d>& solver,
      BlockScatter& scatter) const {
    constexpr std::array<std::array<int, 2>, 2> kSteps{{{1, 0}, {0, 1}}};
    for (const auto& [index, block] : blocks_) {
      for (const auto& [columns, rows] : kSteps) {
        const auto next = blocks_.find({index.first + columns, index.second + rows});
        if (next != blocks_.end()) {
          const Block& other = next->second;
          const double weight = std::sqrt(block.place[0] * other.place[0]);
          const double by_fit = sq_error * block.place.dot(solver.solve(other.place));
          scatter.common += (residual(block, shift) * residual(other, shift) + by_fit) / weight;
          scatter.common_weight += weight;
        }
      }
    }
  }

  /// Variance of the points within their blocks [m²]; 0 when nothing tells.
  double within() const {
    double sum = 0.0;
    for (const auto& [index, block] : blocks_) {
      sum += block.sq_distance - block.distance * block.distance / block.place[0];
    }
    const double freedom = points_ - static_cast<double>(blocks_.size());
    return freedom > 0.0 ? sum / freedom : 0.0;
  }

  std::map<std::pair<int, int>, Block> blocks_;
  Eigen::Matrix3d moments_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums_ = Eigen::Vector3d::Zero();
  double points_ = 0.0;
};

double sq_standard_error(const eval::FaceFit& fit) {
  const auto points = static_cast<double>(fit.points.size());
  return fit.spread * fit.spread / std::max(points - 3.0, 1.0);
}

void add_piece(
    const eval::Thickness& piece,
    eval::SidedPoints& used,
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
    used[side].insert(used[side].end(), fit.points.begin(), fit.points.end());
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
  common += other.common;
  common_weight += other.common_weight;
  return *this;
}

double BlockScatter::inflation(double prior, double prior_blocks) const {
  const double own = expected > 0.0 ? found / expected : prior;
  return (own * blocks + prior * prior_blocks) / std::max(blocks + prior_blocks, 1.0);
}

double BlockScatter::sq_bend() const { return common > 0.0 ? common / common_weight : 0.0; }

std::optional<WallThickness> measure_wall(
    const SurveyCloud& cloud, const std::vector<Face>& faces, const FacePair& pair) {
  const Face& first = faces[pair.first];
  const Face& second = faces[pair.second];
  WallThickness wall;
  double weight_sum = 0.0;
  eval::SidedPoints used;
  for (const auto& [index, points] : split(cloud, faces, pair)) {
    const auto piece = eval::measure_thickness(points, {first.plane, second.plane}, {});
    if (piece) {
      add_piece(*piece, used, weight_sum, wall);
    }
  }
  if (weight_sum == 0.0) {
    return std::nullopt;
  }
  wall.value /= weight_sum;
  wall.sq_noise /= weight_sum * weight_sum;
  for (std::size_t side = 0; side < 2; ++side) {
    SideBlocks(used[side], first.frame, faces[side == 0 ? pair.first : pair.second].plane)
        .add_to(wall.scatter);
    wall.rms[side] = std::sqrt(wall.rms[side] / static_cast<double>(wall.points[side]));
  }
  return wall;
}

}  // namespace nvm::survey
