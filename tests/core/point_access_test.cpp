// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/core/point_access.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/StdVector>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace {

struct FloatRecord {
  float x, y, z, intensity;
};

struct DoubleRecord {
  double time, z, y, x;
};

struct MillimetreRecord {
  std::int32_t x, y, z;
};

/// The layout of PCL's points: padded to 16 bytes, coordinates also reachable as an array.
struct alignas(16) PaddedRecord {
  union {
    float data[4];
    __extension__ struct { float x, y, z; };
  };
  std::uint16_t ring;
};

/// A record that must not be copied to be read.
struct PinnedRecord {
  PinnedRecord(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  PinnedRecord(const PinnedRecord&) = delete;
  PinnedRecord& operator=(const PinnedRecord&) = delete;
  float x, y, z;
};

/// A record with names of its own, made known by the specialisation below.
class SurveyPoint {
 public:
  SurveyPoint(double east, double north, double up) : east_(east), north_(north), up_(up) {}
  double east() const { return east_; }
  double north() const { return north_; }
  double up() const { return up_; }

 private:
  double east_, north_, up_;
};

struct Planar {
  double x, y;
};

struct TextRecord {
  std::string x, y, z;
};

/// Like pcl::PointCloud: a container in a member, with the size and the index forwarded.
struct Cloud {
  std::vector<PaddedRecord, Eigen::aligned_allocator<PaddedRecord>> points;
  std::size_t size() const { return points.size(); }
  const PaddedRecord& operator[](std::size_t i) const { return points[i]; }
};

/// Columns of a matrix as points, made when asked for.
struct ColumnView {
  const Eigen::Matrix3Xf& columns;
  std::size_t size() const { return static_cast<std::size_t>(columns.cols()); }
  auto operator[](std::size_t i) const { return columns.col(static_cast<Eigen::Index>(i)); }
};

}  // namespace

template <>
struct nvm::PointAccess<SurveyPoint> {
  static Eigen::Vector3d position(const SurveyPoint& point) {
    return {point.east(), point.north(), point.up()};
  }
};

namespace nvm::test {
namespace {

const Eigen::Vector3d kExpected(1.0, -2.0, 3.0);

template <class Point>
Point make_point() {
  return Point{1, -2, 3};
}
template <>
FloatRecord make_point() {
  return {1.0F, -2.0F, 3.0F, 99.0F};
}
template <>
DoubleRecord make_point() {
  return {99.0, 3.0, -2.0, 1.0};
}
template <>
PaddedRecord make_point() {
  PaddedRecord point{};
  point.x = 1.0F;
  point.y = -2.0F;
  point.z = 3.0F;
  return point;
}

template <class Point>
class PointAccessLaws : public ::testing::Test {};
using PointTypes = ::testing::Types<
    FloatRecord,
    DoubleRecord,
    MillimetreRecord,
    PaddedRecord,
    SurveyPoint,
    Eigen::Vector3f,
    Eigen::Vector3d,
    Eigen::Vector3i,
    Eigen::RowVector3d>;
TYPED_TEST_SUITE(PointAccessLaws, PointTypes);

TYPED_TEST(PointAccessLaws, ReadsTheCoordinates) {
  static_assert(is_point_v<TypeParam> && is_point_v<const TypeParam>);
  EXPECT_EQ(position(make_point<TypeParam>()), kExpected);
}

TYPED_TEST(PointAccessLaws, ContainersOfItAreRanges) {
  static_assert(is_point_range_v<std::vector<TypeParam>>);
  static_assert(is_point_range_v<std::vector<TypeParam, Eigen::aligned_allocator<TypeParam>>>);
  static_assert(is_point_range_v<std::array<TypeParam, 4>>);
  static_assert(is_point_range_v<std::deque<TypeParam>>);
  const std::vector<TypeParam> range{make_point<TypeParam>()};
  EXPECT_EQ(position(range[0]), kExpected);
}

TEST(PointAccess, ReadsARecordInPlace) {
  const PinnedRecord point(1.0F, -2.0F, 3.0F);
  EXPECT_EQ(position(point), kExpected);
}

TEST(PointAccess, ReadsEigenMapsBlocksAndExpressions) {
  const std::array<float, 3> raw{1.0F, -2.0F, 3.0F};
  EXPECT_EQ(position(Eigen::Map<const Eigen::Vector3f>(raw.data())), kExpected);

  Eigen::Matrix4d homogeneous = Eigen::Matrix4d::Identity();
  homogeneous.topRightCorner<3, 1>() = kExpected;
  EXPECT_EQ(position(homogeneous.topRightCorner<3, 1>()), kExpected);
  EXPECT_EQ(position(homogeneous.col(3).head<3>()), kExpected);

  EXPECT_EQ(position(0.5 * kExpected + 0.5 * kExpected), kExpected);
  EXPECT_EQ(position(Eigen::Matrix3d::Identity() * kExpected), kExpected);
}

TEST(PointAccess, ReadsACloudAndAView) {
  Cloud cloud;
  cloud.points.push_back(make_point<PaddedRecord>());
  static_assert(is_point_range_v<Cloud>);
  EXPECT_EQ(position(cloud[0]), kExpected);

  const Eigen::Matrix3Xf columns = kExpected.cast<float>().replicate<1, 2>();
  static_assert(is_point_range_v<ColumnView>);
  EXPECT_EQ(position(ColumnView{columns}[1]), kExpected);
}

TEST(PointAccess, KeepsDoublePrecisionFarFromTheOrigin) {
  const DoubleRecord point{0.0, 3.0e6 + 1e-9, 2.0, 1.0e6 + 1e-10};
  EXPECT_EQ(position(point), Eigen::Vector3d(1.0e6 + 1e-10, 2.0, 3.0e6 + 1e-9));
}

TEST(PointAccess, PassesNonFiniteCoordinatesOn) {
  const FloatRecord point{NAN, INFINITY, 0.0F, 0.0F};
  EXPECT_TRUE(std::isnan(position(point).x()));
  EXPECT_TRUE(std::isinf(position(point).y()));
}

TEST(PointAccess, RefusesWhatIsNotAPoint) {
  static_assert(!is_point_v<int>);
  static_assert(!is_point_v<Planar>);
  static_assert(!is_point_v<TextRecord>);
  static_assert(!is_point_v<std::array<double, 3>>);
  static_assert(!is_point_v<Eigen::Vector2d>);
  static_assert(!is_point_v<Eigen::Vector4d>);
  static_assert(!is_point_v<Eigen::VectorXd>);
  static_assert(!is_point_v<Eigen::Quaterniond>);
}

TEST(PointAccess, RefusesWhatIsNotARangeOfPoints) {
  static_assert(!is_point_range_v<FloatRecord>);
  static_assert(!is_point_range_v<FloatRecord*>);
  static_assert(!is_point_range_v<std::vector<double>>);
  static_assert(!is_point_range_v<std::vector<Eigen::Vector4d>>);
  static_assert(!is_point_range_v<std::string>);
  static_assert(!is_point_range_v<Eigen::Vector3d>);
}

}  // namespace
}  // namespace nvm::test
