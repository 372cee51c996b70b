// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace nvm::lio {

/// A unit vector as "(0.60, -0.80, 0.00)". An axis has no sign: its largest part is positive.
std::string axis_text(const Eigen::Vector3d& axis);

/// What a scan does not tell of its pose in the map: in a corridor the place along it, on a field
/// two places and the heading.
struct UnobservedDirections {
  std::vector<Eigen::Vector3d> translations;  ///< unit vectors, map frame
  std::vector<Eigen::Vector3d> rotations;     ///< unit axes, body frame

  bool empty() const { return translations.empty() && rotations.empty(); }
  int count() const { return static_cast<int>(translations.size() + rotations.size()); }

  /// Takes one direction of the pose, all of whose six parts are lengths [m]: it goes to where most
  /// of it is.
  void add(const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
    if (translation.squaredNorm() >= rotation.squaredNorm()) {
      translations.push_back(translation.normalized());
    } else {
      rotations.push_back(rotation.normalized());
    }
  }

  /// In words.
  std::string text() const;

  /// All six.
  static UnobservedDirections all() {
    UnobservedDirections all;
    for (int axis = 0; axis < 3; ++axis) {
      all.translations.push_back(Eigen::Vector3d::Unit(axis));
      all.rotations.push_back(Eigen::Vector3d::Unit(axis));
    }
    return all;
  }
};

}  // namespace nvm::lio
