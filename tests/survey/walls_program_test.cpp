// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/program_fixture.hpp"
#include "io/map_cloud.hpp"
#include "survey/surface_sampler.hpp"

namespace nvm::survey {
namespace {

using ::testing::HasSubstr;

class WallsProgramTest : public test::ProgramFixture {
 protected:
  void SetUp() override {
    ProgramFixture::SetUp();
    std::filesystem::create_directories(path("walls"));
    auto random = test::rng();
    test::SurfaceSampler sampler(random);
    sampler.add_wall({0, 0}, {4, 0}, 0.05, 2.5);
    io::write_map_cloud(path("walls/map.ply"), sampler.cloud);
    sampler.cloud.normals.clear();
    io::write_map_cloud(path("walls/bare.pcd"), sampler.cloud);
  }
};

TEST_F(WallsProgramTest, WritesTheListAndThePlan) {
  const test::Outcome outcome = nvm("walls " + path("walls/map.ply") + " --out " + path("out"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("1 seen from both sides"));
  EXPECT_THAT(
      names_in("out"),
      ::testing::UnorderedElementsAre(
          "walls.json", "walls.csv", "plan.svg", "plan.dxf", "walls.html", "faces.obj"));
  const auto list = nlohmann::json::parse(test::text_of(path("out/walls.json")));
  ASSERT_EQ(list["walls"].size(), 1U);
  const auto& wall = list["walls"][0];
  EXPECT_NEAR(wall["thickness"].get<double>(), 0.05, 0.001);
  EXPECT_GT(wall["thickness_std"].get<double>(), 0.0);
  ASSERT_EQ(wall["faces"].size(), 2U);
  for (const auto& face : wall["faces"]) {
    EXPECT_EQ(face["polygon"].size(), 4U);
    const auto n = face["normal"].get<std::vector<double>>();
    for (const auto& corner : face["polygon"]) {
      const auto p = corner.get<std::vector<double>>();
      EXPECT_NEAR(n[0] * p[0] + n[1] * p[1] + n[2] * p[2], face["d"].get<double>(), 1e-6);
    }
    EXPECT_GT(face["points"].get<int>(), 500);
    EXPECT_NEAR(face["rms"].get<double>(), 0.003, 0.001);
  }
  EXPECT_TRUE(list["faces"].empty());
  EXPECT_THAT(test::text_of(path("out/plan.svg")), HasSubstr(">50</text>"));
  const std::string page = test::text_of(path("out/walls.html"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_EQ(page.find("src="), std::string::npos);
}

TEST_F(WallsProgramTest, ASavedMapAndItsPointsGiveTheSame) {
  ASSERT_EQ(nvm(map("poses.tum")).status, 0);
  ASSERT_EQ(nvm("walls " + path("out/map.nvm") + " --out " + path("a")).status, 0);
  ASSERT_EQ(nvm("walls " + path("out/map.nvm") + " --out " + path("b")).status, 0);
  for (const std::string& name : names_in("a")) {
    EXPECT_EQ(test::text_of(path("a/" + name)), test::text_of(path("b/" + name))) << name;
  }
  const auto faces = nlohmann::json::parse(test::text_of(path("a/walls.json")))["faces"];
  EXPECT_GE(faces.size(), 5U);
}

TEST_F(WallsProgramTest, BadInputGivesOneLineAndLeavesNothing) {
  expect_failure("walls " + path("walls/bare.pcd") + " --out " + path("out"), "normal");
  expect_failure("walls " + path("nowhere.ply") + " --out " + path("out"), "nowhere.ply");
  expect_failure("walls " + path("poses.tum") + " --out " + path("out"), "is not an nvm map");
  expect_failure(
      "walls " + path("walls/map.ply") + " --out " + path("out") + " --min-area 0", "min_area");
  expect_failure(
      "walls " + path("walls/map.ply") + " --out " + path("out") + " --min-area 50", "--min-area");
}

}  // namespace
}  // namespace nvm::survey
