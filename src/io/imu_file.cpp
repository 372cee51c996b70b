// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/imu_file.hpp"

#include <array>
#include <limits>
#include <stdexcept>

namespace nvm::io {

ImuFile::ImuFile(const std::string& path, double max_gap)
    : rows_(path, {"t", "gx", "gy", "gz", "ax", "ay", "az"}), gaps_(max_gap) {
  advance();
}

std::vector<lio::ImuSample> ImuFile::until(double time) {
  std::vector<lio::ImuSample> samples;
  while (next_ && next_->time <= time) {
    try {
      gaps_.add(next_->time);
    } catch (const std::runtime_error& gap) {
      rows_.line().fail(gap.what());
    }
    samples.push_back(*next_);
    advance();
  }
  return samples;
}

void ImuFile::advance() {
  const double previous = next_ ? next_->time : -std::numeric_limits<double>::infinity();
  next_.reset();
  const auto cells = rows_.next();
  if (!cells) {
    return;
  }
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = rows_.line().number((*cells)[i]);
  }
  if (values[0] <= previous) {
    rows_.line().fail("the time is not above that of the sample before");
  }
  next_ = {values[0], {values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
}

}  // namespace nvm::io
