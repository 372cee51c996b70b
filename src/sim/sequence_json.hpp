// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "nvm/geometry/pose.hpp"
#include "sim/lidar.hpp"
#include "sim/scene.hpp"
#include "sim/simulation.hpp"

namespace nvm::sim {

/// Counts the true returns on each face of each box.
class SurfaceHits {
 public:
  explicit SurfaceHits(const Scene& scene) : box_hits_(scene.boxes.size()) {}

  void count(const SimulatedScan& simulated) {
    points_ += simulated.truth.size();
    for (const ReturnTruth& truth : simulated.truth) {
      if (truth.origin == Origin::kSurface && truth.surface.object < box_hits_.size()) {
        ++box_hits_[truth.surface.object][truth.surface.face];
      }
    }
  }

  std::size_t points() const { return points_; }
  std::size_t on_face(std::size_t box, std::uint32_t face) const { return box_hits_[box][face]; }

 private:
  std::vector<std::array<std::size_t, 6>> box_hits_;
  std::size_t points_ = 0;
};

/// What is known of a sequence once it has been simulated.
struct SequenceFacts {
  std::size_t scans = 0;
  std::size_t points = 0;
  std::size_t imu_samples = 0;
  Pose T_imu_lidar = Pose::Identity();
};

/// The text of meta.json: sensor, options, extrinsic, noise, counts and files.
std::string meta_json(
    const Scene& scene, const SimulationOptions& options, const SequenceFacts& facts);

/// The text of scene.json: the primitives, and the thin walls as ground truth.
std::string scene_json(const Scene& scene, const SurfaceHits& hits);

}  // namespace nvm::sim
