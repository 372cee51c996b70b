// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Any sequence of a map's operations, each held against brute force over the map's own points, and
// with a second map that is saved and loaded on the way and must stay the same.
#include <optional>

#include "map_steps.hpp"
#include "nvm/map/map_archive.hpp"

namespace {

using nvm::InsertStats;
using nvm::MapArchive;
using nvm::MapOptions;
using nvm::VoxelMap;
using nvm::fuzz::Input;
using nvm::fuzz::Places;
using nvm::fuzz::require;
using nvm::fuzz::take_point;

MapOptions take_options(Input& input) {
  constexpr double kPi = 3.141592653589793;
  const auto pick = [&](auto... choices) {
    const std::array<std::common_type_t<decltype(choices)...>, sizeof...(choices)> all{choices...};
    return all[static_cast<std::size_t>(input.below(static_cast<int>(all.size())))];
  };
  MapOptions options;
  options.voxel_size = pick(0.3, 0.01, 1.0, 0.1, 100.0);
  options.capacity = pick(1U, 2U, 8U, 100U, 5000U);
  options.max_bytes = pick(std::size_t{0}, MapOptions::kMinBytes, 2 * MapOptions::kMinBytes);
  options.points_per_surface = pick(1, 8, 20, 120);
  options.min_point_distance = options.voxel_size * pick(0.0, 0.1, 0.33, 1.0, 2.0);
  options.space_across_voxels = pick(false, true);
  options.max_merged_points = pick(1, 8, 255);
  options.max_surfaces = pick(2, 1, 4, 8);
  options.surface_rule = pick(nvm::SurfaceRule::kPaper, nvm::SurfaceRule::kSmallestAngle);
  options.max_surface_angle = pick(0.5 * kPi, 0.0, 0.5, kPi);
  options.max_point_angle = pick(0.55 * kPi, 0.0, 0.5, kPi);
  options.columns.label = options.space_across_voxels;  // takes no input: the corpus stays good
  return options;
}

constexpr std::uint16_t kLabel = 7;  // of all points that come with one

/// Does to a map what an input says, and checks it.
class Player {
 public:
  Player(const MapOptions& options, Input input) : map_(options), input_(input) {}
  Player(VoxelMap map, Input input, bool has_unsided)
      : map_(std::move(map)), input_(input), has_unsided_(has_unsided) {}

  /// Does at most `steps` steps. The bytes of the map at the end.
  std::vector<std::uint8_t> play(int steps, bool may_save) {
    std::optional<std::vector<std::uint8_t>> of_loaded;
    for (; !input_.empty() && steps > 0; --steps) {
      const int kind = input_.below(11);
      if (kind == 10 && may_save && !of_loaded) {
        const auto bytes = MapArchive::write(map_);
        Player loaded(MapArchive::read(bytes), input_, has_unsided_);
        of_loaded = loaded.play(steps - 1, false);
      } else {
        step(kind);
        nvm::fuzz::audit(map_);
        check_labels();
      }
    }
    auto bytes = MapArchive::write(map_);
    require(!of_loaded || *of_loaded == bytes, "a map goes on as it would have without saving");
    return bytes;
  }

 private:
  double edge() const { return map_.options().voxel_size; }

  void step(int kind) {
    switch (kind) {
      case 0:
      case 1:
        return insert(false);
      case 2:
        return insert(true);
      case 3:
      case 4:
        return query();
      case 5:
        return query_within();
      case 6:
        return erase_box();
      case 7:
        return erase_within();
      case 8:
        return erase_beyond();
      case 9:
        return move();
      default:
        return input_.below(8) == 0 ? map_.clear() : void();
    }
  }

  void check_labels() const {
    map_.for_each_point([&](const nvm::MapPoint& point) {
      const bool is_given = map_.options().columns.label && point.values.label == kLabel;
      require(is_given || point.values.label == 0, "values are those that were given");
    });
  }

  void insert(bool unsided) {
    const nvm::test::Cloud cloud = nvm::fuzz::take_cloud(input_, edge());
    const Places before = nvm::fuzz::places(map_);
    const std::size_t voxels = map_.voxel_count();
    nvm::PointValues of_all;
    of_all.label = kLabel;
    const std::vector<nvm::PointValues> values(cloud.points.size(), of_all);
    const InsertStats stats =
        unsided ? map_.insert_unsided(cloud.points)
                : map_.insert(cloud.points, cloud.normals, nvm::Pose::Identity(), values);
    has_unsided_ = has_unsided_ || unsided;
    nvm::fuzz::check_insertion(map_, cloud, stats, before, voxels);
  }

