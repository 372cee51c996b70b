// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/session_fit.hpp"

#include <algorithm>

#include "nvm/registration/scan_aligner.hpp"

namespace nvm::merge {

namespace {

constexpr std::size_t kMostWitnesses = 40;  // keyframes that are asked
constexpr std::size_t kPointsEach = 300;    // of a keyframe, that are aligned

AlignOptions align_options(double max_plane_distance) {
  AlignOptions align;
  align.association.neighbors = 10;
  align.association.max_neighbor_distance = 0.4;
  align.association.max_plane_distance = max_plane_distance;
  align.kernel.scale = 0.3 * max_plane_distance;
  align.max_iterations = 30;
  align.converged_rotation = 1e-6;
  align.converged_translation = 1e-5;
  return align;
}

}  // namespace

SessionBody::SessionBody(const std::vector<io::Keyframe>& keyframes) {
  const std::size_t step = keyframes.size() / kMostWitnesses + 1;
  for (std::size_t k = 0; k < keyframes.size(); k += step) {
    T_session_lidar_.push_back(keyframes[k].T_map_lidar);
    witnesses_.emplace_back(keyframes[k].points, keyframes[k].normals);
  }
  for (const io::Keyframe& keyframe : keyframes) {
    center_ += keyframe.T_map_lidar.translation() / static_cast<double>(keyframes.size());
  }
  for (const io::Keyframe& keyframe : keyframes) {
    const std::size_t stride = keyframe.points.size() / kPointsEach + 1;
    for (std::size_t i = 0; i < keyframe.points.size(); i += stride) {
      const Eigen::Vector3d p_session = keyframe.T_map_lidar * keyframe.points[i].cast<double>();
      points_.push_back((p_session - center_).cast<float>());
      normals_.push_back(keyframe.T_map_lidar.linear().cast<float>() * keyframe.normals[i]);
    }
  }
}

SessionFit SessionBody::aligned(
    const VoxelMap& map, const Pose& T_map_session, const Executor& executor) const {
  SessionFit fit;
  Pose T_map_center = T_map_session * Eigen::Translation3d(center_);
  for (const double max_plane_distance : {0.3, 0.1}) {
    ScanAligner<VoxelMap> aligner(align_options(max_plane_distance));
    const AlignResult result = aligner.align(map, points_, normals_, T_map_center, executor);
    T_map_center = result.T_map_scan;
    fit.rms = result.rms_distance;
  }
  fit.T_map_session = T_map_center * Eigen::Translation3d(-center_);
  return fit;
}

lio::Testimonies SessionBody::testify(const VoxelMap& map, SessionFit& fit) const {
  constexpr double kMost = 0.6;
  lio::Testimonies all;
  fit.keyframes = witnesses_.size();
  for (std::size_t k = 0; k < witnesses_.size(); ++k) {
    const lio::Testimonies own =
        witnesses_[k].testify(map, fit.T_map_session * T_session_lidar_[k]);
    const auto agreeing = static_cast<double>(count(own, lio::Testimony::kFor));
    fit.shared_keyframes += agreeing > kMost * static_cast<double>(own.size()) ? 1 : 0;
    all.insert(all.end(), own.begin(), own.end());
  }
  const auto size = static_cast<double>(std::max<std::size_t>(1, all.size()));
  fit.overlap = static_cast<double>(count(all, lio::Testimony::kFor)) / size;
  fit.contradiction = static_cast<double>(count(all, lio::Testimony::kAgainst)) / size;
  return all;
}

}  // namespace nvm::merge
