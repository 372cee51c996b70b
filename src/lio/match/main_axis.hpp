// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace nvm::lio {

/// The axis that most of many directions lie along; a direction and its opposite are the same.
class MainAxis {
 public:
  /// Of unit length.
  void add(const std::vector<Eigen::Vector3d>& directions);

  /// The eigenvector of their scatter, of either sign; nothing before the first.
  std::optional<Eigen::Vector3d> axis() const;

 private:
  Eigen::Matrix3d scatter_ = Eigen::Matrix3d::Zero();
};

}  // namespace nvm::lio
