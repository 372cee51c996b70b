// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What ct-lio has defined before it includes nvm, in the places where it does.
#include <memory>
#include <utility>

namespace std {  // NOLINT(cert-dcl58-cpp)
template <typename T, typename... Args>
unique_ptr<T> make_unique(Args&&... args) {
  return unique_ptr<T>(new T(std::forward<Args>(args)...));
}
}  // namespace std

struct voxel {
  short x, y, z;
};

#include <gtest/gtest.h>

#include "adapters/ct_lio/ct_lio_map.hpp"
#include "nvm/normal/normal_estimator.hpp"

namespace {

TEST(HostNames, CtLioMapAndNormalsCompileBesideAHostsOwnMakeUnique) {
  std::vector<Eigen::Vector3d> wall;
  for (int i = 0; i < 400; ++i) {
    wall.emplace_back(0.05 * (i % 20), 0.05 * (i / 20), 0.1);
  }
  nvm::NormalEstimator estimator;
  const auto& normals = estimator.estimate(wall, Eigen::Vector3d(0.5, 0.5, 3.0)).normals;
  nvm::adapters::CtLioMap map;
  EXPECT_GT(map.add(wall, normals).stored, 20U);
  EXPECT_EQ(map.search({0.5, 0.5, 0.1}, {0, 0, 1}, 20).size(), 20U);
}

}  // namespace
