// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/interruption.hpp"

#include <csignal>

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

void note(int signal) {
  noted = signal;
  replace_handlers(note, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  noted = 0;
  replace_handlers(SIG_DFL, note);
}

Interruption::~Interruption() { replace_handlers(note, SIG_DFL); }

int Interruption::signal() const { return noted; }

}  // namespace nvm::app
