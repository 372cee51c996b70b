// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

namespace nvm::io {

/// 0 to 9.
bool is_digit(char c);

/// Whether file name `a` comes before `b` when runs of digits count by their value: "2.pcd" before
/// "10.pcd". Names that differ only in leading zeros are ordered as text.
bool precedes_naturally(const std::string& a, const std::string& b);

}  // namespace nvm::io
