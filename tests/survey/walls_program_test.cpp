// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/program_fixture.hpp"
#include "io/result/map_cloud.hpp"
#include "io/result/session_file.hpp"
#include "io/result/tile_store.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/voxel_map.hpp"
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

constexpr double kTile = 2.0;  // [m]

/// Whether `position` lies in the tile from `low`, or within `margin` [m] of it.
bool is_in_tile(const Eigen::Vector3d& position, const Eigen::Vector3d& low, double margin) {
  const Eigen::Array3d offset = (position - low).array();
  return (offset >= -margin).all() && (offset < kTile + margin).all();
}

/// The points of the tile from `low`, with those of its neighbours that are near.
VoxelMap tile_map(const io::MapCloud& cloud, const Eigen::Vector3d& low) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> normals;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    if (is_in_tile(cloud.positions[i], low, 0.6)) {
      points.push_back(cloud.positions[i]);
      normals.push_back(cloud.normals[i]);
    }
  }
  MapOptions options;
  options.min_point_distance = 0.0;
  VoxelMap map(options);
  map.insert(points, normals);
  return map;
}

/// Writes `cloud` as a store of tiles; returns how many points there are.
std::size_t write_store(const std::string& folder, const io::MapCloud& cloud) {
  std::filesystem::create_directories(folder + "/tiles");
  std::size_t total = 0;
  nlohmann::json tiles = nlohmann::json::array();
  for (int cell = 0; cell < 24; ++cell) {
    const Eigen::Vector3i tile(cell % 4 - 1, cell / 4 % 2 - 1, cell / 8 - 1);
    const Eigen::Vector3d low = kTile * tile.cast<double>();
    const VoxelMap map = tile_map(cloud, low);
    std::size_t own = 0;
    for (const MapPoint& point : map.points()) {
      own += is_in_tile(point.position, low, 0.0) ? 1 : 0;
    }
    if (own > 0) {
      const std::string file = "tiles/" + std::to_string(tiles.size()) + ".nvm";
      save_map(map, folder + "/" + file);
      tiles.push_back({{"tile", {tile.x(), tile.y(), tile.z()}}, {"file", file}, {"points", own}});
      total += own;
    }
  }
  std::ofstream(folder + "/index.json") << nlohmann::json(
      {{"format", "nvm-store"}, {"version", 1}, {"tile_size", kTile}, {"tiles", tiles}});
  return total;
}

TEST_F(WallsProgramTest, AStoreOfTilesIsOneMap) {
  const io::MapCloud cloud = io::read_map_cloud(path("walls/map.ply"));
  const std::size_t total = write_store(path("store"), cloud);
  EXPECT_EQ(io::read_tile_store(path("store")).positions.size(), total);
  const test::Outcome outcome = nvm("walls " + path("store") + " --out " + path("out"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const auto list = nlohmann::json::parse(test::text_of(path("out/walls.json")));
  ASSERT_EQ(list["walls"].size(), 1U);
  EXPECT_NEAR(list["walls"][0]["thickness"].get<double>(), 0.05, 0.001);
  EXPECT_NEAR(list["walls"][0]["length"].get<double>(), 4.0, 0.05);
}

/// A keyframe of one side of the wall of map.ply, from 2 m before it.
io::Keyframe keyframe_of(const io::MapCloud& cloud, double side, double time) {
  io::Keyframe keyframe;
  keyframe.time = time;
  keyframe.T_map_lidar.translation() << 2.0, 2.0 * side, 1.0;
  for (std::size_t i = 0; i < cloud.positions.size(); i += 3) {
    if (cloud.normals[i].y() * side > 0.5) {
      keyframe.points.push_back(
          (cloud.positions[i] - keyframe.T_map_lidar.translation()).cast<float>());
      keyframe.normals.push_back(cloud.normals[i]);
    }
  }
  return keyframe;
}

TEST_F(WallsProgramTest, TheKeyframesOfARunTellOfPasses) {
  const io::MapCloud cloud = io::read_map_cloud(path("walls/map.ply"));
  MapOptions options;
  options.min_point_distance = 0.0;
  VoxelMap map(options);
  map.insert(cloud.positions, cloud.normals);
  save_map(map, path("walls/map.nvm"));
  {
    io::SessionWriter writer(path("walls/session.nvms"));
    writer.add(keyframe_of(cloud, -1.0, 10.0));
    writer.add(keyframe_of(cloud, 1.0, 14.0));
    writer.finish(io::stamp_of(path("walls/map.nvm")));
  }
  const test::Outcome outcome = nvm("walls " + path("walls") + " --out " + path("out"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const auto wall = nlohmann::json::parse(test::text_of(path("out/walls.json")))["walls"][0];
  EXPECT_EQ(wall["passes"], "one");
  EXPECT_NEAR(wall["time_between"].get<double>(), 4.0, 1e-9);
  EXPECT_THAT(test::text_of(path("out/walls.csv")), HasSubstr(",one,"));
  EXPECT_THAT(test::text_of(path("out/walls.html")), HasSubstr("<td>one</td>"));

  map.insert(cloud.positions, cloud.normals);
  save_map(map, path("walls/map.nvm"));
  const test::Outcome other = nvm("walls " + path("walls/map.nvm") + " --out " + path("out"));
  ASSERT_EQ(other.status, 0) << other.errors;
  EXPECT_THAT(other.errors, HasSubstr("is of another map"));
  const auto list = nlohmann::json::parse(test::text_of(path("out/walls.json")));
  EXPECT_EQ(list["walls"][0]["passes"], "unknown");
  EXPECT_TRUE(list["walls"][0]["time_between"].is_null());
}

TEST_F(WallsProgramTest, ADamagedStoreIsRefused) {
  write_store(path("store"), io::read_map_cloud(path("walls/map.ply")));
  const std::string walls = "walls " + path("store") + " --out " + path("out");
  const std::string index = test::text_of(path("store/index.json"));
  std::filesystem::copy_file(
      path("store/tiles/0.nvm"),
      path("store/tiles/1.nvm"),
      std::filesystem::copy_options::overwrite_existing);
  expect_failure(walls, "tiles/1.nvm: is not the file that index.json tells of");
  write(
      "store/index.json",
      std::string(index).replace(index.find("\"version\":1"), 11, "\"version\":2"));
  expect_failure(walls, "has version 2");
  write("store/index.json", std::string(index).replace(index.find("tiles/0.nvm"), 11, "../0.nvm"));
  expect_failure(walls, "names a file outside the store: ../0.nvm");
  write("store/index.json", index.substr(0, index.size() / 2));
  expect_failure(walls, "is not the index of a store");
  std::filesystem::remove(path("store/index.json"));
  expect_failure(walls, "index.json: is missing");
}

TEST_F(WallsProgramTest, MillimetresAndAnEmptyPlanAreNamed) {
  io::MapCloud cloud = io::read_map_cloud(path("walls/map.ply"));
  const test::Outcome outcome =
      nvm("walls " + path("walls/map.ply") + " --height 50 --out " + path("out"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("the plan is empty"));
  for (Eigen::Vector3d& p : cloud.positions) {
    p *= 1000.0;
  }
  io::write_map_cloud(path("walls/mm.ply"), cloud);
  std::filesystem::remove_all(path("out"));
  expect_failure("walls " + path("walls/mm.ply") + " --out " + path("out"), "millimetres");
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
