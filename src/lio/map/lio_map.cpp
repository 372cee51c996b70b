// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/map/lio_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#if __has_include(<nanoflann.hpp>)
#include "nvm/map/kd_tree_map.hpp"
#define NVM_HAS_KD_TREE_MAP
#endif
#include "nvm/core/require.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::lio {

namespace {

using Points = std::vector<Eigen::Vector3f>;
using Values = std::vector<PointValues>;

/// The points that have a normal or a sighting, for maps that do not ask for them. Keeps its
/// memory.
struct PointsOnSurfaces {
  Points points;
  Values values;

  void choose(const Points& from, const Points& normals, const Values& theirs) {
    points.clear();
    values.clear();
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (!normals[i].isZero()) {
        points.push_back(from[i]);
        values.push_back(theirs[i]);
      }
    }
  }
};

void refuse_columns_without_source(const MapColumns& columns) {
  require(!columns.color, "color", columns.color, "false: scans have no colours");
  require(!columns.label, "label", columns.label, "false: scans have no classes");
}

/// All kinds that live in a VoxelMap; they differ in what they store and how they answer.
class VoxelLioMap : public LioMap {
 public:
  explicit VoxelLioMap(const MapOptions& options) : map_(options) {}
  explicit VoxelLioMap(VoxelMap map) : map_(std::move(map)) {}

  InsertStats insert(
      const Points& points,
      const Points& normals,
      const Values& values,
      const Pose& T_map_scan) override {
    return bounded(map_.insert(points, normals, T_map_scan, values), T_map_scan);
  }

  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept override {
    return map_.nearest(point, normal, search, out, context);
  }

  void clear() override { map_.clear(); }
  std::size_t size() const override { return map_.size(); }
  std::size_t memory_bytes() const override { return map_.memory_bytes(); }
  std::vector<MapPoint> points() const override { return without_sightings(map_.points()); }
  const VoxelMap* voxel_map() const override { return &map_; }

 protected:
  /// Drops what is far from the sensor, with Eviction::kRadius; `stats` are those of its scan.
  InsertStats bounded(InsertStats stats, const Pose& T_map_scan) {
    const MapOptions& options = map_.options();
    if (options.eviction == Eviction::kRadius) {
      map_.keep_within(T_map_scan.translation(), options.eviction_radius, stats);
    }
    return stats;
  }

  VoxelMap map_;
};

class FrozenLioMap final : public VoxelLioMap {
 public:
  using VoxelLioMap::VoxelLioMap;

  InsertStats insert(const Points&, const Points&, const Values&, const Pose&) override {
    return {};
  }
  bool is_frozen() const override { return true; }
};

MapOptions one_surface(MapOptions options) {
  options.max_surfaces = 1;
  return options;
}

class UnsidedLioMap final : public VoxelLioMap {
 public:
  explicit UnsidedLioMap(const MapOptions& options) : VoxelLioMap(one_surface(options)) {}

  InsertStats insert(
      const Points& points,
      const Points& normals,
      const Values& values,
      const Pose& T_map_scan) override {
    kept_.choose(points, normals, values);
    InsertStats stats = map_.insert_unsided(kept_.points, T_map_scan, kept_.values);
    stats.no_normal = points.size() - kept_.points.size();
    return bounded(stats, T_map_scan);
  }

  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& /*normal*/,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept override {
    return map_.nearest(point, search, out, context);
  }

 private:
  PointsOnSurfaces kept_;
};

class FacingLioMap final : public VoxelLioMap {
 public:
  explicit FacingLioMap(const MapOptions& options) : VoxelLioMap(one_surface(options)) {}

  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept override {
    NearestSearch facing = search;
    facing.gate = Gate::kPoints;
    return map_.nearest(point, normal, facing, out, context);
  }
};

class RejectLioMap final : public VoxelLioMap {
 public:
  explicit RejectLioMap(const MapOptions& options)
      : VoxelLioMap(one_surface(options)),
        min_cosine_(static_cast<float>(std::cos(options.max_point_angle))) {}

  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept override {
    const std::size_t count = map_.nearest(point, search, out, context);
    const Neighbor* end = std::remove_if(out, out + count, [&](const Neighbor& neighbor) {
      const Eigen::Vector3f stored = map_.normal(neighbor.id);
      return (is_sighting(stored) && !is_sighting(normal)) ||
             stored.dot(normal) < min_cosine_ * stored.norm() * normal.norm();
    });
    return static_cast<std::size_t>(end - out);
  }

 private:
  float min_cosine_;
};

#ifdef NVM_HAS_KD_TREE_MAP
class KdTreeLioMap final : public LioMap {
 public:
  explicit KdTreeLioMap(const MapOptions& options)
      : min_point_distance_(options.min_point_distance), map_(min_point_distance_) {}

  InsertStats insert(
      const Points& points,
      const Points& normals,
      const Values& values,
      const Pose& T_map_scan) override {
    kept_.choose(points, normals, values);
    InsertStats stats = map_->insert_unsided(kept_.points, T_map_scan);
    stats.no_normal = points.size() - kept_.points.size();
    return stats;
  }

  // As in KdTreeMap: nanoflann throws only where no tree has been built.
  // NOLINTNEXTLINE(bugprone-exception-escape)
  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& /*context*/) const noexcept override {
    KdTreeMap::QueryContext context;
    return map_->nearest(point, normal, search, out, context);
  }

  void clear() override { map_.emplace(min_point_distance_); }
  std::size_t size() const override { return map_->size(); }
  std::size_t memory_bytes() const override {
    // Positions, and the tree's indices and nodes.
    return map_->size() * (sizeof(Eigen::Vector3d) + 2 * sizeof(std::uint64_t));
  }
  std::vector<MapPoint> points() const override {
    std::vector<MapPoint> points;
    for (const Eigen::Vector3d& position : map_->points()) {
      points.push_back({position, Eigen::Vector3f::Zero(), 0});
    }
    return points;
  }

 private:
  double min_point_distance_;  // [m]
  std::optional<KdTreeMap> map_;
  PointsOnSurfaces kept_;
};
#endif

}  // namespace

std::unique_ptr<LioMap> make_map(MapType type, const MapOptions& options) {
  refuse_columns_without_source(options.columns);
  switch (type) {
    case MapType::kNvm:
      return std::make_unique<VoxelLioMap>(options);
    case MapType::kVoxel:
      return std::make_unique<UnsidedLioMap>(options);
    case MapType::kFacing:
      return std::make_unique<FacingLioMap>(options);
    case MapType::kReject:
      return std::make_unique<RejectLioMap>(options);
    case MapType::kKdTree:
#ifdef NVM_HAS_KD_TREE_MAP
      return std::make_unique<KdTreeLioMap>(options);
#else
      throw std::invalid_argument(
          "nvm: map.type = kdtree needs nanoflann, which was not there when nvm was built");
#endif
  }
  throw std::invalid_argument("nvm: unknown map type");
}

std::unique_ptr<LioMap> continued_map(VoxelMap prior, bool is_frozen) {
  if (is_frozen) {
    return std::make_unique<FrozenLioMap>(std::move(prior));
  }
  return std::make_unique<VoxelLioMap>(std::move(prior));
}

}  // namespace nvm::lio
