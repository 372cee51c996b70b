// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/message/message_source.hpp"
#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

/// Reads clouds (sensor_msgs/PointCloud2, or CustomMsg of Livox's drivers) of one topic and
/// sensor_msgs/Imu of another, whatever holds them. Messages that are bad, repeat or go back in
/// time are left out and counted in a note. Throws std::runtime_error, naming `path`, when there is
/// no such topic.
std::unique_ptr<SequenceReader> read_messages(
    const std::string& path, std::unique_ptr<MessageSource> source, const SequenceOptions& options);

}  // namespace nvm::io
