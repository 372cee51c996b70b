// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_files.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "io/temporary_folder.hpp"
#include "io/trajectory_io.hpp"
#include "support/rng.hpp"

namespace nvm::app {
namespace {

using lio::FrameResult;
using lio::FrameStatus;

std::vector<FrameResult> random_frames(std::size_t count, std::mt19937_64& rng) {
  std::uniform_int_distribution<int> status(0, static_cast<int>(FrameStatus::kSkipped));
  std::uniform_real_distribution<double> milliseconds(0.0, 10.0);
  std::vector<FrameResult> frames(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i].status = static_cast<FrameStatus>(status(rng));
    frames[i].time = 100.0 + static_cast<double>(i);
    frames[i].T_map_body.translation() << milliseconds(rng), 1.0, 2.0;
    frames[i].times = {milliseconds(rng), milliseconds(rng), milliseconds(rng), milliseconds(rng)};
    frames[i].message = "frame " + std::to_string(i);
  }
  return frames;
}

class RunFilesTest : public test::TemporaryFolder {
 protected:
  // The lines of the one file whose name begins with `name`.
  std::vector<std::string> lines_of(const std::string& name) const {
    std::vector<std::string> lines;
    for (const auto& entry : std::filesystem::directory_iterator(path(""))) {
      if (entry.path().filename().string().rfind(name, 0) == 0) {
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);) {
          lines.push_back(line);
        }
      }
    }
    return lines;
  }

  std::ptrdiff_t count_files() const {
    return std::distance(
        std::filesystem::directory_iterator(path("")), std::filesystem::directory_iterator());
  }
};

TEST_F(RunFilesTest, HoldEveryFrameAsSoonAsItIsAdded) {
  auto rng = test::rng();
  const std::vector<FrameResult> frames = random_frames(20, rng);
  RunFiles files(path(""));
  std::size_t poses = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    files.add(frames[i]);
    poses += has_pose(frames[i]) ? 1 : 0;
    EXPECT_EQ(lines_of("trajectory.tum").size(), poses);
    EXPECT_EQ(lines_of("trajectory_kitti.txt").size(), poses);
    const std::vector<std::string> timing = lines_of("timing.json");
    ASSERT_EQ(timing.size(), 2 + i + 1);
    EXPECT_EQ(nlohmann::json::parse(timing.back())["time"], frames[i].time);
  }
}

TEST_F(RunFilesTest, AreGoneWhenNotFinished) {
  RunFiles(path("")).add(FrameResult());
  EXPECT_EQ(count_files(), 0);
}

TEST_F(RunFilesTest, AreCompleteWhenFinished) {
  auto rng = test::rng();
  for (const std::size_t count : {1U, 17U}) {
    const std::vector<FrameResult> frames = random_frames(count, rng);
    RunSummary summary;
    RunFiles files(path(""));
    for (const FrameResult& frame : frames) {
      files.add(frame);
      summary.add(frame);
    }
    files.finish(summary, 3.5);
    EXPECT_EQ(count_files(), 3);
    Trajectory expected;
    for (const FrameResult& frame : frames) {
      if (has_pose(frame)) {
        expected.push_back({frame.time, frame.T_map_body});
      }
    }
    io::write_tum(path("expected"), expected);
    EXPECT_EQ(lines_of("trajectory.tum"), lines_of("expected"));
    std::filesystem::remove(path("expected"));
    std::ifstream file(path("timing.json"));
    const auto timing = nlohmann::json::parse(file);
    EXPECT_EQ(timing["scans"], count);
    EXPECT_EQ(timing["wall_seconds"], 3.5);
    ASSERT_EQ(timing["frames"].size(), count);
    EXPECT_EQ(timing["frames"].back()["total_ms"], frames.back().times.total());
  }
}

TEST(RunSummaryTest, AgreesWithAllFramesTogether) {
  auto rng = test::rng();
  const std::vector<FrameResult> frames = random_frames(200, rng);
  RunSummary summary;
  double sum = 0.0;
  double max = 0.0;
  for (const FrameResult& frame : frames) {
    summary.add(frame);
    sum += frame.times.total();
    max = std::max(max, frame.times.total());
  }
  EXPECT_EQ(summary.frames(), frames.size());
  EXPECT_EQ(
      static_cast<std::ptrdiff_t>(summary.poses()),
      std::count_if(frames.begin(), frames.end(), has_pose));
  const auto total = nlohmann::json::parse(summary.timing_json(1.0))["cpu"]["total_ms"];
  EXPECT_NEAR(total["sum"], sum, 1e-9);
  EXPECT_NEAR(total["mean"], sum / 200.0, 1e-12);
  EXPECT_EQ(total["max"], max);
}

TEST(RunSummaryTest, WarnsOfEachKindOfTroubleWithItsFirstFrame) {
  auto rng = test::rng();
  const std::vector<FrameResult> frames = random_frames(50, rng);
  RunSummary summary;
  EXPECT_TRUE(summary.warnings().empty());
  for (const FrameResult& frame : frames) {
    summary.add(frame);
  }
  const std::vector<std::string> warnings = summary.warnings();
  ASSERT_EQ(warnings.size(), 3U);
  for (const FrameStatus status : {FrameStatus::kWeak, FrameStatus::kLost, FrameStatus::kSkipped}) {
    const auto first = std::find_if(frames.begin(), frames.end(), [status](const auto& frame) {
      return frame.status == status;
    });
    EXPECT_THAT(
        warnings,
        ::testing::Contains(::testing::AllOf(
            ::testing::HasSubstr(lio::name(status)), ::testing::EndsWith(first->message))));
  }
}

}  // namespace
}  // namespace nvm::app
