// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#if !defined(__cpp_exceptions)
#error "nvm reports bad options and files by exceptions: compile without -fno-exceptions"
#endif

#include <sstream>
#include <stdexcept>

#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Throws std::invalid_argument "nvm: NAME = VALUE must be ALLOWED" unless `ok`: the one way in
/// which options are refused.
template <class Value>
void require(bool ok, const char* name, const Value& value, const char* allowed) {
  if (!ok) {
    std::ostringstream message;
    message << "nvm: " << name << " = " << value << " must be " << allowed;
    throw std::invalid_argument(message.str());
  }
}

}  // namespace NVM_TARGET
}  // namespace nvm
