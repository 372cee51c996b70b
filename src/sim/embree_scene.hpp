// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/embree.hpp"
#include "sim/scene.hpp"

namespace nvm::sim {

/// A ray with its luck with glass: it goes through what has a higher transmission than `pass`.
struct Ray {
  Eigen::Vector3d origin;     ///< [m]
  Eigen::Vector3d direction;  ///< unit
  double max_range = 0.0;     ///< [m]
  double pass = 1.0;          ///< in [0, 1)
};

/// A Scene in Embree, which finds the surface that a ray meets first, in single precision.
class EmbreeScene {
 public:
  /// `scene` must outlive this. Throws std::runtime_error when Embree refuses it.
  explicit EmbreeScene(const Scene& scene);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  struct Candidate {
    SurfaceId surface;  ///< a cylinder's face is not told
    double range = 0.0;
  };

  /// The first surface that `ray` meets from outside and does not pass through.
  std::optional<Candidate> nearest(const Ray& ray) const;

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  void add_boxes();
  void add_cylinders();
  void add_triangles(
      const std::vector<Eigen::Vector3d>& vertices,
      const std::vector<Triangle>& triangles,
      RTCFilterFunctionN filter,
      unsigned id);

  static void filter_box(const RTCFilterFunctionNArguments* arguments);
  static void filter_mesh(const RTCFilterFunctionNArguments* arguments);
  static void bound_cylinder(const RTCBoundsFunctionArguments* arguments);
  static void intersect_cylinder(const RTCIntersectFunctionNArguments* arguments);

  const Scene& scene_;
  RTCDevice device_;
  RTCScene embree_scene_;
};

}  // namespace nvm::sim
