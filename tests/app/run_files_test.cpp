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

#include "app/failure.hpp"
#include "app/run_verdict.hpp"
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

// Frames a tenth of a second apart, of the statuses that letters stand for: t, w, l, i; T: tracking
// with two directions open.
RunSummary summary_of(const std::string& letters) {
  RunSummary summary;
  for (const char letter : letters) {
    FrameResult frame;
    frame.time = 1.7e9 + 0.1 * static_cast<double>(summary.frames());
    frame.status = letter == 'w'   ? FrameStatus::kWeak
                   : letter == 'l' ? FrameStatus::kLost
                   : letter == 'i' ? FrameStatus::kInitializing
                   : letter == 'd' ? FrameStatus::kDegenerate
                                   : FrameStatus::kTracking;
    frame.degenerate_directions = letter == 'T' || letter == 'd' ? 2 : 0;
    frame.message = letter == 't' ? "" : "why";
    summary.add(frame, frame.points);
  }
  return summary;
}

TEST(RunSummaryTest, NamesTheSecondsOfTheRun) {
  EXPECT_THAT(
      summary_of("ittwwwtttdddTlt").warnings(),
      ::testing::ElementsAre(
          "3 of 15 scans weak (their poses are predictions): 0.3 to 0.5 s; why",
          "1 of 15 scans lost (they have no pose): at 1.3 s; why",
          ::testing::AllOf(
              ::testing::HasSubstr("3 of 15 scans degenerate: for too long"),
              ::testing::EndsWith(": 0.9 to 1.1 s"))));
}

TEST(RunSummaryTest, NamesTheDirectionsThatScansDoNotTell) {
  RunSummary summary;
  FrameResult frame;
  frame.status = FrameStatus::kDegenerate;
  frame.degenerate_directions = 2;
  for (const double sign : {1.0, -1.0, 1.0}) {
    frame.unobserved.translations = {sign * Eigen::Vector3d(0.6, -0.8, 0.0)};
    frame.unobserved.rotations = {sign * Eigen::Vector3d::UnitZ()};
    summary.add(frame, frame.points);
    frame.time += 0.1;
  }
  EXPECT_THAT(
      summary.warnings(),
      ::testing::ElementsAre(::testing::HasSubstr(
          "drifts, mostly along (-0.60, 0.80, 0.00), turning about (0.00, 0.00, 1.00)): 0.0 to")));
}

TEST(RunSummaryTest, TellsTheLongestTimesOfMany) {
  const std::vector<std::string> warnings = summary_of("wtwwwtwtwwwwwtwtwwtwwwwtt").warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(
      warnings[0],
      ::testing::HasSubstr("0.2 to 0.4 s, 0.8 to 1.2 s, 1.6 to 1.7 s, 1.9 to 2.2 s and 3 shorter"));
}

TEST(RunSummaryTest, NamesTheLongestPauseBetweenScans) {
  const auto with_pause = [](double pause) {
    RunSummary summary;
    FrameResult frame;
    frame.status = FrameStatus::kTracking;
    for (int i = 0; i < 40; ++i) {
      frame.time = 1.7e9 + 0.1 * i + (i < 12 ? 0.0 : pause);
      summary.add(frame, 0);
    }
    return summary.warnings();
  };
  EXPECT_TRUE(with_pause(0.3).empty());  // a few dropped scans
  EXPECT_THAT(
      with_pause(1.4),
      ::testing::ElementsAre(::testing::HasSubstr("no scan came for 1.5 s after 1.1 s")));
}

TEST(RunSummaryTest, NamesReturnsThatAreAlmostAllOutOfRange) {
  const auto with_points = [](std::size_t points, FrameStatus status) {
    RunSummary summary(2000);
    FrameResult frame;
    frame.status = status;
    frame.points = points;
    summary.add(frame, 5000);  // which would be thinned to 2000
    return summary.warnings();
  };
  EXPECT_TRUE(with_points(600, FrameStatus::kTracking).empty());
  EXPECT_THAT(
      with_points(100, FrameStatus::kTracking),
      ::testing::ElementsAre(::testing::StartsWith("95 % of the returns lie nearer than")));
  EXPECT_THAT(
      with_points(0, FrameStatus::kInitializing),  // which counts no points
      ::testing::ElementsAre(::testing::HasSubstr("initializing")));
}

// Whatever the first scans wait for, what most of them lack is the reason that none got a pose.
TEST(RunSummaryTest, NamesTheUsualTroubleOfARunWithoutAPose) {
  RunSummary summary;
  FrameResult frame;
  for (int i = 0; i < 30; ++i) {
    frame.time = 0.1 * i;
    frame.message = i < 10 ? "waits" : lio::kTooFewSurfaces;
    summary.add(frame, 5000);
  }
  EXPECT_THAT(
      summary.main_trouble(),
      ::testing::AllOf(
          ::testing::HasSubstr(lio::kTooFewSurfaces),
          ::testing::HasSubstr("100 % of the returns"),
          ::testing::Not(::testing::HasSubstr("waits"))));
}

TEST(RunVerdictTest, AMapOfNextToNoPointsIsNotUsable) {
  const RunSummary summary = summary_of("ttttt");
  EXPECT_NO_THROW(check_usable(summary, 5, "out"));
  try {
    check_usable(summary, 4, "out");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), kExitUnusable);
    EXPECT_THAT(failure.what(), ::testing::HasSubstr("4 points after 5 poses"));
  }
}

TEST(RunSummaryTest, TheMainTroubleIsThatOfMostFrames) {
  EXPECT_THAT(summary_of("iitwwwl").main_trouble(), ::testing::StartsWith("3 of 7 scans weak"));
  EXPECT_EQ(summary_of("ttt").main_trouble(), "");
}

TEST(RunSummaryTest, UsableFramesDoNotSlideForLong) {
  EXPECT_EQ(summary_of("iitttTddwl").usable(), 4U);
  EXPECT_EQ(summary_of("iitttTddwl").counts(), "2 initializing, 1 weak, 1 lost, 2 degenerate");
}

TEST(RunSummaryTest, WarnsOfPointsThatAreNotInTheMap) {
  RunSummary summary;
  FrameResult frame;
  frame.status = FrameStatus::kTracking;
  frame.points = 100;
  frame.inserted.out_of_range = 70;
  frame.inserted.no_normal = 30;
  summary.add(frame, frame.points);
  summary.add(frame, frame.points);
  EXPECT_THAT(summary.warnings(), ::testing::ElementsAre(::testing::StartsWith("140 points")));
  EXPECT_THAT(summary.inserted().why_empty(), ::testing::StartsWith("140 of 200 returns lie more"));
  frame.inserted.no_normal = 1000;
  summary.add(frame, frame.points);
  EXPECT_THAT(summary.inserted().why_empty(), ::testing::HasSubstr("no surface"));
  EXPECT_THAT(InsertTotals().why_empty(), ::testing::HasSubstr("lidar.min_range"));
}

}  // namespace
}  // namespace nvm::app
