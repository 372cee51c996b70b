// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/core/executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "nvm/core/executor_openmp.hpp"
#include "nvm/core/executor_tbb.hpp"
#include "support/rng.hpp"
#include "support/sanitizers.hpp"

namespace nvm::test {
namespace {

using Block = std::pair<std::size_t, std::size_t>;

template <class Executor>
std::vector<Block> blocks_of(const Executor& executor, std::size_t size, std::size_t grain) {
  std::mutex mutex;
  std::vector<Block> blocks;
  executor.for_blocks(size, grain, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    blocks.emplace_back(begin, end);
  });
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

template <class Executor>
class ExecutorLaws : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::is_same_v<Executor, OpenMpExecutor>) {
      NVM_SKIP_UNDER_THREAD_SANITIZER("libgomp");
    }
  }
};
using Executors = ::testing::Types<SerialExecutor, TbbExecutor, OpenMpExecutor>;
TYPED_TEST_SUITE(ExecutorLaws, Executors);

TYPED_TEST(ExecutorLaws, CutsTheRangeIntoFullBlocksAndARest) {
  const std::vector<Block> expected{{0, 4}, {4, 8}, {8, 10}};
  EXPECT_EQ(blocks_of(TypeParam{}, 10, 4), expected);
}

TYPED_TEST(ExecutorLaws, CutsTheRangeAsTheSerialExecutorDoes) {
  for (const std::size_t size : {1, 2, 7, 64, 1000}) {
    for (const std::size_t grain : {1, 2, 7, 64, 5000}) {
      SCOPED_TRACE(::testing::Message() << "size " << size << ", grain " << grain);
      EXPECT_EQ(blocks_of(TypeParam{}, size, grain), blocks_of(SerialExecutor{}, size, grain));
    }
  }
}

TYPED_TEST(ExecutorLaws, CountsAGrainOfZeroAsOne) {
  EXPECT_EQ(blocks_of(TypeParam{}, 3, 0), (std::vector<Block>{{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_TRUE(blocks_of(TypeParam{}, 0, 0).empty());
}

TYPED_TEST(ExecutorLaws, TakesTheLargestGrainAsOneBlock) {
  const std::size_t largest = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(blocks_of(TypeParam{}, 3, largest), (std::vector<Block>{{0, 3}}));
}

TYPED_TEST(ExecutorLaws, DoesNothingWithAnEmptyRange) {
  EXPECT_TRUE(blocks_of(TypeParam{}, 0, 16).empty());
}

TYPED_TEST(ExecutorLaws, HasFinishedEveryBlockOnReturn) {
  constexpr std::size_t kSize = 100'000;
  std::vector<int> visits(kSize, 0);
  TypeParam{}.for_blocks(kSize, 128, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ++visits[i];
    }
  });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(kSize));
}

TYPED_TEST(ExecutorLaws, GivesABlockWiseSumOfFloatsToTheLastBit) {
  auto random = rng();
  std::uniform_real_distribution<float> uniform(-1e6F, 1e6F);
  std::vector<float> values(10'007);
  std::generate(values.begin(), values.end(), [&] { return uniform(random); });

  constexpr std::size_t kGrain = 100;
  const auto sum = [&](const auto& executor) {
    std::vector<float> partial((values.size() + kGrain - 1) / kGrain);
    executor.for_blocks(values.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = values.begin() + static_cast<std::ptrdiff_t>(end);
      partial[begin / kGrain] = std::accumulate(first, last, 0.0F);
    });
    return std::accumulate(partial.begin(), partial.end(), 0.0F);
  };
  EXPECT_EQ(sum(TypeParam{}), sum(SerialExecutor{}));
}

}  // namespace
}  // namespace nvm::test
