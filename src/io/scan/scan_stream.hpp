// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "io/scan/alternating_views.hpp"
#include "io/scan/cloud_stream.hpp"
#include "io/scan/scan_converter.hpp"
#include "io/scan/sweep_overlap.hpp"

namespace nvm::io {

/// The clouds of a topic as the scans of one LiDAR, each once, dated as the first ones tell.
class ScanStream {
 public:
  explicit ScanStream(PointTimeOptions options = {}) : converter_(std::move(options)) {}

  /// `clouds` without those that check() would refuse.
  static std::vector<CloudMessage> select(std::vector<CloudMessage> clouds);

  /// Judges by the first clouds, in order, how they are dated, as any one may be bad.
  void learn(const std::vector<CloudMessage>& clouds);

  /// Takes the next cloud. Throws std::runtime_error for one of another LiDAR, and for one that
  /// was sent before (CloudStream).
  void check(const CloudMessage& cloud);

  /// The scan of the cloud that passed check() last, which its clock dates `stamp` [s]. Throws
  /// std::runtime_error (ScanConverter, SweepOverlap, AlternatingViews).
  Scan convert(const PointRecords& records, double stamp);

  const ScanConverter& converter() const { return converter_; }

  /// What was inferred, mended and left out, for the user; grows with the scans.
  std::vector<std::string> notes() const;

  /// Those of notes() that the user should act on: all but how points are dated, where they are.
  std::vector<std::string> findings() const;

 private:
  CloudStream clouds_;
  ScanConverter converter_;
  SweepOverlap overlap_;
  AlternatingViews views_;
  std::string two_lidars_;  ///< what either says
};

}  // namespace nvm::io
