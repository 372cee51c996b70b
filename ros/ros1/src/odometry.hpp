// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "io/sequence/sequence_reader.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "lio/pipeline/pipeline_options.hpp"

namespace nvm_ros {

/// A pipeline that finds out by itself in which unit the IMU measures.
class Odometry {
 public:
  /// Throws std::invalid_argument for a bad option. `options`' type is resolved.
  Odometry(const nvm::lio::PipelineOptions& options, nvm::io::AccelUnit unit);

  /// Takes the readings up to the scan's end, as they stand in the messages, and the scan.
  nvm::lio::FrameResult process(const std::vector<nvm::ImuSample>& samples, const nvm::Scan& scan);

  const nvm::lio::Pipeline& pipeline() const { return *pipeline_; }

 private:
  void take(const std::vector<nvm::ImuSample>& samples);

  nvm::io::AccelUnit unit_;
  std::unique_ptr<nvm::lio::Pipeline> pipeline_;
  std::optional<double> accel_scale_;      // nothing before enough readings have told
  std::vector<nvm::ImuSample> undecided_;  // the readings before accel_scale_ is known
};

}  // namespace nvm_ros
