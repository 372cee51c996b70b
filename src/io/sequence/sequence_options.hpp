// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "io/scan/point_times.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::config {
class Schema;
}

namespace nvm::io {

/// Binds the keys of the section `input` of a run's configuration to `options`.
void bind(config::Schema& schema, SequenceOptions& options);

/// The extrinsic that `options` give, else `otherwise`. Throws std::invalid_argument for numbers
/// that are no pose.
Pose extrinsic(const SequenceOptions& options, const Pose& otherwise);

/// How points are dated, as far as `options` say it.
PointTimeOptions point_time_options(const SequenceOptions& options);
/// The same for points of messages, which come as the sensor gave them.
PointTimeOptions message_time_options(const SequenceOptions& options);

/// The factor that makes m/s^2 of accelerations, the first of which have the lengths `norms`.
double accel_scale(std::vector<double> norms, AccelUnit unit);

}  // namespace nvm::io
