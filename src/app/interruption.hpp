// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::app {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is only noted, so that what was done can be
/// brought to its end; the second ends the process at once. Signals that the process was told to
/// ignore stay ignored. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that came; 0: none.
  int signal() const;
};

}  // namespace nvm::app
