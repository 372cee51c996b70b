// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/wall_grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

namespace nvm::lio {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSector = kPi / 4.0;  // of the eight directions in which a cell may face
/// Squares that are looked into at most; the best come first, so that more find nothing better.
constexpr std::size_t kMaxNodes = 400'000;

std::uint8_t sector_bit(double position) {
  return static_cast<std::uint8_t>(1U << (static_cast<int>(std::floor(position)) & 7));
}

/// The two directions that are nearest to an azimuth [rad], one of which a like wall faces.
std::uint8_t faces_of(double azimuth) {
  const double position = azimuth / kSector;
  return static_cast<std::uint8_t>(sector_bit(position - 0.5) | sector_bit(position + 0.5));
}

/// Turns a point by so much that its cell does not change by more than the cells around it make up
/// for [rad].
double heading_step(const std::vector<WallPoint>& scan) {
  constexpr double kFinest = 0.025;
  constexpr double kCoarsest = 0.1;
  std::vector<double> ranges;
  for (const WallPoint& point : scan) {
    ranges.push_back(point.position.norm());
  }
  const auto most = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() * 9 / 10);
  std::nth_element(ranges.begin(), most, ranges.end());
  return std::clamp(WallGrid::kCell / *most, kFinest, kCoarsest);
}

bool is_same(const PlanarPlace& a, const PlanarPlace& b) {
  constexpr double kNear = 0.9;   // [m]
  constexpr double kAlike = 0.2;  // [rad]
  return (a.position - b.position).norm() < kNear &&
         std::abs(std::remainder(a.heading - b.heading, 2.0 * kPi)) < kAlike;
}

}  // namespace

/// A square of 2^level cells in each direction from (x, y), at one heading.
struct WallGrid::Node {
  std::size_t hits;
  int level, x, y, heading;

  bool operator<(const Node& other) const { return hits < other.hits; }
};

/// The squares that have been looked at and not into.
struct WallGrid::Frontier {
  const WallGrid& grid;
  std::vector<std::vector<Ray>> headings;
  std::size_t min_hits;
  std::priority_queue<Node> nodes;

  void consider(int level, int x, int y, int heading) {
    if (x < grid.width_ && y < grid.height_) {
      const auto& rays = headings[static_cast<std::size_t>(heading)];
      const std::size_t bound = grid.hits(rays, level, x, y);
      if (bound >= min_hits) {
        nodes.push({bound, level, x, y, heading});
      }
    }
  }

  void begin() {
    for (int heading = 0; heading < static_cast<int>(headings.size()); ++heading) {
      for (int y = 0; y < grid.height_; y += kPadding) {
        for (int x = 0; x < grid.width_; x += kPadding) {
          consider(kLevels, x, y, heading);
        }
      }
    }
  }

  std::optional<Node> next() {
    if (nodes.empty()) {
      return std::nullopt;
    }
    const Node node = nodes.top();
    nodes.pop();
    return node;
  }

  void divide(const Node& node) {
    const int half = 1 << (node.level - 1);
    for (const int y : {node.y, node.y + half}) {
      for (const int x : {node.x, node.x + half}) {
        consider(node.level - 1, x, y, node.heading);
      }
    }
  }

  PlanarPlace place_of(const Node& node) const {
    return {
        grid.origin_ + kCell * Eigen::Vector2d(node.x + 0.5, node.y + 0.5),
        2.0 * kPi * node.heading / static_cast<double>(headings.size()),
        node.hits};
  }
};

WallGrid::WallGrid(const std::vector<WallPoint>& walls) {
  if (walls.empty()) {
    return;
  }
  Eigen::Vector2d min = walls.front().position;
  Eigen::Vector2d max = min;
  for (const WallPoint& wall : walls) {
    min = min.cwiseMin(wall.position);
    max = max.cwiseMax(wall.position);
  }
  origin_ = min.array() - kCell;
  const Eigen::Vector2d size = (max - min) / kCell + Eigen::Vector2d::Constant(3.0 + kPadding);
  is_too_large_ = size.prod() > static_cast<double>(kMaxCells);
  if (!is_too_large_) {
    width_ = static_cast<int>(size.x()) - kPadding;
    height_ = static_cast<int>(size.y()) - kPadding;
    draw(walls);
    build_levels();
  }
}

