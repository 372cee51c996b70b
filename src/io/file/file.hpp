// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace nvm::io {

/// Throws std::runtime_error "path: problem", the one form of error about a file.
[[noreturn]] void fail(const std::string& path, const std::string& problem);

/// Opens a file to read it. Throws std::runtime_error when that fails or it is a folder.
std::ifstream open_to_read(const std::string& path);

/// All bytes of a file. Throws std::runtime_error when it cannot be read.
std::string read_file(const std::string& path);

/// The folder in which `path` lies: "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// The extension of `path` in lower case, with its dot.
std::string extension_of(const std::string& path);

/// `text` in quotes, for a message: cut to 40 characters, and what cannot be printed as '?'.
std::string quote(std::string_view text);

}  // namespace nvm::io
