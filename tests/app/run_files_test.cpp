// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_files.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "io/sequence/trajectory_io.hpp"
#include "io/temporary_folder.hpp"
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
};

TEST_F(RunFilesTest, HoldEveryFrameAsSoonAsItIsAdded) {
  auto rng = test::rng();
  const std::vector<FrameResult> frames = random_frames(20, rng);
  RunFiles files(path(""));
  Trajectory expected;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    files.add(frames[i]);
    if (has_pose(frames[i])) {
      expected.push_back({frames[i].time, frames[i].T_map_body});
    }
    EXPECT_EQ(lines_of("trajectory.tum").size(), expected.size());
    EXPECT_EQ(lines_of("trajectory_kitti.txt").size(), expected.size());
    const std::vector<std::string> rows = lines_of("frames.csv");
    ASSERT_EQ(rows.size(), 1 + i + 1);
    EXPECT_EQ(std::stod(rows.back()), frames[i].time);
    EXPECT_THAT(rows.back(), ::testing::HasSubstr(frames[i].message));
  }
  io::write_tum(path("expected"), expected);
  EXPECT_EQ(lines_of("trajectory.tum"), lines_of("expected"));
}

TEST_F(RunFilesTest, FramesHaveACellForEachColumn) {
  FrameResult frame;
  frame.status = FrameStatus::kWeak;
  frame.message = "a \"quoted\" reason, with a comma";
  frame.times.map_update = 1.25;
  frame.inlier_share = 0.4375;
  frame.unobserved.translations = {Eigen::Vector3d::UnitX()};
  RunFiles(path("")).add(frame);
  const std::vector<std::string> lines = lines_of("frames.csv");
  ASSERT_EQ(lines.size(), 2U);
  const std::string cell = "\"a \"\"quoted\"\" reason, with a comma\"";
  EXPECT_THAT(lines[1], ::testing::HasSubstr(",weak," + cell + ","));
  std::string unquoted = lines[1];
  unquoted.replace(unquoted.find(cell), cell.size(), "");
  const std::string directions = "\"along (1.00, 0.00, 0.00)\"";
  ASSERT_THAT(unquoted, ::testing::HasSubstr("," + directions + ","));
  unquoted.replace(unquoted.find(directions), directions.size(), "");
  EXPECT_EQ(
      std::count(unquoted.begin(), unquoted.end(), ','),
      std::count(lines[0].begin(), lines[0].end(), ','));
  EXPECT_THAT(lines[1], ::testing::HasSubstr(",1.250,"));
  EXPECT_THAT(lines[1], ::testing::HasSubstr(",0.4375,"));
}

TEST_F(RunFilesTest, TimingSumsFramesUp) {
  auto rng = test::rng();
  RunSummary summary;
  for (const FrameResult& frame : random_frames(17, rng)) {
    summary.add(frame, frame.points);
  }
  write_timing(path(""), summary, 3.5);
  std::ifstream file(path("timing.json"));
  const auto timing = nlohmann::json::parse(file);
  EXPECT_EQ(timing["scans"], 17);
  EXPECT_EQ(timing["wall_seconds"], 3.5);
}

TEST(RunSummaryTest, AgreesWithAllFramesTogether) {
  auto rng = test::rng();
  const std::vector<FrameResult> frames = random_frames(200, rng);
  RunSummary summary;
  double sum = 0.0;
  double max = 0.0;
  for (const FrameResult& frame : frames) {
    summary.add(frame, frame.points);
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
    summary.add(frame, frame.points);
  }
  const std::vector<std::string> warnings = summary.warnings();
  ASSERT_EQ(warnings.size(), 4U);
  EXPECT_THAT(warnings, ::testing::Contains(::testing::HasSubstr("degenerate")));
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
