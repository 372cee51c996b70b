// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace nvm::io {

/// What sizes are printed in.
constexpr double kBytesPerMegabyte = 1e6;

/// "memory ran out while WHAT: ...", with how much the process has and may have.
std::string out_of_memory(const std::string& what);

/// "while WHAT: path: problem".
std::string file_trouble(const std::string& what, const std::filesystem::filesystem_error& error);

/// Does `action`, and throws std::runtime_error that says `what` was being done, as in "opening
/// run.bag", when memory runs out or the file system refuses.
template <class Action>
auto doing(const std::string& what, const Action& action) {
  try {
    return action();
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(out_of_memory(what));
  } catch (const std::filesystem::filesystem_error& error) {
    throw std::runtime_error(file_trouble(what, error));
  }
}

}  // namespace nvm::io
