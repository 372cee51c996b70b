// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace nvm::app {

namespace {

constexpr char kEraseLine[] = "\r\033[K";

}  // namespace

ProgressBar::ProgressBar(std::size_t total)
    : total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (is_terminal_) {
    fmt::print(stderr, kEraseLine);
  }
}

void ProgressBar::step(const std::string& note) {
  ++done_;
  constexpr std::chrono::milliseconds kInterval(100);
  if (is_terminal_ && Clock::now() - drawn_ >= kInterval) {
    drawn_ = Clock::now();
    draw(note);
  }
}

void ProgressBar::draw(const std::string& note) const {
  const double seconds = std::chrono::duration<double>(drawn_ - begin_).count();
  if (total_ == 0) {
    fmt::print(stderr, "{}{} scans, {:.0f} s  {}", kEraseLine, done_, seconds, note);
  } else {
    constexpr std::size_t kWidth = 30;
    const std::size_t done = std::min(done_, total_);
    const double remaining =
        seconds * static_cast<double>(total_ - done) / static_cast<double>(done);
    fmt::print(
        stderr,
        "{}[{:<{}}] {}/{} scans, {:.0f} s left  {}",
        kEraseLine,
        std::string(kWidth * done / total_, '='),
        kWidth,
        done,
        total_,
        remaining,
        note);
  }
  std::fflush(stderr);
}

}  // namespace nvm::app
