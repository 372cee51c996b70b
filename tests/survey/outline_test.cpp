// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "support/rng.hpp"
#include "survey/mask.hpp"
#include "survey/outline.hpp"

namespace nvm::survey {
namespace {

Mask random_mask(std::mt19937_64& random, double share) {
  PlaneBox box;
  box.extend(0.0, 0.0);
  box.extend(2.0, 1.5);
  Mask mask(box, 0.1, 3);
  for (int row = 0; row < mask.rows(); ++row) {
    for (int column = 0; column < mask.columns(); ++column) {
      mask.set(column, row, std::uniform_real_distribution<double>()(random) < share);
    }
  }
  return mask;
}

TEST(Mask, DilationAndErosionAreThoseOfBruteForce) {
  auto random = test::rng();
  for (const int radius : {0, 1, 2, 5}) {
    const Mask mask = random_mask(random, radius == 0 ? 0.5 : 0.9 - 0.1 * radius);
    const Mask grown = dilated(mask, radius);
    const Mask shrunk = eroded(mask, radius);
    for (int row = 0; row < mask.rows(); ++row) {
      for (int column = 0; column < mask.columns(); ++column) {
        bool any = false;
        bool all = true;
        for (int dr = -radius; dr <= radius; ++dr) {
          for (int dc = -radius; dc <= radius; ++dc) {
            any = any || mask.get(column + dc, row + dr);
            all = all && mask.get(column + dc, row + dr);
          }
        }
        EXPECT_EQ(grown.get(column, row), any);
        EXPECT_EQ(shrunk.get(column, row), all);
      }
    }
  }
}

TEST(Mask, ComponentsArePiecesOfTheWhole) {
  auto random = test::rng();
  const Mask mask = random_mask(random, 0.5);
  std::size_t count = 0;
  for (const Mask& part : components(mask, 0.0)) {
    count += part.count();
    EXPECT_EQ(difference(part, mask).count(), 0U);
    EXPECT_EQ(components(part, 0.0).size(), 1U);
  }
  EXPECT_EQ(count, mask.count());
}

TEST(Outline, LoopsBoundTheAreaOfTheMask) {
  auto random = test::rng();
  for (const double share : {0.1, 0.5, 0.9}) {
    const Mask mask = random_mask(random, share);
    double area = 0.0;
    for (const Loop& loop : trace(mask)) {
      area += signed_area(loop);
    }
    EXPECT_NEAR(area, mask.area(), 1e-9);
  }
}

TEST(Outline, SimplificationKeepsToItsTolerance) {
  Loop circle;
  for (int i = 0; i < 400; ++i) {
    circle.push_back({std::cos(i * M_PI / 200), std::sin(i * M_PI / 200)});
  }
  const Loop coarse = simplified(circle, 0.05);
  EXPECT_LT(coarse.size(), 20U);
  EXPECT_GT(signed_area(coarse), 0.9 * M_PI);
  EXPECT_EQ(simplified({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}}, 0.1).size(), 4U);
}

}  // namespace
}  // namespace nvm::survey
