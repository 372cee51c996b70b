// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/time_spans.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nvm::app {

void TimeSpans::add(double time, bool is_so) {
  constexpr std::size_t kKept = 4;
  count_ += is_so ? 1 : 0;
  if (is_so && is_open_) {
    longest_.back().end = time;
  } else if (is_so) {
    if (longest_.size() == kKept) {
      longest_.erase(
          std::min_element(longest_.begin(), longest_.end(), [](const Span& a, const Span& b) {
            return a.length() < b.length();
          }));
      ++dropped_;
    }
    longest_.push_back({time, time});
  }
  is_open_ = is_so;
}

std::string TimeSpans::describe(double begin) const {
  std::vector<std::string> parts;
  for (const Span& span : longest_) {
    parts.push_back(
        span.length() > 0.0
            ? fmt::format("{:.1f} to {:.1f} s", span.begin - begin, span.end - begin)
            : fmt::format("at {:.1f} s", span.begin - begin));
  }
  if (dropped_ > 0) {
    parts.push_back(fmt::format("{} shorter times", dropped_));
  }
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  }
  return text;
}

}  // namespace nvm::app
