// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/geometry/moments.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "support/rng.hpp"

namespace nvm {
namespace {

TEST(Moments, GiveTheScatterOfRandomPoints) {
  std::mt19937_64 rng = test::rng();
  std::normal_distribution<double> normal(3.0, 2.0);
  Eigen::Matrix<double, 100, 3> points;
  Moments<double> moments;
  for (int i = 0; i < points.rows(); ++i) {
    points.row(i) << normal(rng), normal(rng), normal(rng);
    moments.add(1.0, points(i, 0), points(i, 1), points(i, 2));
  }
  const auto centred = (points.rowwise() - points.colwise().mean()).eval();
  const Eigen::Matrix3d expected = centred.transpose() * centred;
  const Symmetric3<double> actual = scatter(moments);
  Eigen::Matrix3d dense;
  dense << actual.xx, actual.xy, actual.xz, actual.xy, actual.yy, actual.yz, actual.xz, actual.yz,
      actual.zz;
  EXPECT_TRUE(dense.isApprox(expected, 1e-12));
}

TEST(Moments, OfOnePointHaveNoScatter) {
  Moments<double> moments;
  moments.add(1.0, 0.25, 0.5, -1.0);
  const Symmetric3<double> s = scatter(moments);
  EXPECT_EQ(s.xx, 0.0);
  EXPECT_EQ(s.xy, 0.0);
  EXPECT_EQ(s.zz, 0.0);
}

}  // namespace
}  // namespace nvm
