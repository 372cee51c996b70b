// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "app/insert_totals.hpp"
#include "app/stages.hpp"
#include "app/time_spans.hpp"
#include "lio/match/main_axis.hpp"
#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// Whether a frame has a pose that can be trusted.
bool has_pose(const lio::FrameResult& frame);

/// What a run's frames said, summed up: takes the same memory for any number of them.
class RunSummary {
 public:
  /// `max_points`: of a scan that are used, lidar.max_points.
  explicit RunSummary(std::size_t max_points = std::numeric_limits<std::size_t>::max())
      : max_points_(max_points) {}

  /// `returns`: of the frame's scan, before any is left out.
  void add(const lio::FrameResult& frame, std::size_t returns);

  std::size_t frames() const { return frames_; }
  std::size_t poses() const { return poses_; }

  /// Frames whose pose rests on their scan and, where that does not tell it, on what came shortly
  /// before.
  std::size_t usable() const { return usable_; }

  const InsertTotals& inserted() const { return inserted_; }

  /// What is wrong with most of the frames that have no trustworthy pose; empty for none.
  std::string main_trouble() const;

  /// What was not in order, one line each.
  std::vector<std::string> warnings() const;

  /// "40 weak, 3 lost": the frames that were not usable, in words; empty for none.
  std::string counts() const;

  /// Mean and largest CPU time per scan of each stage, as a table.
  std::string timing_table() const;

  /// The same as a JSON object, with `wall_seconds` of the whole run.
  std::string timing_json(double wall_seconds) const;

 private:
  /// Frames whose pose is not what one hopes for.
  struct Trouble {
    lio::FrameStatus status;
    const char* meaning;
    TimeSpans spans = {};
    std::map<std::string, std::size_t> messages = {};  ///< in how many frames

    std::string usual_message() const;
  };
  /// CPU time of a stage [ms].
  struct StageSummary {
    double sum = 0.0;
    double max = 0.0;
  };

  double mean(const StageSummary& summary) const;
  std::string range_warning() const;
  void note_pause(double time);
  std::string describe(const Trouble& trouble) const;
  void add_input_warnings(std::vector<std::string>& warnings) const;
  std::string unobserved_directions() const;
  void add_map_warnings(std::vector<std::string>& warnings) const;

  std::size_t max_points_;
  std::size_t frames_ = 0;
  std::size_t poses_ = 0;
  std::size_t usable_ = 0;
  double begin_ = 0.0;                ///< time of the first frame [s]
  double end_ = 0.0;                  ///< and of the last
  double longest_pause_ = 0.0;        ///< between two frames [s]
  double longest_pause_begin_ = 0.0;  ///< [s]
  std::size_t returns_ = 0;           ///< that would have been used within the limits of range
  InsertTotals inserted_;
  bool has_imu_ = false;                            ///< that was used
  double imu_time_offset_ = 0.0;                    ///< of the last frame [s]
  lio::ImuNoise imu_noise_ = {0.0, 0.0, 0.0, 0.0};  ///< of the last frame
  std::array<Trouble, 4> troubles_ = {
      {{lio::FrameStatus::kInitializing, "they have no pose"},
       {lio::FrameStatus::kWeak, "their poses are predictions"},
       {lio::FrameStatus::kLost, "they have no pose"},
       {lio::FrameStatus::kSkipped, "they have no pose"}}};
  TimeSpans unobserved_;  ///< frames that are degenerate
  lio::MainAxis unobserved_along_, unobserved_about_;
  std::array<StageSummary, 7> summaries_;  ///< in the order of stages()
};

}  // namespace nvm::app
