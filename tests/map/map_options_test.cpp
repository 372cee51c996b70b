// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "nvm/map/voxel_map.hpp"

namespace nvm {
namespace {

using ::testing::HasSubstr;

TEST(MapOptions, NamesTheBadOne) {
  const auto message = [](auto change) {
    MapOptions options;
    change(options);
    try {
      VoxelMap map(options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(message([](MapOptions& o) { o.voxel_size = -0.3; }), HasSubstr("voxel_size = -0.3"));
  EXPECT_THAT(message([](MapOptions& o) { o.voxel_size = std::nan(""); }), HasSubstr("voxel_size"));
  EXPECT_THAT(message([](MapOptions& o) { o.capacity = 0; }), HasSubstr("capacity = 0"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.points_per_surface = 121; }), HasSubstr("from 1 to 120"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.min_point_distance = 0.7; }), HasSubstr("min_point_distance"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.max_merged_points = 256; }), HasSubstr("from 1 to 255"));
  EXPECT_THAT(message([](MapOptions& o) { o.max_surfaces = 9; }), HasSubstr("max_surfaces = 9"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.max_surface_angle = 4.0; }), HasSubstr("max_surface_angle"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.max_point_angle = -0.1; }),
      HasSubstr("max_point_angle = -0.1"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.eviction_radius = 0.1; }), HasSubstr("eviction_radius = 0.1"));
  EXPECT_THAT(message([](MapOptions& o) { o.max_bytes = 1000; }), HasSubstr("max_bytes = 1000"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.eviction_radius = std::nan(""); }),
      HasSubstr("eviction_radius"));
  EXPECT_THAT(
      message([](MapOptions& o) { o.eviction = static_cast<Eviction>(2); }),
      HasSubstr("eviction = 2"));
}

// An option that visit_options() forgets is in no map file and no configuration. The names below
// must be as many as MapOptions and MapColumns have members, or this does not compile.
TEST(MapOptions, AreAllVisitedInOrder) {
  MapOptions options;
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, columns] = options;
  auto& [n, o, p, q] = columns;
  const std::vector<void*> members{
      &a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l, &m, &n, &o, &p, &q};
  std::vector<void*> visited;
  visit_options(options, [&](const OptionInfo& info, auto& value, const auto&... /*choices*/) {
    visited.push_back(&value);
    EXPECT_LT(info.min, info.max) << info.name;
    EXPECT_STRNE(info.doc, "") << info.name;
  });
  EXPECT_EQ(visited, members);
}

}  // namespace
}  // namespace nvm
