// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/interruption.hpp"

#include <unistd.h>

#include <csignal>

#include "app/failure.hpp"

namespace nvm::app {

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t noted = 0;  // a handler has nothing else to write to

void replace_handlers(void (*from)(int), void (*to)(int)) {
  for (const int signal : kSignals) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == from) {
      action.sa_handler = to;
      action.sa_flags = SA_RESTART;
      ::sigaction(signal, &action, nullptr);
    }
  }
}

/// Ends the process by the signal; only what a signal handler may do.
void leave(int signal) {
  constexpr char kMessage[] = "\nnvm: interrupted; nothing was written\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void note(int signal) {
  noted = signal;
  replace_handlers(note, SIG_DFL);
}

}  // namespace

void say_when_interrupted() { replace_handlers(SIG_DFL, leave); }

Interruption::Interruption() {
  noted = 0;
  replace_handlers(leave, note);
}

Interruption::~Interruption() { replace_handlers(note, leave); }

int Interruption::signal() const { return noted; }

void Interruption::check(const std::string& left) const {
  if (noted != 0) {
    throw Failure("interrupted: " + left, kExitSignal + noted);
  }
}

}  // namespace nvm::app
