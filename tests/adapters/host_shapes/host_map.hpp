// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "adapters/common/host_options.hpp"
#include "adapters/host_point.hpp"

namespace nvm::test {

/// The map of a host-shaped odometry, behind an adapter. All points are in the map frame.
class HostShapeMap {
 public:
  virtual ~HostShapeMap() = default;
  /// Once, before the first points.
  virtual void start(double filter_size) = 0;
  virtual void set_view_point(const Eigen::Vector3d& p_map_sensor) = 0;
  /// The points with which the host fills an empty map.
  virtual void build(const HostPoints& points) = 0;
  /// The points that the host chose to add; `crowded` have a neighbour in their cube.
  virtual void add(const HostPoints& crowded, const HostPoints& alone) = 0;
  /// At most `count`, nearest first.
  virtual void search(const HostPoint& point, int count, HostPoints& found) const = 0;
  virtual std::size_t size() const = 0;
};

/// Whose rules a host-shaped odometry follows.
enum class HostFamily { kFastLio, kFasterLio, kCtLio };

/// The host's own map (the transparent one, which its tests compare with a model of the host's), or
/// nvm's as a host gets it that has followed the family's page.
enum class HostMapKind { kOwn, kPatchA, kPatchB };

const char* name(HostFamily family);
const char* name(HostMapKind kind);

std::unique_ptr<HostShapeMap> make_host_map(HostFamily family, HostMapKind kind);

}  // namespace nvm::test
