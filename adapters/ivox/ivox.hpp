// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "adapters/common/host_map.hpp"
#include "nvm/map/operations/wider_rings.hpp"

/// Names and signatures are those of faster-lio, in its own namespace: this header takes the place
/// of ivox3d/ivox3d.h. docs/adapters/ivox.md says what to change in a host.
namespace faster_lio {

/// How the host's map stores the points of a voxel; of no meaning here.
enum class IVoxNodeType { DEFAULT, PHC };

/// Whether voxel 0 is around the origin (faster-lio) or beside it (Point-LIO); only transparent
/// maps tell the two apart.
enum class KeyRounding { kRound, kFloor };

/// An nvm map with the members of iVox that faster-lio and Point-LIO use.
///
/// Defaults: normals from the points; where a point has none, the direction to the view point;
/// without a view point, both sides. Points of one side stay 0.1 m apart, so that the nearest five
/// do not lie on one scan line, where they do not determine a plane; a side of a voxel keeps 20.
///
/// GetClosestPoint() is const, lock-free and does not allocate once `closest` has grown: it may run
/// under std::execution::par_unseq.
template <int dim, IVoxNodeType node_type, class PointType>
class IVox {
  static_assert(dim == 3, "nvm: maps have three dimensions");

 public:
  using PointVector = std::vector<PointType, Eigen::aligned_allocator<PointType>>;

  /// Which voxels a query looks into; only transparent maps do not look into all 26 + 1.
  enum class NearbyType { CENTER, NEARBY6, NEARBY18, NEARBY26 };

  struct Options {
    float resolution_ = 0.2F;  ///< [m]
    float inv_resolution_ = 5.0F;
    NearbyType nearby_type_ = NearbyType::NEARBY6;
    std::size_t capacity_ = 1000000;  ///< voxels

    /// What the host does not know. Voxels of size kFromResolution follow resolution_; the capacity
    /// follows capacity_.
    nvm::adapters::HostOptions nvm = defaults();
    KeyRounding key_rounding = KeyRounding::kRound;
    /// Behave as the host's own map, for comparisons; `nvm` is ignored.
    bool transparent = false;

    static constexpr double kFromResolution = 0.0;

   private:
    static nvm::adapters::HostOptions defaults() {
      nvm::adapters::HostOptions options;
      options.map.voxel_size = kFromResolution;
      options.surface_neighbors = nvm::adapters::kSurfaceNeighbors;
      return options;
    }
  };

  /// Throws std::invalid_argument when the options are out of range.
  explicit IVox(const Options& options) : options_(options) { map_.configure(host_options()); }

  /// Where the sensor is, map frame [m]: once per scan, before AddPoints().
  void set_view_point(double x, double y, double z) noexcept { map_.set_view_point({x, y, z}); }
  /// One line when points that are min_point_distance apart are too few for a plane; else empty.
  /// The host's filter size does not matter: it adds every point that finds too few.
  std::string density_warning() const {
    const nvm::MapOptions& map = map_.options().map;
    return nvm::adapters::density_warning(map.voxel_size, map.min_point_distance, kPlaneNeighbors);
  }
  const nvm::adapters::HostMap& map() const noexcept { return map_; }

  // --- what the host calls

  void AddPoints(const PointVector& points) { map_.insert(points); }

  /// The up to `max_num` (at most 64) nearest points within `max_range` [m], nearest first. False,
  /// and `closest` empty, when there is none. See HostOptions::surface_neighbors.
  bool GetClosestPoint(
      const PointType& point,
      PointVector& closest,
      int max_num = kPlaneNeighbors,
      double max_range = 5.0) const {
    std::array<nvm::Neighbor, nvm::kMaxNeighbors> found;
    const auto wanted = static_cast<std::size_t>(std::clamp<int>(max_num, 0, nvm::kMaxNeighbors));
    const nvm::NearestSearch search{wanted, max_range, nvm::Gate::kSurfaces};
    const std::size_t count = looks_everywhere() ? map_.nearest(point, search, found.data())
                                                 : search_nearby(point, search, found.data());
    nvm::adapters::write_positions(found.data(), count, closest);
    return count > 0;
  }

  std::size_t NumPoints() const noexcept { return map_.size(); }
  std::size_t NumValidGrids() const noexcept { return map_.voxel_count(); }

 private:
  static constexpr int kPlaneNeighbors = 5;

  nvm::adapters::HostOptions host_options() const {
    nvm::adapters::HostOptions options =
        options_.transparent ? nvm::adapters::transparent_options(options_.resolution_)
                             : options_.nvm;
    if (options.map.voxel_size == Options::kFromResolution) {
      options.map.voxel_size = options_.resolution_;
    }
    if (options_.transparent && options_.key_rounding == KeyRounding::kRound) {
      options.grid_offset = 0.5 * options_.resolution_;
    }
    options.map.capacity = options_.capacity_;
    return options;
  }

  bool looks_everywhere() const noexcept {
    return !options_.transparent || options_.nearby_type_ == NearbyType::NEARBY26;
  }

  std::size_t search_nearby(
      const PointType& point, const nvm::NearestSearch& search, nvm::Neighbor* out) const noexcept {
    if (map_.map() == nullptr || search.count == 0) {
      return 0;
    }
    const double size = map_.options().map.voxel_size;
    const auto cell = [size](const Eigen::Vector3d& p) {
      return Eigen::Array3d((p / size).array().floor());
    };
    const Eigen::Vector3d query = map_.to_grid(nvm::position(point));
    const Eigen::Array3d center = cell(query);
    const auto steps = static_cast<double>(options_.nearby_type_);  // along the axes, to a voxel
    const double reach = std::min(search.max_distance, 2.0 * std::sqrt(3.0) * size);
    nvm::detail::NearestList nearest(out, std::min(search.count, nvm::kMaxNeighbors));
    map_.map()->for_each_within(query, reach, [&](const nvm::Neighbor& n) {
      const Eigen::Array3d apart = (cell(n.position) - center).abs();
      if (apart.maxCoeff() <= 1.0 && apart.sum() <= steps) {
        nearest.show(n);
      }
    });
    std::for_each(out, out + nearest.count(), [this](nvm::Neighbor& n) {
      n.position = map_.from_grid(n.position);
    });
    return nearest.count();
  }

  Options options_;
  nvm::adapters::HostMap map_;
};

}  // namespace faster_lio