  void query() {
    const Eigen::Vector3d point = take_point(input_, edge());
    nvm::NearestSearch search;
    search.count = static_cast<std::size_t>(input_.below(70)) + 1;
    search.max_distance = std::abs(nvm::fuzz::take_number(input_, edge()));
    search.rings = 1 + static_cast<int>(search.count) % 3;
    search.gate = input_.below(2) == 0 ? nvm::Gate::kSurfaces : nvm::Gate::kPoints;
    std::mt19937_64 random(input_.take<std::uint16_t>());
    const Eigen::Vector3f normal = nvm::test::random_unit(random);
    std::array<nvm::Neighbor, 128> out;
    std::array<nvm::Neighbor, nvm::kMaxNeighbors> found;
    const auto nearest = [&](auto... with_normal) {
      const std::size_t count = map_.nearest(point, with_normal..., search, out.data(), context_);
      require(count <= nvm::kMaxNeighbors, "no more neighbours than may be asked for");
      std::copy_n(out.begin(), count, found.begin());
      return count;
    };
    const std::size_t count = nearest();
    if (!(point.array().abs() < 1e5 * edge()).all() || !(search.max_distance >= 0.0)) {
      require(count == 0 || point.allFinite(), "nothing is near a point that is nowhere");
      return;
    }
    const nvm::test::MapOracle oracle(map_);
    nvm::NearestSearch wider = search;
    wider.max_distance = search.max_distance * (1.0 + 1e-6) + 1e-9;
    nvm::fuzz::check_nearest(oracle.candidates(point, nullptr, wider), found, count, search);
    const std::size_t gated = nearest(normal);
    if (!has_unsided_ && map_.options().max_merged_points == 1) {
      nvm::fuzz::check_nearest(oracle.candidates(point, &normal, wider), found, gated, search);
    }
  }

  void query_within() {
    const Eigen::Vector3d center = take_point(input_, edge());
    const double radius = nvm::fuzz::take_number(input_, edge());
    std::set<nvm::PointId> visited;
    std::size_t visits = 0;
    map_.for_each_within(center, radius, [&](const nvm::Neighbor& neighbor) {
      require(map_.position(neighbor.id) == neighbor.position, "a neighbour is where its point is");
      visited.insert(neighbor.id);
      ++visits;
    });
    require(visits == visited.size(), "no point is visited twice");
    const double rounding = edge() / 1024.0;
    std::size_t fewest = 0;
    std::size_t most = 0;
    map_.for_each_point([&](const nvm::MapPoint& point) {
      const double excess = (point.position - center).stableNorm() - radius;
      fewest += excess < -rounding && radius >= 0.0 ? 1 : 0;
      most += excess < rounding && radius >= 0.0 ? 1 : 0;
    });
    require(visits >= fewest && visits <= most, "all points within a radius are visited, no other");
  }

  void erase_box() {
    const Eigen::Vector3d a = take_point(input_, edge());
    const Eigen::Vector3d b = take_point(input_, edge());
    const Places before = nvm::fuzz::places(map_);
    const std::size_t erased = map_.erase_box(a, b);
    const auto excess = [&](const Eigen::Vector3d& p) {
      return (p.array() >= a.array()).all() && (p.array() <= b.array()).all() ? -1.0 : 1.0;
    };
    nvm::fuzz::check_erasure(map_, before, erased, excess, 0.5);
  }

  void erase_within() {
    const Eigen::Vector3d center = take_point(input_, edge());
    const double radius = nvm::fuzz::take_number(input_, edge());
    const Places before = nvm::fuzz::places(map_);
    const std::size_t erased = map_.erase_within(center, radius);
    const auto excess = [&](const Eigen::Vector3d& p) {
      return radius >= 0.0 && (p - center).squaredNorm() <= radius * radius ? -1.0 : 1.0;
    };
    nvm::fuzz::check_erasure(map_, before, erased, excess, 0.5);
  }

  /// Erases voxels by their centres, as an erasure or as eviction.
  void erase_beyond() {
    const Eigen::Vector3d center = take_point(input_, edge());
    const double radius = std::abs(nvm::fuzz::take_number(input_, edge()));
    const Places before = nvm::fuzz::places(map_);
    const std::size_t voxels = map_.voxel_count();
    InsertStats stats;
    std::size_t erased = 0;
    if (input_.below(2) == 0) {
      erased = map_.erase_voxels_beyond(center, radius);
    } else {
      map_.keep_within(center, radius, stats);
      erased = stats.evicted_points;
      require(map_.voxel_count() + stats.evicted_voxels == voxels, "evicted voxels are counted");
    }
    const auto excess = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d middle = ((p / edge()).array().floor() + 0.5) * edge();
      const double beyond = (middle - center).stableNorm() - radius;
      return std::isfinite(beyond) ? -beyond : 0.0;  // else either may be
    };
    nvm::fuzz::check_erasure(
        map_, before, erased, excess, 1e-9 * (1.0 + center.stableNorm() + radius));
  }

  void move() {
    VoxelMap other = std::move(map_);
    nvm::fuzz::audit(map_);  // NOLINT(bugprone-use-after-move): is empty, and keeps its options
    require(map_.empty(), "a map that was moved from is empty");
    map_ = std::move(other);
  }

  VoxelMap map_;
  Input input_;
  VoxelMap::QueryContext context_;
  bool has_unsided_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const MapOptions options = take_options(input);
  Player(options, input).play(20, true);
  return 0;
}
