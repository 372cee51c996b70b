// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/normal/normal_options.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "nvm/normal/normal_estimator.hpp"

namespace nvm {
namespace {

using ::testing::HasSubstr;

struct BadOption {
  std::function<void(NormalOptions&)> spoil;
  std::string message;
};

class BadNormalOptions : public ::testing::TestWithParam<BadOption> {};

TEST_P(BadNormalOptions, AreRefusedWithNameValueAndRange) {
  NormalOptions options;
  GetParam().spoil(options);
  try {
    const NormalEstimator estimator(options);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    BadNormalOptions,
    ::testing::Values(
        BadOption{[](auto& o) { o.min_range = -1.0; }, "min_range = -1 must be 0 to max_range"},
        BadOption{[](auto& o) { o.min_range = o.max_range; }, "min_range = "},
        BadOption{[](auto& o) { o.max_range = 2e4; }, "max_range = 20000 must be above 0 to 10000"},
        BadOption{
            [](auto& o) { o.max_range = std::numeric_limits<double>::quiet_NaN(); },
            "max_range = nan must be"},
        BadOption{
            [](auto& o) { o.min_radius = 0.0; }, "min_radius = 0 must be 0.001 to max_radius"},
        BadOption{[](auto& o) { o.min_radius = 2.0 * o.max_radius; }, "min_radius = "},
        BadOption{[](auto& o) { o.max_radius = 1e6; }, "max_radius = 1e+06 must be 0.001 to 1000"},
        BadOption{[](auto& o) { o.min_neighbors = 2; }, "min_neighbors = 2 must be 3 to 1000000"},
        BadOption{
            [](auto& o) { o.max_linearity = 0.3; }, "max_linearity = 0.3 must be above 1/3 to 1"},
        BadOption{
            [](auto& o) { o.max_surface_variation = 0.5; },
            "max_surface_variation = 0.5 must be above 0 to 1/3"},
        BadOption{[](auto& o) { o.widening = 0.5; }, "widening = 0.5 must be 1 to 10"}));

TEST(NormalOptions, DefaultsAreValid) { EXPECT_NO_THROW(NormalOptions().validate()); }

TEST(RadiusLaw, IsEquationOneFromMinRadiusToMaxRadius) {
  NormalOptions options;
  options.min_range = 5.0;
  options.max_range = 30.0;
  options.min_radius = 0.2;
  options.max_radius = 4.0;
  const RadiusLaw radius(options);
  EXPECT_DOUBLE_EQ(radius(0.0), 0.2);  // clamped: nearer than D_min
  EXPECT_DOUBLE_EQ(radius(5.0 * 5.0), 0.2);
  EXPECT_DOUBLE_EQ(radius(17.5 * 17.5), 2.1);
  EXPECT_DOUBLE_EQ(radius(30.0 * 30.0), 4.0);
  EXPECT_DOUBLE_EQ(radius(1e6), 4.0);
}

TEST(RadiusLaw, IsConstantWhenTheRadiiAreEqual) {
  NormalOptions options;
  options.min_radius = options.max_radius = 0.3;
  const RadiusLaw radius(options);
  for (const double range : {0.0, 1.0, 50.0}) {
    EXPECT_EQ(radius(range * range), 0.3);
  }
}

}  // namespace
}  // namespace nvm
