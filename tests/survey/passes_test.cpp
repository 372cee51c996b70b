// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/rng.hpp"
#include "survey/surface_sampler.hpp"
#include "survey/survey.hpp"

namespace nvm::survey {
namespace {

using ::testing::SizeIs;

constexpr double kThickness = 0.08;  // [m]
constexpr double kLength = 2.5;
constexpr double kNoise = 0.002;

/// Walls along x, side by side at every 3 m of y, and the keyframes that saw their sides.
class Walk {
 public:
  explicit Walk(std::mt19937_64& random) : random_(random), sampler_(random) {
    sampler_.noise = kNoise;
  }

  /// A side (0 or 1) of wall `index` as the map has it: off by `shift` [m] along its normal.
  void map_side(int index, int side, double shift) { add_side(sampler_, index, side, shift); }

  /// The same in a keyframe.
  void see_side(int index, int side, double shift, double time) {
    test::SurfaceSampler sampler(random_);
    sampler.noise = kNoise;
    sampler.spacing = 0.2;
    add_side(sampler, index, side, shift);
    io::Keyframe keyframe;
    keyframe.time = time;
    keyframe.T_map_lidar.translation() << 0.5 * kLength, 3.0 * index + (side == 0 ? -1.4 : 1.4),
        1.2;
    const Pose T_lidar_map = keyframe.T_map_lidar.inverse();
    for (std::size_t i = 0; i < sampler.cloud.positions.size(); ++i) {
      keyframe.points.push_back((T_lidar_map * sampler.cloud.positions[i]).cast<float>());
      keyframe.normals.push_back(sampler.cloud.normals[i]);
    }
    keyframes_.push_back(keyframe);
  }

  Survey survey() const {
    return survey_walls(sampler_.cloud, {}, [this, next = std::size_t{0}]() mutable {
      return next < keyframes_.size() ? std::optional(keyframes_[next++]) : std::nullopt;
    });
  }
  Survey survey_without_keyframes() const { return survey_walls(sampler_.cloud, {}); }

 private:
  static void add_side(test::SurfaceSampler& sampler, int index, int side, double shift) {
    const double y = 3.0 * index;
    const Eigen::Vector3d z(0, 0, 2.4);
    if (side == 0) {
      sampler.add({0, y - 0.5 * kThickness - shift, 0}, {kLength, 0, 0}, z);
    } else {
      sampler.add({kLength, y + 0.5 * kThickness + shift, 0}, {-kLength, 0, 0}, z);
    }
  }

