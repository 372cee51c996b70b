// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// Doors, windows and what lies between.
#include <gmock/gmock.h>

#include <array>

#include "support/rng.hpp"
#include "survey/surface_sampler.hpp"
#include "survey/survey.hpp"

namespace nvm::survey {
namespace {

using test::SurfaceSampler;
using ::testing::SizeIs;

TEST(SurveyOpenings, FacesGoOnBehindADoorAndTheDoorIsAnOpening) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {2, 0}, 0.1, 2.5);
  sampler.add_wall({3, 0}, {6, 0}, 0.1, 2.5);
  SurfaceSampler lintel(random);
  lintel.add_wall({2, 0}, {3, 0}, 0.1, 0.5);
  sampler.add_moved(lintel, {0, 0, 2.0});
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(survey.walls, SizeIs(1));
  EXPECT_NEAR(survey.walls[0].length, 6.0, 0.11);
  ASSERT_THAT(survey.walls[0].openings, SizeIs(1));
  const Opening& door = survey.walls[0].openings[0];
  EXPECT_EQ(door.kind, "door");
  EXPECT_NEAR(door.width, 1.0, 0.1);
  EXPECT_NEAR(door.height, 2.0, 0.11);
}

// Wider than the gaps that faces are joined across.
TEST(SurveyOpenings, AWideWindowIsAnOpening) {
  for (const double width : {1.2, 2.4, 3.6}) {
    auto random = test::rng();
    SurfaceSampler sampler(random);
    sampler.add_wall({0, 0}, {2, 0}, 0.1, 2.5);
    sampler.add_wall({2, 0}, {2.0 + width, 0}, 0.1, 0.9);
    sampler.add_wall({2.0 + width, 0}, {4.0 + width, 0}, 0.1, 2.5);
    SurfaceSampler above(random);
    above.add_wall({2, 0}, {2.0 + width, 0}, 0.1, 0.5);
    sampler.add_moved(above, {0, 0, 2.0});
    const Survey survey = survey_walls(sampler.cloud, {});
    ASSERT_THAT(survey.walls, SizeIs(1)) << width;
    ASSERT_THAT(survey.walls[0].openings, SizeIs(1)) << width;
    const Opening& window = survey.walls[0].openings[0];
    EXPECT_EQ(window.kind, "window") << width;
    EXPECT_NEAR(window.width, width, 0.1);
    EXPECT_NEAR(window.height, 1.1, 0.1);
  }
}

// From a sensor on a pole the foot of a wall is hidden, on both sides of its doors as well.
TEST(SurveyOpenings, ADoorWhoseFootNobodySawIsADoor) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  for (const auto& [from, to, foot] :
       {std::array{0.0, 1.0, 0.0}, {1.0, 2.0, 0.5}, {3.0, 6.0, 0.5}}) {
    SurfaceSampler piece(random);
    piece.add_wall({from, 0}, {to, 0}, 0.1, 2.5 - foot);
    sampler.add_moved(piece, {0, 0, foot});
  }
  SurfaceSampler lintel(random);
  lintel.add_wall({2, 0}, {3, 0}, 0.1, 0.4);
  sampler.add_moved(lintel, {0, 0, 2.1});
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(survey.walls, SizeIs(1));
  ASSERT_THAT(survey.walls[0].openings, SizeIs(1));
  EXPECT_EQ(survey.walls[0].openings[0].kind, "door");
  EXPECT_NEAR(survey.walls[0].openings[0].height, 2.1, 0.11);
}

}  // namespace
}  // namespace nvm::survey
