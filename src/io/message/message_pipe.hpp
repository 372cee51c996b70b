// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

/// Opens a pipe into which another program writes the messages of a recording (docs/formats.md,
/// "Pipe of messages"): how the Python package hands ROS 2 bags over. Reads them as open_ros_bags()
/// does. Throws std::runtime_error, naming the recording, when what comes is something else or ends
/// too early.
std::unique_ptr<SequenceReader> open_message_pipe(
    const std::string& path, const SequenceOptions& options);

}  // namespace nvm::io
