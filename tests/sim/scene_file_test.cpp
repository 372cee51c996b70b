// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/scene_file.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "io/temporary_folder.hpp"
#include "sim/rectangle_cut.hpp"
#include "support/rng.hpp"

namespace nvm::sim {
namespace {

bool contains(const Rectangle& r, double u, double v) {
  return r.min_u < u && u < r.max_u && r.min_v < v && v < r.max_v;
}

TEST(RectangleCut, LeavesEachPointOfTheWholeOutsideOpeningsInOnePiece) {
  auto rng = test::rng();
  std::uniform_real_distribution<double> along(-1.0, 11.0);
  std::uniform_real_distribution<double> up(-1.0, 4.0);
  const Rectangle whole{0.0, 10.0, 0.0, 3.0};
  for (int round = 0; round < 50; ++round) {
    std::vector<Rectangle> openings;
    for (int i = 0; i < round % 5; ++i) {
      const double u = along(rng);
      const double v = up(rng);
      openings.push_back({u, u + 1.5, v, v + 1.2});
    }
    const auto pieces = cut_openings(whole, openings);
    for (int i = 0; i < 500; ++i) {
      const double u = along(rng);
      const double v = up(rng);
      const auto holds = [&](const Rectangle& r) { return contains(r, u, v); };
      const bool is_solid = holds(whole) && std::none_of(openings.begin(), openings.end(), holds);
      EXPECT_EQ(std::count_if(pieces.begin(), pieces.end(), holds), is_solid ? 1 : 0);
    }
  }
}

TEST(SceneFile, AWallHasTwoFacesAndPiecesAroundItsDoor) {
  const Scene scene = parse_scene(
      "walls:\n"
      "  - {name: w, from: [1, 2], to: [1, 8], thickness: 0.12, height: 2.5,"
      "     openings: [{from: 2, to: 3}]}\n",
      "test.yaml");
  ASSERT_EQ(scene.wall_pieces.size(), 3U);
  ASSERT_EQ(scene.boxes.size(), 3U);
  for (const WallPiece& piece : scene.wall_pieces) {
    EXPECT_EQ(piece.wall, "w");
    EXPECT_NEAR(thickness(scene, piece), 0.12, 1e-12);
    const Face a = box_face(scene.boxes[piece.box], piece.axis, 0);
    const Face b = box_face(scene.boxes[piece.box], piece.axis, 1);
    EXPECT_NEAR(std::abs(a.normal.x()), 1.0, 1e-12);
    EXPECT_TRUE(a.normal.isApprox(-b.normal));
    EXPECT_NEAR(a.offset + b.offset, 0.12, 1e-12);
    EXPECT_NEAR(a.normal.dot(a.center), a.offset, 1e-12);
  }
  const Box& lintel = scene.boxes[1];
  EXPECT_TRUE(lintel.T_world_box.translation().isApprox(Eigen::Vector3d(1.0, 4.5, 2.275)));
  EXPECT_NEAR(lintel.half_size.z(), 0.225, 1e-12);
}

TEST(SceneFile, ASlabIsAHorizontalWall) {
  const Scene scene = parse_scene(
      "slabs: [{name: s, min: [0, 0], max: [4, 3], top: 3, thickness: 0.2,"
      " openings: [{min: [1, 1], max: [2, 2]}]}]\n",
      "test.yaml");
  ASSERT_EQ(scene.wall_pieces.size(), 4U);
  const Face top = box_face(scene.boxes[0], scene.wall_pieces[0].axis, 1);
  EXPECT_TRUE(top.normal.isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(top.offset, 3.0, 1e-12);
}

TEST(SceneFile, RepeatsAndPlacesObjects) {
  const Scene scene = parse_scene(
      "materials: {white: {reflectivity: 0.9}}\n"
      "objects:\n"
      "  stool:\n"
      "    boxes: [{name: seat, center: [0, 0, 0.5], size: [0.4, 0.2, 0.1], material: white}]\n"
      "    cylinders: [{name: leg, bottom: [0.1, 0, 0], radius: 0.02, height: 0.45}]\n"
      "place:\n"
      "  - {object: stool, at: [3, 4], yaw_deg: 90, name: bar,\n"
      "     repeat: [{count: 2, step: [0, 2]}, {count: 3, step: [1, 0]}]}\n",
      "test.yaml");
  ASSERT_EQ(scene.boxes.size(), 6U);
  ASSERT_EQ(scene.cylinders.size(), 6U);
  EXPECT_EQ(scene.boxes[5].name, "bar_2_3/seat");
  EXPECT_EQ(scene.boxes[5].material.reflectivity, 0.9);
  EXPECT_TRUE(scene.boxes[5].T_world_box.translation().isApprox(Eigen::Vector3d(5.0, 6.0, 0.5)));
  EXPECT_TRUE(
      scene.cylinders[0].T_world_cylinder.translation().isApprox(Eigen::Vector3d(3.0, 4.1, 0.225)));
}

/// The message of the std::invalid_argument that a scene file causes.
std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "test.yaml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no std::invalid_argument";
}

TEST(SceneFile, NamesLineAndProblemOfBadInput) {
  const std::string box = "boxes:\n  - {name: b, ";
  EXPECT_NE(error_of("boxes: [\n").find("test.yaml:"), std::string::npos);
  const std::vector<std::pair<std::string, std::string>> cases{
      {box + "center: [0, 0, 0]}\n", "test.yaml:2: \"size\" is missing"},
      {box + "center: [0, 0, 0], size: [1, 1, 0]}\n", "size[2] = 0: must be a number"},
      {box + "min: [0, 0, 0], max: [1, -1, 1]}\n", "\"max\" must be greater"},
      {box + "min: [0, 0, 0], max: [1, 1, 1], colour: red}\n", "unknown field"},
      {box + "min: [0, 0, 0], max: [1, 1, 1], material: gold}\n", "is not one of the materials"},
      {"walls: [{from: [0, 0], to: [0, 0], thickness: 1, height: 1}]\n", "two different points"},
      {"walls: [{from: [0, 0], to: [3, 0], thickness: 1, height: 1, openings: [{from: 2, to: 4}]}]",
       "from 2 to 3"},
      {"place: [{object: throne, at: [0, 0]}]\n", "\"throne\" is not one of the objects"},
      {"objects: {o: {place: [{object: o, at: [0, 0]}]}}\nplace: [{object: o, at: [0, 0]}]\n",
       "contains itself"},
      {"include: [../other.yaml]\n", "outside the folder of the scene"},
      {"include: [/etc/passwd]\n", "outside the folder of the scene"},
      {"meshes: [{name: m, file: a/../../m.obj, at: [0, 0]}]\n", "outside the folder of the scene"},
      {"include: [nowhere.yaml]\n", "neither a file nor shipped"},
      {"route: {waypoints: [[0, 0]]}\n", "at least two points"},
      {"route: {waypoints: [[0, 0], [1]]}\n", "must be a list [x, y] or [x, y, z]"},
      {"description: empty\n", "the scene is empty"}};
  for (const auto& [text, expected] : cases) {
    EXPECT_NE(error_of(text).find(expected), std::string::npos)
        << text << " gives: " << error_of(text);
  }
}

TEST(SceneFile, AnswersAnUnknownNameWithTheKnownOnes) {
  const std::string error = test::runtime_error_of([] { load_scene("wall7"); });
  EXPECT_NE(error.find("wall7"), std::string::npos);
  EXPECT_NE(error.find("stairwell"), std::string::npos);
  EXPECT_NE(
      test::runtime_error_of([] { load_scene("_furniture"); }).find("no scene"), std::string::npos);
}

class SceneFolder : public test::TemporaryFolder {};

TEST_F(SceneFolder, IncludesOwnAndShippedFiles) {
  write("parts/bench.yaml", "objects: {bench: {boxes: [{center: [0, 0, 0], size: [2, 1, 1]}]}}\n");
  const std::string file = write(
      "my.yaml",
      "include: [parts/bench.yaml, _furniture.yaml]\n"
      "place: [{object: bench, at: [0, 0]}, {object: cabinet, at: [3, 0]}]\n");
  const Scene scene = load_scene(file);
  EXPECT_EQ(scene.name, "my");
  EXPECT_EQ(scene.boxes.size(), 2U);
}

TEST_F(SceneFolder, AnIncludedSceneKeepsItsWallsUnderANewRoute) {
  const std::string file =
      write("my.yaml", "include: [wall5.yaml]\nroute: {waypoints: [[0, 2], [3, 2]]}\n");
  const Scene scene = load_scene(file);
  EXPECT_EQ(scene.wall_pieces.size(), load_scene("wall5").wall_pieces.size());
  EXPECT_EQ(scene.route.waypoints.size(), 2U);
}

TEST_F(SceneFolder, RefusesAFileThatIncludesItself) {
  const std::string file = write("my.yaml", "include: [my.yaml]\n");
  EXPECT_THROW(load_scene(file), std::invalid_argument);
}

TEST_F(SceneFolder, ReadsMeshes) {
  write("roof.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  write(
      "tile.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write(
      "fin.stl",
      "solid fin\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid fin\n");
  const std::string file = write(
      "my.yaml",
      "meshes:\n"
      "  - {name: roof, file: roof.obj, at: [1, 0, 5], scale: 2}\n"
      "  - {name: tile, file: tile.ply, at: [0, 0]}\n"
      "  - {name: fin, file: fin.stl, at: [0, 0], rotation_deg: [90, 0, 0]}\n");
  const Scene scene = load_scene(file);
  ASSERT_EQ(scene.meshes.size(), 3U);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2U);
  EXPECT_EQ(scene.meshes[1].triangles.size(), 1U);
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : scene.meshes[0].vertices) {
    bounds.extend(vertex);
  }
  EXPECT_TRUE(bounds.min().isApprox(Eigen::Vector3d(1.0, 0.0, 5.0)));
  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3d(3.0, 2.0, 5.0)));
}

