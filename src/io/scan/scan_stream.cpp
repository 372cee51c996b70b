// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/scan_stream.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace nvm::io {
namespace {

/// When a cloud came [s].
double arrival(const CloudMessage& cloud) {
  return std::isfinite(cloud.record_time) ? cloud.record_time : cloud.stamp;
}

}  // namespace

std::vector<CloudMessage> ScanStream::select(std::vector<CloudMessage> clouds) {
  CloudStream stream;
  std::vector<CloudMessage> selected;
  for (CloudMessage& cloud : clouds) {
    try {
      stream.check(cloud, arrival(cloud));
      selected.push_back(std::move(cloud));
    } catch (const std::runtime_error&) {
      continue;  // check() tells it when the cloud comes again
    }
  }
  return selected;
}

void ScanStream::learn(const std::vector<CloudMessage>& clouds) {
  converter_.learn(clouds);
  const std::vector<Scan> first = converter_.preview(clouds);
  two_lidars_ = overlap_.learn(first);
  if (two_lidars_.empty()) {
    two_lidars_ = views_.learn(first);
  }
}

void ScanStream::check(const CloudMessage& cloud) { clouds_.check(cloud, arrival(cloud)); }

Scan ScanStream::convert(const PointRecords& records, double stamp) {
  Scan scan = converter_.convert(records, stamp);
  overlap_.check(scan);
  views_.check(scan);
  return scan;
}

std::vector<std::string> ScanStream::notes() const {
  std::vector<std::string> notes = converter_.notes();
  if (!two_lidars_.empty()) {
    notes.push_back(two_lidars_);
  }
  return notes;
}

std::vector<std::string> ScanStream::findings() const {
  std::vector<std::string> findings = notes();
  if (converter_.times().base != PointTimes::Base::kNone && !findings.empty()) {
    findings.erase(findings.begin());  // how points are dated
  }
  return findings;
}

}  // namespace nvm::io
