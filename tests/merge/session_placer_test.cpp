// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/session_placer.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace nvm::merge {
namespace {

// Of 29 keyframes the first voted 29 times.
TEST(VotingOrder, EachKeyframeVotesOnce) {
  for (std::size_t keyframes = 0; keyframes <= 400; ++keyframes) {
    const std::vector<std::size_t> order = voting_order(keyframes);
    EXPECT_EQ(order.size(), std::min<std::size_t>(48, keyframes)) << keyframes;
    const std::set<std::size_t> distinct(order.begin(), order.end());
    EXPECT_EQ(distinct.size(), order.size()) << keyframes;
    EXPECT_TRUE(distinct.empty() || *distinct.rbegin() < keyframes) << keyframes;
  }
}

TEST(VotingOrder, TheFirstTwelveAreSpreadOverTheSession) {
  for (std::size_t keyframes = 12; keyframes <= 400; ++keyframes) {
    std::vector<std::size_t> first = voting_order(keyframes);
    first.resize(12);
    std::sort(first.begin(), first.end());
    first.push_back(keyframes);
    std::size_t begin = 0;
    for (const std::size_t keyframe : first) {
      EXPECT_LE(keyframe - begin, keyframes / 8 + 1) << keyframes;
      begin = keyframe;
    }
  }
}

}  // namespace
}  // namespace nvm::merge