TEST_F(SceneFolder, RefusesMeshesThatAreDamaged) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n";
  const std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar short vertex_indices\nend_header\n" +
      std::string(36, '\0') + "\3";
  const std::string corners = std::string("\0\0\1\0", 4);
  const auto error_of = [&](const std::string& name, const std::string& content) {
    write(name, content);
    const std::string file =
        write("my.yaml", "meshes: [{name: m, file: " + name + ", at: [0, 0]}]\n");
    return test::runtime_error_of([&] { load_scene(file); });
  };
  using ::testing::HasSubstr;
  for (const char* face : {"3 0 1 -1\n", "3 0 1 3\n", "3 0 1 1000000000\n"}) {
    EXPECT_THAT(error_of("face.ply", head + face), HasSubstr("none of its 3 vertices")) << face;
  }
  EXPECT_THAT(error_of("cut.ply", head + "3 0 1\n"), HasSubstr("is cut off"));
  EXPECT_THAT(error_of("cut.ply", head.substr(0, 90)), HasSubstr("header is cut off"));
  EXPECT_THAT(error_of("cut.ply", binary + corners + "\2"), HasSubstr("is cut off"));
  EXPECT_THAT(error_of("far.ply", binary + corners + std::string("\3\0", 2)), HasSubstr("none of"));
  EXPECT_THAT(error_of("below.ply", binary + corners + "\xff\xff"), HasSubstr("none of its 3"));
  EXPECT_THAT(error_of("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("nan.obj"));
}

TEST_F(SceneFolder, NamesAMeshThatCannotBeRead) {
  write("empty.obj", "# nothing\n");
  for (const std::string mesh : {"missing.obj", "empty.obj"}) {
    const std::string file =
        write("my.yaml", "meshes: [{name: m, file: " + mesh + ", at: [0, 0]}]\n");
    const std::string error = test::runtime_error_of([&] { load_scene(file); });
    EXPECT_NE(error.find(mesh), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace nvm::sim
