// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/evaluation.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "eval/report/report.hpp"
#include "eval/run_folder.hpp"
#include "eval/synthetic_wall.hpp"
#include "io/file/file.hpp"
#include "support/rng.hpp"

namespace nvm::eval {
namespace {

using ::testing::HasSubstr;

/// A sequence with one wall of 5 cm, and runs of it.
class EvaluationOfRuns : public ::testing::Test {
 protected:
  void SetUp() override { test::write_truth(truth_, {wall_}); }

  void add_run(const std::string& name, const OrientedCloud& cloud) {
    test::write_run(folder_ / name, cloud, test::random_pose(random_, 3.0, 20.0));
  }

  RunEvaluation evaluate(const std::string& name, const EvaluationOptions& options = {}) {
    return evaluate_run((folder_ / name).string(), read_truth(truth_.string()), options);
  }

  /// The message of the error that evaluating `name` ends with.
  std::string error_of(const std::string& name) {
    try {
      evaluate(name);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

  nlohmann::json read_json(const std::string& file) {
    return nlohmann::json::parse(io::read_file((folder_ / file).string()));
  }

  std::mt19937_64 random_ = test::rng();
  std::filesystem::path folder_ = test::test_folder();
  std::filesystem::path truth_ = folder_ / "sequence";
  WallPiece wall_ = test::make_wall(0.05);
};

TEST_F(EvaluationOfRuns, FindsTheWallsOfAMapInItsOwnFrame) {
  add_run("nvm", test::sample_wall(random_, wall_));
  const RunEvaluation run = evaluate("nvm");
  EXPECT_EQ(run.name, "nvm");
  EXPECT_LT(run.trajectory->absolute.max, 1e-6);
  EXPECT_EQ(run.trajectory->association.pairs.size(), 100U);
  ASSERT_EQ(run.map.walls.size(), 1U);
  EXPECT_NEAR(run.map.walls[0].error().value(), 0.0, 1.5e-3);
  EXPECT_GT(run.map.walls[0].sides.purity().value(), 0.995);
  EXPECT_EQ(summarize(run.map.walls).measured, 1U);
  EXPECT_TRUE(run.map.has_normals);
}

TEST_F(EvaluationOfRuns, NeverScalesTheMap) {
  add_run("nvm", test::sample_wall(random_, wall_));
  Trajectory shrunk = io::read_tum((folder_ / "nvm" / "trajectory.tum").string());
  for (StampedPose& stamped : shrunk) {
    stamped.pose.translation() *= 0.99;
  }
  io::write_tum((folder_ / "nvm" / "trajectory.tum").string(), shrunk);
  EvaluationOptions options;
  options.alignment = AlignmentKind::kSim3;
  const RunEvaluation run = evaluate("nvm", options);
  EXPECT_NEAR(run.trajectory->alignment.scale, 1.0 / 0.99, 1e-6);
  EXPECT_LT(run.trajectory->absolute.max, 1e-6);
  EXPECT_NEAR(run.map.walls.at(0).error().value(), 0.0, 1.5e-3);
}

TEST_F(EvaluationOfRuns, ReadsTheTruthFromATrajectoryFileToo) {
  add_run("nvm", test::sample_wall(random_, wall_));
  const Truth truth = read_truth((truth_ / "groundtruth.tum").string());
  EXPECT_TRUE(truth.walls.empty());
  EvaluationOptions options;
  options.regions.resize(1);
  options.regions[0].size = Eigen::Vector3d(0.5, 3.0, 2.0);
  const RunEvaluation run = evaluate_run((folder_ / "nvm").string(), truth, options);
  EXPECT_LT(run.trajectory->absolute.max, 1e-6);
  EXPECT_NEAR(run.map.regions.at(0).thickness.value(), 0.05, 1.5e-3);
}

TEST_F(EvaluationOfRuns, ShiftsTheTrueTimes) {
  const Truth truth = read_truth((truth_ / "groundtruth.tum").string(), 2.5);
  EXPECT_NEAR(truth.trajectory.front().time, 1002.5, 1e-9);
}

TEST_F(EvaluationOfRuns, NeedsNoTruthForRegions) {
  test::write_run(folder_ / "real", test::sample_wall(random_, wall_), Pose(Pose::Identity()));
  std::filesystem::remove(folder_ / "real" / "trajectory.tum");
  EvaluationOptions options;
  options.regions.resize(1);
  options.regions[0].size = Eigen::Vector3d(0.5, 3.0, 2.0);
  const RunEvaluation run = evaluate_run((folder_ / "real").string(), std::nullopt, options);
  EXPECT_FALSE(run.trajectory.has_value());
  EXPECT_NEAR(run.map.regions.at(0).thickness.value(), 0.05, 1.5e-3);
  write_report({std::nullopt, {run}}, (folder_ / "report").string());
  const auto drawing = read_json("report/drawing.json");
  EXPECT_TRUE(drawing["truth"].is_null());
  EXPECT_TRUE(drawing["runs"][0]["path"].is_null());
  EXPECT_GT(drawing["runs"][0]["regions"][0].size(), 500U);
}

TEST_F(EvaluationOfRuns, ReadsTheTimesOfStages) {
  add_run("nvm", OrientedCloud());
  EXPECT_TRUE(evaluate("nvm").timing.empty());
  const auto timing = folder_ / "nvm" / "timing.json";
  test::write_text(
      timing, R"({"cpu": {"b_ms": {"mean": 2, "max": 5}, "a_ms": {"mean": 1, "max": 3}}})");
  const auto stages = evaluate("nvm").timing;
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages[0].stage, "b_ms");
  EXPECT_EQ(stages[0].mean_ms, 2.0);
  EXPECT_EQ(stages[1].max_ms, 3.0);
  test::write_text(timing, R"({"cpu": {"a_ms": 1}})");
  EXPECT_THAT(error_of("nvm"), HasSubstr("timing.json"));
}

TEST_F(EvaluationOfRuns, TakesAnEmptyMapForOneWithoutWalls) {
  add_run("empty", OrientedCloud());
  const RunEvaluation run = evaluate("empty");
  EXPECT_EQ(run.map.points, 0U);
  EXPECT_FALSE(run.map.crispness.has_value());
  EXPECT_EQ(summarize(run.map.walls).seen, 1U);
  EXPECT_EQ(summarize(run.map.walls).measured, 0U);
  EXPECT_FALSE(summarize(run.map.walls).absolute_error.has_value());
}

TEST_F(EvaluationOfRuns, CountsNoSecondsWhereTheTruthHasAGap) {
  add_run("nvm", test::sample_wall(random_, wall_));
  Trajectory truth = io::read_tum((truth_ / "groundtruth.tum").string());
  truth.erase(truth.begin() + 20, truth.begin() + 80);
  io::write_tum((folder_ / "holed.tum").string(), truth);
  const TrajectoryEvaluation trajectory =
      *evaluate_run((folder_ / "nvm").string(), read_truth((folder_ / "holed.tum").string()), {})
           .trajectory;
  EXPECT_EQ(trajectory.association.pairs.size(), 40U);
  EXPECT_NEAR(trajectory.seconds, 3.8, 1e-6);
  EXPECT_NEAR(trajectory.truth_seconds, 9.9, 1e-6);
}

TEST_F(EvaluationOfRuns, ScoresABareTrajectory) {
  add_run("nvm", test::sample_wall(random_, wall_));
  add_run("bare", OrientedCloud());
  std::filesystem::remove(folder_ / "bare" / "map.ply");
  for (const std::string name : {"bare", "bare/trajectory.tum"}) {
    const RunEvaluation run = evaluate(name);
    EXPECT_LT(run.trajectory->absolute.max, 1e-6);
    EXPECT_NEAR(run.trajectory->seconds, 9.9, 1e-9);
    EXPECT_FALSE(run.has_map);
    write_report({read_truth(truth_.string()), {evaluate("nvm"), run}}, (folder_ / "r").string());
    const auto json = read_json("r/evaluation.json");
    EXPECT_TRUE(json["runs"][1]["map"].is_null());
    EXPECT_FALSE(json["runs"][0]["map"].is_null());
  }
  EXPECT_EQ(evaluate("bare/trajectory.tum").name, "trajectory");
  EvaluationOptions options;
  options.regions.resize(1);
  EXPECT_THROW(evaluate("bare", options), std::runtime_error);
  EXPECT_THROW(evaluate_run((folder_ / "bare").string(), std::nullopt, {}), std::runtime_error);
}

TEST_F(EvaluationOfRuns, NeedsNoSceneToScoreTrajectories) {
  add_run("nvm", OrientedCloud());
  std::filesystem::remove(truth_ / "scene.json");
  EXPECT_LT(evaluate("nvm").trajectory->absolute.max, 1e-6);
}

TEST_F(EvaluationOfRuns, LeavesOutPointsThatAreNotNumbers) {
  OrientedCloud cloud = test::sample_wall(random_, wall_);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cloud.points.push_back({{nan, 0.0, 0.0}, Eigen::Vector3d::UnitX()});
  cloud.points.push_back({Eigen::Vector3d::Zero(), {nan, 0.0, 0.0}});
  add_run("nvm", cloud);
  const RunEvaluation run = evaluate("nvm");
  EXPECT_EQ(run.map.non_finite, 1U);
  EXPECT_NEAR(run.map.walls.at(0).error().value(), 0.0, 1.5e-3);
}

TEST_F(EvaluationOfRuns, SaysWhatIsWrongWithARun) {
  EXPECT_THAT(error_of("missing"), HasSubstr("trajectory.tum"));
  add_run("nvm", OrientedCloud());
  const auto trajectory = folder_ / "nvm" / "trajectory.tum";
  test::write_text(trajectory, "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  EXPECT_THAT(error_of("nvm"), HasSubstr("no pose lies within the time span"));
  test::write_text(trajectory, "1000.1 0 nan 0 0 0 0 1\n");
  EXPECT_THAT(error_of("nvm"), HasSubstr("trajectory.tum"));
  test::write_text(trajectory, "1000.1 0 0 0 0 0 0 1\n1000.2 1 0 0 0 0 0 1\n");
  EXPECT_THAT(error_of("nvm"), HasSubstr("do not determine an alignment"));
  std::filesystem::remove(trajectory);
  EXPECT_THAT(error_of("nvm"), HasSubstr("trajectory.tum"));
}

TEST_F(EvaluationOfRuns, SaysWhatIsWrongWithTheTruth) {
  const auto error_of_scene = [&](const std::string& text) -> std::string {
    test::write_text(truth_ / "scene.json", text);
    try {
      read_truth(truth_.string());
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("scene.json"));
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of_scene("{"), HasSubstr("not JSON"));
  EXPECT_THAT(error_of_scene("{}"), HasSubstr("walls"));
  EXPECT_THAT(error_of_scene("{\"walls\": [3]}"), HasSubstr("walls[0]"));
  nlohmann::json piece = test::to_json(wall_);
  piece["thickness"] = -0.1;
  EXPECT_THAT(error_of_scene(nlohmann::json{{"walls", {piece}}}.dump()), HasSubstr("positive"));
  piece = test::to_json(wall_);
  piece["faces"][0]["d"] = 7.0;
  EXPECT_THAT(error_of_scene(nlohmann::json{{"walls", {piece}}}.dump()), HasSubstr("plane"));
  piece = test::to_json(wall_);
  piece["faces"][1]["normal"] = {0.0, 0.0, 0.0};
  EXPECT_THAT(error_of_scene(nlohmann::json{{"walls", {piece}}}.dump()), HasSubstr("unit"));
  EXPECT_THROW(read_truth((folder_ / "missing").string()), std::runtime_error);
}

TEST_F(EvaluationOfRuns, AreReportedSideBySide) {
  add_run("nvm", test::sample_wall(random_, wall_));
  OrientedCloud bare = test::sample_wall(random_, test::make_wall(0.03));
  for (OrientedPoint& point : bare.points) {
    point.normal.setZero();
  }
  add_run("plain <map>", bare);
  add_run("empty", OrientedCloud());
  Evaluation evaluation;
  evaluation.truth = read_truth(truth_.string());
  evaluation.runs = {evaluate("nvm"), evaluate("plain <map>"), evaluate("empty")};
  write_report(evaluation, (folder_ / "report").string());

  const auto json = read_json("report/evaluation.json");
  ASSERT_EQ(json["runs"].size(), 3U);
  EXPECT_NEAR(json["runs"][0]["map"]["walls"][0]["error_mm"].get<double>(), 0.0, 1.5);
  EXPECT_LT(json["runs"][0]["trajectory"]["ate_m"]["rmse"].get<double>(), 1e-6);
  EXPECT_EQ(json["runs"][0]["trajectory"]["axis_rmse_m"].size(), 3U);
  EXPECT_EQ(json["runs"][1]["map"]["sides"], "by position");
  EXPECT_TRUE(json["runs"][1]["map"]["walls"][0]["side_purity"].is_null());
  EXPECT_TRUE(json["runs"][2]["map"]["walls"][0]["thickness_mm"].is_null());

  const auto drawing = read_json("report/drawing.json");
  EXPECT_EQ(drawing["truth"]["path"].size(), evaluation.truth->trajectory.size());
  EXPECT_EQ(drawing["truth"]["walls"].size(), 2U);
  ASSERT_EQ(drawing["runs"].size(), 3U);
  const auto& run = drawing["runs"][0];
  EXPECT_EQ(run["path"].size(), json["runs"][0]["trajectory"]["poses"]);
  EXPECT_EQ(run["errors"].size(), run["path"].size());
  ASSERT_GT(run["walls"][0].size(), 500U);
  for (const auto& point : run["walls"][0]) {
    const double face = point[2] == 0 ? 0.025 : -0.025;
    EXPECT_NEAR(point[1].get<double>(), face, 0.06);
  }
  EXPECT_TRUE(drawing["runs"][2]["walls"][0].empty());
}

}  // namespace
}  // namespace nvm::eval