void WallGrid::draw(const std::vector<WallPoint>& walls) {
  const auto stride = static_cast<std::size_t>(width_ + kPadding);
  std::vector<std::uint8_t> cells(stride * static_cast<std::size_t>(height_ + kPadding), 0);
  for (const WallPoint& wall : walls) {
    const Eigen::Vector2d cell = (wall.position - origin_) / kCell;
    const int x = static_cast<int>(cell.x());
    const int y = static_cast<int>(cell.y());
    for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i) {
        cells
            [static_cast<std::size_t>(j + kPadding) * stride +
             static_cast<std::size_t>(i + kPadding)] |= sector_bit(wall.facing / kSector);
      }
    }
  }
  levels_.push_back(std::move(cells));
}

void WallGrid::build_levels() {
  const int width = width_ + kPadding;
  const int height = height_ + kPadding;
  for (int level = 1; level <= kLevels; ++level) {
    const std::vector<std::uint8_t>& finer = levels_.back();
    std::vector<std::uint8_t> cells(finer.size(), 0);
    const int step = 1 << (level - 1);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::uint8_t faces = 0;
        for (const int j : {y, y + step}) {
          for (const int i : {x, x + step}) {
            if (i < width && j < height) {
              faces =
                  static_cast<std::uint8_t>(faces | finer[static_cast<std::size_t>(j * width + i)]);
            }
          }
        }
        cells[static_cast<std::size_t>(y * width + x)] = faces;
      }
    }
    levels_.push_back(std::move(cells));
  }
}

std::vector<std::vector<WallGrid::Ray>> WallGrid::turned(
    const std::vector<WallPoint>& scan, double step) const {
  std::vector<std::vector<Ray>> headings(static_cast<std::size_t>(2.0 * kPi / step) + 1);
  for (std::size_t k = 0; k < headings.size(); ++k) {
    const double heading =
        2.0 * kPi * static_cast<double>(k) / static_cast<double>(headings.size());
    const double cosine = std::cos(heading) / kCell;
    const double sine = std::sin(heading) / kCell;
    for (const auto& [position, facing] : scan) {
      headings[k].push_back(
          {static_cast<int>(std::lround(cosine * position.x() - sine * position.y())),
           static_cast<int>(std::lround(sine * position.x() + cosine * position.y())),
           faces_of(facing + heading)});
    }
  }
  return headings;
}

std::size_t WallGrid::hits(const std::vector<Ray>& rays, int level, int x, int y) const {
  const std::vector<std::uint8_t>& cells = levels_[static_cast<std::size_t>(level)];
  const auto width = static_cast<unsigned>(width_ + kPadding);
  const auto height = static_cast<unsigned>(height_ + kPadding);
  std::size_t hits = 0;
  for (const Ray& ray : rays) {
    const auto i = static_cast<unsigned>(x + ray.x + kPadding);
    const auto j = static_cast<unsigned>(y + ray.y + kPadding);
    const bool is_inside = i < width && j < height;
    hits += is_inside && (cells[std::size_t{j} * width + i] & ray.faces) != 0 ? 1 : 0;
  }
  return hits;
}

std::vector<PlanarPlace> WallGrid::search(
    const std::vector<WallPoint>& scan, std::size_t count, std::size_t min_hits) const {
  std::vector<PlanarPlace> places;
  if (scan.empty() || levels_.empty()) {
    return places;
  }
  Frontier frontier{*this, turned(scan, heading_step(scan)), min_hits, {}};
  frontier.begin();
  for (std::size_t nodes = 0; nodes < kMaxNodes && places.size() < count; ++nodes) {
    const std::optional<Node> node = frontier.next();
    if (!node) {
      break;
    }
    const PlanarPlace place = frontier.place_of(*node);
    const auto is_like = [&](const PlanarPlace& other) { return is_same(place, other); };
    if (node->level > 0) {
      frontier.divide(*node);
    } else if (std::none_of(places.begin(), places.end(), is_like)) {
      places.push_back(place);
    }
  }
  return places;
}

}  // namespace nvm::lio
