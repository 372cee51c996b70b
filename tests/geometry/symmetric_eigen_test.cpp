// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/geometry/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "support/rng.hpp"

namespace nvm {
namespace {

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

Matrix random_rotation(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng))
      .normalized()
      .toRotationMatrix();
}

// Spectra from well separated to nearly and exactly degenerate, of any sign and scale.
Matrix random_matrix(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double gap = std::pow(10.0, 8.0 * (unit(rng) - 1.0));  // 1e-16 to 1
  const double a = unit(rng), b = unit(rng);
  const std::array<Vector, 8> spectra{
      Vector(a, b, unit(rng)),
      Vector(a, a + gap, b),
      Vector(a, a + gap, a - gap * b),
      Vector(0.0, gap, 1.0),
      Vector(gap, 1.0, 1.0),
      Vector(gap * gap, gap, 1.0),
      Vector(a, a, a),
      Vector(0.0, 0.0, a)};
  const Vector values = spectra[rng() % spectra.size()];
  const Matrix R = rng() % 8 == 0 ? Matrix::Identity() : random_rotation(rng);
  const double scale = std::pow(10.0, 10.0 * unit(rng));
  const Matrix m = scale * R * values.asDiagonal() * R.transpose();
  return 0.5 * (m + m.transpose());
}

template <class Real>
Symmetric3<Real> symmetric(const Matrix& m) {
  return {
      static_cast<Real>(m(0, 0)),
      static_cast<Real>(m(0, 1)),
      static_cast<Real>(m(0, 2)),
      static_cast<Real>(m(1, 1)),
      static_cast<Real>(m(1, 2)),
      static_cast<Real>(m(2, 2))};
}

template <class Real>
Matrix dense(const Symmetric3<Real>& m) {
  Matrix d;
  d << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return d;
}

template <class Real>
Matrix vectors(const Eigen3<Real>& e) {
  const auto& [s, m, l] = std::tie(e.smallest_vector, e.middle_vector, e.largest_vector);
  Matrix v;
  v << s.x, m.x, l.x, s.y, m.y, l.y, s.z, m.z, l.z;
  return v;
}

template <class Real>
class SymmetricEigen : public ::testing::Test {};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SymmetricEigen, Reals);

// The worst errors in units of the machine epsilon and the largest entry of the matrix.
struct Errors {
  double value = 0.0, residual = 0.0, orthogonality = 0.0;
};

template <class Real>
void measure(const Symmetric3<Real>& m, Errors& worst) {
  const Matrix exact = dense(m);
  const double unit =
      static_cast<double>(std::numeric_limits<Real>::epsilon()) * exact.cwiseAbs().maxCoeff();
  const Eigen3<Real> e = eigen_decomposition(m);
  const Vector values(e.smallest, e.middle, e.largest);
  const Matrix v = vectors(e);
  using Precise = std::conditional_t<std::is_same_v<Real, float>, double, long double>;
  const Eigen::Matrix<Precise, 3, 3> precise = exact.cast<Precise>();
  const Vector reference =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Precise, 3, 3>>(precise, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .template cast<double>();
  const Matrix residual = exact * v - v * values.asDiagonal();
  const double epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
  worst.value = std::max(worst.value, (values - reference).cwiseAbs().maxCoeff() / unit);
  worst.residual = std::max(worst.residual, residual.colwise().norm().maxCoeff() / unit);
  worst.orthogonality = std::max(
      worst.orthogonality,
      (v.transpose() * v - Matrix::Identity()).cwiseAbs().maxCoeff() / epsilon);
}

TYPED_TEST(SymmetricEigen, IsWithinItsStatedBoundOverAMillionMatrices) {
  std::mt19937_64 rng = test::rng();
  Errors worst;
  for (int i = 0; i < 1'000'000; ++i) {
    measure(symmetric<TypeParam>(random_matrix(rng)), worst);
  }
  EXPECT_LE(worst.value, 16.0);
  EXPECT_LE(worst.residual, 16.0);
  EXPECT_LE(worst.orthogonality, 16.0);
}

TYPED_TEST(SymmetricEigen, OrdersTheEigenvalues) {
  std::mt19937_64 rng = test::rng();
  for (int i = 0; i < 10'000; ++i) {
    const Eigen3<TypeParam> e = eigen_decomposition(symmetric<TypeParam>(random_matrix(rng)));
    EXPECT_LE(e.smallest, e.middle);
    EXPECT_LE(e.middle, e.largest);
  }
}

TYPED_TEST(SymmetricEigen, SolvesMatricesThatHaveNoDirection) {
  for (const double diagonal : {0.0, 1.0, -3.0, 1e10}) {
    const Eigen3<TypeParam> e =
        eigen_decomposition(symmetric<TypeParam>(diagonal * Matrix::Identity()));
    EXPECT_NEAR(static_cast<double>(e.smallest), diagonal, std::abs(diagonal) * 1e-6);
    EXPECT_NEAR(static_cast<double>(e.largest), diagonal, std::abs(diagonal) * 1e-6);
    EXPECT_TRUE(vectors(e).isUnitary(1e-5));
  }
}

TEST(SymmetricEigenLanes, EqualTheScalarPathBitForBit) {
  std::mt19937_64 rng = test::rng();
  for (int i = 0; i < 100'000; ++i) {
    Symmetric3<FloatLanes> batch;
    std::vector<Symmetric3<float>> single;
    for (std::size_t lane = 0; lane < kLaneCount; ++lane) {
      const Symmetric3<float> m = symmetric<float>(random_matrix(rng));
      single.push_back(m);
      batch.xx[lane] = m.xx;
      batch.xy[lane] = m.xy;
      batch.xz[lane] = m.xz;
      batch.yy[lane] = m.yy;
      batch.yz[lane] = m.yz;
      batch.zz[lane] = m.zz;
    }
    const Eigen3<FloatLanes> lanes = eigen_decomposition(batch);
    for (std::size_t lane = 0; lane < kLaneCount; ++lane) {
      const Eigen3<float> e = eigen_decomposition(single[lane]);
      const auto& n = lanes.smallest_vector;
      const float expected[6] = {
          e.smallest,
          e.middle,
          e.largest,
          e.smallest_vector.x,
          e.smallest_vector.y,
          e.smallest_vector.z};
      const float actual[6] = {
          lanes.smallest[lane],
          lanes.middle[lane],
          lanes.largest[lane],
          n.x[lane],
          n.y[lane],
          n.z[lane]};
      ASSERT_EQ(std::memcmp(expected, actual, sizeof(expected)), 0) << dense(single[lane]);
    }
  }
}

TEST(SymmetricEigenOfEigenTypes, GivesAscendingValuesAndVectorsInColumns) {
  std::mt19937_64 rng = test::rng();
  const Matrix R = random_rotation(rng);
  const Vector values(1.0, 2.0, 5.0);
  const EigenDecomposition e = eigen_decomposition(Matrix(R * values.asDiagonal() * R.transpose()));
  EXPECT_TRUE(e.values.isApprox(values, 1e-14));
  EXPECT_TRUE((R.transpose() * e.vectors).cwiseAbs().isIdentity(1e-14));
}

TEST(InverseSqrt, IsWithinTwoUnitsInTheLastPlace) {
  for (float x = 1e-30F; x < 1e30F; x *= 1.0001F) {
    const double exact = 1.0 / std::sqrt(static_cast<double>(x));
    ASSERT_NEAR(static_cast<double>(inverse_sqrt(x)) / exact, 1.0, 2.4e-7) << x;
  }
  EXPECT_TRUE(std::isfinite(inverse_sqrt(0.0F)));
}

}  // namespace
}  // namespace nvm
