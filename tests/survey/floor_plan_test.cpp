// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/rng.hpp"
#include "survey/floor_plan.hpp"
#include "survey/survey.hpp"

namespace nvm::survey {
namespace {

/// True when `found` is the planned wall: its faces run along it, and its middle lies on it.
bool is_that(const Wall& found, const test::PlannedWall& planned) {
  const std::size_t axis = planned.along_x ? 1 : 0;
  const auto index = static_cast<Eigen::Index>(axis);
  const SurveyFace& face = found.faces[0];
  if (std::abs(face.plane.normal[index]) < 0.99) {
    return false;
  }
  double min = 1e9;
  double max = -1e9;
  double across = 0.0;
  for (const Eigen::Vector3d& p : face.polygon) {
    min = std::min(min, p[1 - index]);
    max = std::max(max, p[1 - index]);
    across += p[index] / static_cast<double>(face.polygon.size());
  }
  const double middle = across - 0.5 * found.thickness * face.plane.normal[index];
  return std::abs(middle - planned.at) < 0.02 && min > planned.from - 0.2 && max < planned.to + 0.2;
}

struct Score {
  int planned = 0;
  int found = 0;
  int right = 0;
  int covered = 0;  ///< whose 95 % interval holds the truth
  double worst = 0.0;
  std::string missed;
};

void score_plan(std::mt19937_64& random, double noise, Score& score) {
  test::FloorPlan plan(random);
  const Survey survey = survey_walls(plan.map(noise), {});
  score.planned += static_cast<int>(plan.walls().size());
  score.found += static_cast<int>(survey.walls.size() + survey.bodies.size());
  for (const test::PlannedWall& planned : plan.walls()) {
    const int right = score.right;
    for (const Wall& wall : survey.walls) {
      if (is_that(wall, planned)) {
        const double error = std::abs(wall.thickness - planned.thickness);
        ++score.right;
        score.covered += error < 1.96 * wall.thickness_std ? 1 : 0;
        score.worst = std::max(score.worst, error / noise);
        break;
      }
    }
    if (score.right == right) {
      score.missed += "\n" + std::to_string(planned.thickness) + " m thick, " +
                      std::to_string(planned.to - planned.from) + " m long, door at " +
                      std::to_string(planned.door - planned.from) + ", noise " +
                      std::to_string(noise);
    }
  }
}

// Recall and precision of 99 %, and 95 % intervals that hold 95 % of the time, within what chance
// makes of this number of walls; docs/walls.md has more of them.
TEST(FloorPlans, EveryWallIsFoundOnceAndAsThickAsTheIntervalSays) {
  auto random = test::rng();
  Score score;
  for (const double noise : {0.001, 0.003, 0.01}) {
    for (int plan = 0; plan < 15; ++plan) {
      score_plan(random, noise, score);
    }
  }
  ASSERT_GT(score.planned, 200);
  EXPECT_GE(score.right, 0.99 * score.planned) << score.missed;
  EXPECT_LE(score.found, 1.01 * score.planned);
  EXPECT_GE(score.covered, 0.92 * score.right) << score.right;
  RecordProperty("covered", score.covered);
  RecordProperty("right", score.right);
  EXPECT_LE(score.covered, 0.98 * score.right) << score.right;
  EXPECT_LT(score.worst, 0.5);
}

}  // namespace
}  // namespace nvm::survey
