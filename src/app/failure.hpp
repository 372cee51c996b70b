// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <stdexcept>
#include <string>

namespace nvm::app {

/// How the program ends. A signal adds its number to kSignal.
enum Exit : int {
  kExitSuccess = 0,
  kExitError = 1,     ///< nothing useful came out, or only what came before an error
  kExitUsage = 2,     ///< arguments that make no sense
  kExitUnusable = 3,  ///< there are results, but most of the run is not usable
  kExitAgain = 75,    ///< the input is to come once more, see SecondStart
  kExitSignal = 128,
};

/// Ends the program with one line and an exit status.
class Failure : public std::runtime_error {
 public:
  Failure(const std::string& message, int status) : std::runtime_error(message), status_(status) {}

  int status() const { return status_; }

 private:
  int status_;
};

}  // namespace nvm::app
