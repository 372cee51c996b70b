// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "odometry.hpp"

#include <algorithm>
#include <utility>

#include "io/sequence/sequence_options.hpp"

namespace nvm_ros {

using nvm::ImuSample;

Odometry::Odometry(const nvm::lio::PipelineOptions& options, nvm::io::AccelUnit unit)
    : unit_(unit), pipeline_(nvm::lio::make_pipeline(options)) {}

nvm::lio::FrameResult Odometry::process(
    const std::vector<ImuSample>& samples, const nvm::Scan& scan) {
  take(samples);
  return pipeline_->process(scan);
}

// No pipeline starts before it has seen the IMU for a fifth of a second, so that none waits for
// this.
void Odometry::take(const std::vector<ImuSample>& samples) {
  constexpr std::size_t kEnough = 20;
  undecided_.insert(undecided_.end(), samples.begin(), samples.end());
  if (!accel_scale_ && undecided_.size() >= kEnough) {
    std::vector<double> norms;
    for (const ImuSample& sample : undecided_) {
      norms.push_back(sample.accel.norm());
    }
    accel_scale_ = nvm::io::accel_scale(std::move(norms), unit_);
  }
  if (accel_scale_) {
    for (ImuSample& sample : undecided_) {
      sample.accel *= *accel_scale_;
      pipeline_->add_imu(sample);
    }
    undecided_.clear();
  }
}

}  // namespace nvm_ros