  std::mt19937_64& random_;
  test::SurfaceSampler sampler_;
  std::vector<io::Keyframe> keyframes_;
};

TEST(Passes, SidesSeenWithinTenSecondsAreOfOnePass) {
  auto random = test::rng();
  Walk walk(random);
  for (int wall = 0; wall < 3; ++wall) {
    walk.map_side(wall, 0, 0.0);
    walk.map_side(wall, 1, 0.0);
    walk.see_side(wall, 0, 0.0, 100.0);
    walk.see_side(wall, 0, 0.0, 101.0);
  }
  walk.see_side(0, 1, 0.0, 109.0);
  walk.see_side(1, 1, 0.0, 131.0);  // and the third's other side in no keyframe
  const Survey survey = walk.survey();
  ASSERT_THAT(survey.walls, SizeIs(3));
  for (const Wall& wall : survey.walls) {
    const double y = wall.faces[0].polygon[0].y();
    const int index = static_cast<int>(std::lround(y / 3.0));
    EXPECT_EQ(
        wall.passes,
        index == 0   ? Passes::kOne
        : index == 1 ? Passes::kTwo
                     : Passes::kUnknown);
    EXPECT_NEAR(wall.time_between, index == 0 ? 8.0 : index == 1 ? 30.0 : 0.0, 1e-9);
  }
  for (const Wall& wall : walk.survey_without_keyframes().walls) {
    EXPECT_EQ(wall.passes, Passes::kUnknown);
  }
}

TEST(Passes, PosesWithoutErrorAddNothing) {
  auto random = test::rng();
  Walk walk(random);
  for (int wall = 0; wall < 6; ++wall) {
    for (const int side : {0, 1}) {
      walk.map_side(wall, side, 0.0);
      for (int i = 0; i < 8; ++i) {
        walk.see_side(wall, side, 0.0, 40.0 * wall + 20.0 * side + (i < 4 ? i : 300 + i));
      }
    }
  }
  const Survey survey = walk.survey();
  EXPECT_LT(survey.jitter, 0.1 * kNoise);
  EXPECT_LT(survey.drift, 0.1 * kNoise);
}

// Sides shift by 1 mm from pass to pass, and by 0.5 mm from keyframe to keyframe. Nothing in the
// map tells; the keyframes of later passes, which the map did not need, do.
TEST(Passes, IntervalsHoldWhenPosesDriftBetweenPasses) {
  constexpr double kDrift = 0.001;
  constexpr double kJitter = 0.0005;
  auto random = test::rng();
  std::normal_distribution<double> normal;
  int walls = 0;
  int covered = 0;
  int covered_without = 0;
  for (int map = 0; map < 4; ++map) {
    Walk walk(random);
    for (int wall = 0; wall < 20; ++wall) {
      for (const int side : {0, 1}) {
        for (int pass = 0; pass < 2; ++pass) {
          const double drift = kDrift * normal(random);
          double mean = 0.0;
          for (int i = 0; i < 4; ++i) {
            const double shift = drift + kJitter * normal(random);
            mean += shift / 4.0;
            walk.see_side(wall, side, shift, 40.0 * wall + 20.0 * side + i + 2000.0 * pass);
          }
          if (pass == 0) {
            walk.map_side(wall, side, mean);
          }
        }
      }
    }
    const Survey survey = walk.survey();
    EXPECT_NEAR(survey.jitter, kJitter, 0.15 * kJitter);
    EXPECT_NEAR(survey.drift, kDrift, 0.35 * kDrift);
    const auto count = [](const Survey& list) {
      int inside = 0;
      for (const Wall& wall : list.walls) {
        inside += std::abs(wall.thickness - kThickness) < 1.96 * wall.thickness_std ? 1 : 0;
      }
      return inside;
    };
    walls += static_cast<int>(survey.walls.size());
    covered += count(survey);
    covered_without += count(walk.survey_without_keyframes());
  }
  ASSERT_EQ(walls, 80);
  EXPECT_GE(covered, 72);
  EXPECT_LT(covered_without, 40);
}

/// Three walls whose points are off along the normal by `shift(along, up)` [m].
template <class Shift>
Survey survey_of_shifted(std::mt19937_64& random, const Shift& shift) {
  test::SurfaceSampler sampler(random);
  sampler.noise = 1e-4;
  for (int wall = 0; wall < 3; ++wall) {
    sampler.add_wall({0, 3.0 * wall}, {6, 3.0 * wall}, kThickness, 2.5);
  }
  for (Eigen::Vector3d& p : sampler.cloud.positions) {
    p.y() += shift(p.x(), p.z());
  }
  return survey_walls(sampler.cloud, {});
}

// A millimetre of each 20 cm for itself is averaged out by a wall's size; a wave of 3 m is not.
TEST(Passes, OnlyWhatHalfMetresHaveInCommonCountsAsAShiftOfTheSide) {
  constexpr double kShift = 0.001;
  auto random = test::rng();
  std::normal_distribution<double> normal;
  std::vector<double> cells(30 * 13);
  std::generate(cells.begin(), cells.end(), [&] { return kShift * normal(random); });
  const Survey each = survey_of_shifted(random, [&](double along, double up) {
    const int column = std::clamp(static_cast<int>(along / 0.2), 0, 29);
    const int row = std::clamp(static_cast<int>(up / 0.2), 0, 12);
    return cells[static_cast<std::size_t>(13 * column + row)];
  });
  EXPECT_LT(each.bend, 0.25 * kShift);
  EXPECT_GT(each.inflation, 3.0);
  const Survey together = survey_of_shifted(random, [](double along, double /*up*/) {
    return std::sqrt(2.0) * kShift * std::sin(2.0 * along);
  });
  EXPECT_NEAR(together.bend, kShift, 0.4 * kShift);
}

}  // namespace
}  // namespace nvm::survey
