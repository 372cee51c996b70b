// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "io/message/message_source.hpp"

namespace tf2 {
class BufferCore;
}

namespace nvm_ros {

/// Tells `tf` what a recording has on /tf_static, and in the beginning of /tf. Transforms that are
/// damaged are left out. `name`: of the recording, for tf2's own messages.
void read_transforms(nvm::io::MessageSource& source, const std::string& name, tf2::BufferCore& tf);

}  // namespace nvm_ros
