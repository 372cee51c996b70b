// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_stream.hpp"

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "app/run_summary.hpp"
#include "app/stages.hpp"
#include "io/cloud/point_records.hpp"
#include "io/file/file.hpp"

namespace nvm::app {

namespace {

using json = nlohmann::ordered_json;

json to_json(const Pose& pose) {
  const Eigen::Vector3d t = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

json to_json(const std::vector<Eigen::Vector3d>& directions) {
  json rows = json::array();
  for (const Eigen::Vector3d& d : directions) {
    rows.push_back({d.x(), d.y(), d.z()});
  }
  return rows;
}

json head_of(const lio::FrameResult& frame, std::size_t scan_points, std::size_t map_points) {
  json times = json::object();
  for (const Stage& stage : stages()) {
    times[stage.key] = stage.time(frame.times);
  }
  const bool is_placed = has_pose(frame);
  return {
      {"time", frame.time},
      {"status", lio::name(frame.status)},
      {"why", frame.message},
      {"T_map_body", is_placed ? to_json(frame.T_map_body) : json()},
      {"T_map_lidar", is_placed ? to_json(frame.T_map_lidar) : json()},
      {"unobserved_translations", to_json(frame.unobserved.translations)},
      {"unobserved_rotations", to_json(frame.unobserved.rotations)},
      {"times", times},
      {"scan", scan_points},
      {"map", map_points}};
}

template <class Vector>
void append_position(const Vector& position, std::string& bytes) {
  for (const auto coordinate : position) {
    io::append_bytes(static_cast<float>(coordinate), bytes);
  }
}

}  // namespace

RunStream::RunStream(const std::string& path) {
  if (path.empty()) {
    return;
  }
  std::signal(SIGPIPE, SIG_IGN);  // a viewer that is closed is a stream that fails
  stream_.open(path, std::ios::binary);
  if (!stream_) {
    io::fail(path, "cannot be written");
  }
}

std::vector<MapPoint> RunStream::map_when_due(const lio::Pipeline& pipeline) {
  constexpr std::chrono::seconds kPeriod(1);
  constexpr int kShare = 20;  // of the run's time that maps take, at most: one in so many
  const auto begin = std::chrono::steady_clock::now();
  if (begin < next_map_ || pipeline.map().size() == 0) {
    return {};
  }
  std::vector<MapPoint> points = pipeline.map().points();
  const auto end = std::chrono::steady_clock::now();
  next_map_ = end + std::max<std::chrono::steady_clock::duration>(kPeriod, kShare * (end - begin));
  return points;
}

void RunStream::add(const lio::FrameResult& frame, const lio::Pipeline& pipeline) {
  if (!stream_.is_open() || !stream_) {
    return;
  }
  const std::vector<Eigen::Vector3f> nothing;
  const auto& scan = has_pose(frame) ? pipeline.scan().points : nothing;
  const std::vector<MapPoint> map = map_when_due(pipeline);
  std::string bytes = head_of(frame, scan.size(), map.size()).dump() + '\n';
  for (const Eigen::Vector3f& point : scan) {
    append_position(point, bytes);
  }
  for (const MapPoint& point : map) {
    append_position(point.position, bytes);
  }
  for (const MapPoint& point : map) {
    bytes += static_cast<char>(point.side);
  }
  stream_ << bytes << std::flush;
}

}  // namespace nvm::app
