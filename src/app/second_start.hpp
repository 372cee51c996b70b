// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>

#include "app/run_options.hpp"
#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// Has a run begin again, once, with what it has found out of the IMU on its way: until then its
/// scans went alone, or by wrong times, and the map shows it.
class SecondStart {
 public:
  /// `input` that is a pipe comes again only when whoever fills it has named a `file`, where it
  /// finds what to --set then; the program ends with kExitAgain.
  SecondStart(const std::string& input, std::string file);

  /// Watches `pipeline` after its frame at `time` [s]: whether to begin again now.
  bool is_due(const lio::Pipeline& pipeline, double time);
  /// At the end of the recording: whether what was found last calls for it.
  bool is_due() const { return begin_ && !is_begun_; }

  /// Begins again: `options` take over what was found, in words for the user. Throws Failure when
  /// the input has to come again first.
  void begin(RunOptions& options);

 private:
  std::string file_;
  bool is_begun_ = false;
  std::optional<double> first_;  ///< time of the first frame [s]
  std::optional<double> begin_;  ///< since when there is a `better_` that stays [s]
  lio::ImuSetup then_;           ///< what it was then
  lio::ImuSetup better_;
  bool is_pipe_ = false;
};

}  // namespace nvm::app
