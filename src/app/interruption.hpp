// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

namespace nvm::app {

/// From now on the first SIGINT, SIGTERM or SIGHUP ends the process with a line that says so,
/// unless an Interruption lives. Signals that the process was told to ignore stay ignored.
void say_when_interrupted();

/// While it lives, after say_when_interrupted(), the first SIGINT, SIGTERM or SIGHUP is only noted,
/// so that what was done can be brought to its end; the second ends the process at once. One at a
/// time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that came; 0: none.
  int signal() const;
  /// Throws Failure when one came, with what is `left` then.
  void check(const std::string& left) const;
};

}  // namespace nvm::app
