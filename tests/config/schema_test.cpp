// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/nearest_name.hpp"
#include "support/rng.hpp"

namespace nvm::config {
namespace {

using ::testing::HasSubstr;

enum class Rule { kPaper, kSmallest };

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Ones();
};

struct Options {
  double voxel_size = 0.3;
  std::size_t capacity = 1'000'000;
  double max_angle = 1.5707963267948966;
  Rule rule = Rule::kPaper;
  int threads = 1;
  bool enabled = true;
  std::string topic = "/points: raw";
  std::uint64_t seed = 7;
  float scale = 0.25F;
  std::vector<double> weights = {1.0, 0.5};
  std::vector<Eigen::Vector3d> waypoints;
  std::vector<Box> boxes;
};

void bind_box(Schema& schema, Box& box) {
  schema.add("min", box.min, "Lower corner [m]").required();
  schema.add("max", box.max, {-1e3, 1e3}, "Upper corner [m]");
}

void bind(Schema& schema, Options& options) {
  Schema& map = schema.section("map", "The map");
  map.add("voxel_size", options.voxel_size, {0.01, 100.0}, "Edge of a voxel [m]");
  map.add("capacity", options.capacity, {1, 67108864}, "Most voxels");
  map.add_angle("max_angle_deg", options.max_angle, {0.0, 180.0}, "Largest angle");
  map.add_choice(
      "rule", options.rule, {{"paper", Rule::kPaper}, {"smallest", Rule::kSmallest}}, "Rule");
  schema.add("threads", options.threads, {1, 64}, "Number of threads");
  schema.add("enabled", options.enabled, "Whether to work at all");
  schema.add("topic", options.topic, "Where the points come from");
  schema.add("seed", options.seed, "Seed of the random numbers");
  schema.add("scale", options.scale, "Factor");
  schema.add("weights", options.weights, {0.0, 1.0}, "Weights");
  schema.add("waypoints", options.waypoints, "Route [m]");
  schema.add_list("boxes", options.boxes, bind_box, "Solid boxes");
}

Options read(const std::string& yaml) {
  Options options;
  Schema schema;
  bind(schema, options);
  schema.read_text(yaml, "file.yaml");
  return options;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no std::invalid_argument";
}

std::string error_of(const std::string& yaml) {
  return message_of([&] { read(yaml); });
}

std::string override_error_of(const std::string& assignment) {
  Options options;
  Schema schema;
  bind(schema, options);
  return message_of([&] { schema.set(assignment); });
}

TEST(Schema, ReadsEveryKindOfValue) {
  const Options options = read(R"(
map: {voxel_size: 1e-1, capacity: 1e6, max_angle_deg: 180, rule: smallest}
threads: +8
enabled: no
topic: /livox/lidar
seed: 9007199254740992
scale: .5
weights: [0, 1, 0.25]
waypoints: [[1, 2, 3], [4, 5, -6.5]]
boxes:
  - {min: [0, 0, 0], max: [1, 2, 3]}
  - min: [1, 1, 1]
)");
  EXPECT_EQ(options.voxel_size, 0.1);
  EXPECT_EQ(options.capacity, 1'000'000U);
  EXPECT_NEAR(options.max_angle, 3.14159265358979, 1e-14);
  EXPECT_EQ(options.rule, Rule::kSmallest);
  EXPECT_EQ(options.threads, 8);
  EXPECT_FALSE(options.enabled);
  EXPECT_EQ(options.topic, "/livox/lidar");
  EXPECT_EQ(options.seed, 9007199254740992U);
  EXPECT_EQ(options.scale, 0.5F);
  EXPECT_EQ(options.weights, (std::vector<double>{0.0, 1.0, 0.25}));
  ASSERT_EQ(options.waypoints.size(), 2U);
  EXPECT_EQ(options.waypoints[1], Eigen::Vector3d(4, 5, -6.5));
  ASSERT_EQ(options.boxes.size(), 2U);
  EXPECT_EQ(options.boxes[0].max, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(options.boxes[1].max, Eigen::Vector3d::Ones());
}

TEST(Schema, KeepsDefaultsOfKeysThatAreNotGiven) {
  for (const char* yaml : {"", "# nothing\n", "map:\n", "{}"}) {
    EXPECT_EQ(read(yaml).voxel_size, 0.3) << yaml;
  }
}

TEST(Schema, UnknownKeyIsNamedWithItsNearest) {
  EXPECT_EQ(
      error_of("threads: 1\nmap:\n  voxle_size: 1\n"),
      "file.yaml:3: unknown key map.voxle_size; did you mean map.voxel_size?");
  EXPECT_EQ(
      error_of("voxel_size: 1"),
      "file.yaml:1: unknown key voxel_size; did you mean map.voxel_size?");
  EXPECT_EQ(error_of("something_else: 1"), "file.yaml:1: unknown key something_else");
  EXPECT_EQ(
      error_of("boxes: [{min: [0, 0, 0], mix: [1, 1, 1]}]"),
      "file.yaml:1: unknown key boxes[0].mix; did you mean boxes[0].min?");
}

TEST(Schema, OutOfRangeNamesKeyValueAndRange) {
  EXPECT_EQ(
      error_of("\nmap:\n  voxel_size: -1"),
      "file.yaml:3: map.voxel_size = -1: must be a number from 0.01 to 100");
  EXPECT_EQ(
      error_of("threads: 0"), "file.yaml:1: threads = 0: must be a whole number from 1 to 64");
  EXPECT_THAT(error_of("map: {max_angle_deg: 181}"), HasSubstr("from 0 to 180"));
  EXPECT_THAT(error_of("scale: 1e300"), HasSubstr("scale = 1e300: must be a number"));
  EXPECT_THAT(error_of("seed: -1"), HasSubstr("a whole number from 0 to "));
  EXPECT_THAT(error_of("weights: [0, 2]"), HasSubstr("weights[1] = 2: must be a number"));
}

TEST(Schema, WrongTypeNamesKeyValueAndType) {
  for (const char* number : {"big", "[1]", "{a: 1}", "~", "1m", ".nan", ".inf", "nan", "''"}) {
    const std::string error = error_of("map: {voxel_size: " + std::string(number) + "}");
    EXPECT_THAT(error, HasSubstr("file.yaml:1: map.voxel_size = ")) << number;
    EXPECT_THAT(error, HasSubstr("must be a number from 0.01 to 100")) << number;
  }
  EXPECT_THAT(error_of("threads: 1.5"), HasSubstr("threads = 1.5: must be a whole number"));
  EXPECT_THAT(error_of("threads: \"1\\n2\""), HasSubstr("threads = 1 2: must be"));
  EXPECT_THAT(error_of("enabled: 3"), HasSubstr("must be true or false"));
  EXPECT_THAT(error_of("topic: [a]"), HasSubstr("must be text"));
  EXPECT_THAT(error_of("map: {rule: best}"), HasSubstr("must be one of paper, smallest"));
  EXPECT_THAT(error_of("waypoints: [[1, 2]]"), HasSubstr("waypoints[0] = [1, 2]: must be a list"));
  EXPECT_THAT(error_of("boxes: 3"), HasSubstr("must be a list of mappings"));
  EXPECT_THAT(error_of("boxes: [3]"), HasSubstr("must be a mapping"));
  EXPECT_THAT(error_of("map: 3"), HasSubstr("map = 3: must be a mapping"));
  EXPECT_THAT(error_of("[1, 2]"), HasSubstr("must be a mapping"));
}

TEST(Schema, KeyGivenTwiceIsAnError) {
  EXPECT_EQ(error_of("threads: 1\nthreads: 2"), "file.yaml:2: threads = 2: the key is there twice");
}

TEST(Schema, MissingRequiredKeyIsAnError) {
  EXPECT_EQ(
      error_of("boxes:\n  - max: [1, 1, 1]"),
      "file.yaml:2: key boxes[0].min is missing: Lower corner [m]");
}

TEST(Schema, BadYamlAndMissingFileAreRuntimeErrors) {
  Schema schema;
  try {
    schema.read_text("a: 1\nb: [1, 2", "file.yaml");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("file.yaml:2: not valid YAML"));
  }
  EXPECT_THROW(schema.read_file("no/such/file.yaml"), std::runtime_error);
  EXPECT_THROW(schema.read_file("."), std::runtime_error);
}

TEST(Schema, OverridesReplaceValues) {
  Options options;
  Schema schema;
  bind(schema, options);
  schema.read_text("map: {voxel_size: 0.1}", "file.yaml");
  schema.set("map.voxel_size=0.2");
  schema.set("weights=[1, 0]");
  schema.set("boxes=[{min: [1, 2, 3]}]");
  EXPECT_EQ(options.voxel_size, 0.2);
  EXPECT_EQ(options.weights, (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(options.boxes.at(0).min, Eigen::Vector3d(1, 2, 3));
}

TEST(Schema, BadOverridesAreNamed) {
  EXPECT_EQ(
      override_error_of("map.voxel_size=9e9"),
      "map.voxel_size = 9e9: must be a number from 0.01 to 100");
  EXPECT_EQ(
      override_error_of("map.voxelsize=1"),
      "unknown key map.voxelsize; did you mean map.voxel_size?");
  EXPECT_THAT(override_error_of("map=1"), HasSubstr("must be a mapping"));
  EXPECT_THAT(override_error_of("map..voxel_size=1"), HasSubstr("unknown key map."));
  for (const char* text : {"threads", "=1", ""}) {
    EXPECT_THAT(override_error_of(text), HasSubstr("key=value")) << text;
  }
}

TEST(Schema, PrintedConfigurationReadsBackTheSame) {
  Options options;
  options.voxel_size = 0.1 + 0.2;
  options.rule = Rule::kSmallest;
  options.waypoints = {{1, 2, 3}, {0.1, 1e-9, 1e12}};
  options.boxes = {Box{}, {{-1, -2, -3}, {4, 5, 6}}};
  Schema schema;
  bind(schema, options);
  const std::string yaml = schema.to_yaml();
  EXPECT_THAT(yaml, HasSubstr("  # Edge of a voxel [m]. Allowed: a number from 0.01 to 100.\n"));
  EXPECT_THAT(yaml, HasSubstr("  max_angle_deg: 90\n"));

  Options copy;
  Schema copy_schema;
  bind(copy_schema, copy);
  copy_schema.read_text(yaml, "printed");
  EXPECT_EQ(copy_schema.to_yaml(), yaml);
  EXPECT_EQ(copy.voxel_size, options.voxel_size);
  EXPECT_EQ(copy.boxes.at(1).max, options.boxes.at(1).max);
  EXPECT_EQ(copy.topic, options.topic);
}

TEST(Schema, NeverDoesMoreThanThrowOnDamagedText) {
  Options options;
  Schema schema;
  bind(schema, options);
  const std::string yaml = schema.to_yaml();
  auto rng = test::rng();
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = yaml;
    for (int flip = 0; flip < 3; ++flip) {
      damaged[rng() % damaged.size()] = static_cast<char>(rng());
    }
    try {
      read(damaged.substr(0, rng() % damaged.size()));
    } catch (const std::exception& error) {
      EXPECT_THAT(error.what(), HasSubstr("file.yaml:"));
    }
  }
}

TEST(NearestName, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> names = {"voxel_size", "capacity", "rule"};
  EXPECT_EQ(nearest_name("voxel_siz", names), "voxel_size");
  EXPECT_EQ(nearest_name("rules", names), "rule");
  EXPECT_EQ(nearest_name("weather_report", names), std::nullopt);
  EXPECT_EQ(nearest_name("x", {}), std::nullopt);
}

}  // namespace
}  // namespace nvm::config
