// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/frame_table.hpp"

#include <fmt/format.h>

#include <vector>

#include "app/stages.hpp"

namespace nvm::app {

namespace {

struct Column {
  const char* name;
  std::string (*cell)(const lio::FrameResult&);
};

/// `text` as a cell of a CSV file, always in quotes.
std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) {
    cell += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  }
  return cell + '"';
}

const std::vector<Column>& columns() {
  using Frame = lio::FrameResult;
  static const std::vector<Column> kColumns = {
      {"time", [](const Frame& f) { return fmt::format("{:.9f}", f.time); }},
      {"status", [](const Frame& f) { return std::string(lio::name(f.status)); }},
      {"why", [](const Frame& f) { return quoted(f.message); }},
      {"points", [](const Frame& f) { return std::to_string(f.points); }},
      {"keypoints", [](const Frame& f) { return std::to_string(f.keypoints); }},
      {"residuals", [](const Frame& f) { return std::to_string(f.residuals); }},
      {"inlier_share", [](const Frame& f) { return fmt::format("{:.4f}", f.inlier_share); }},
      {"residual_rms", [](const Frame& f) { return fmt::format("{:.6f}", f.residual_rms); }},
      {"unobserved_directions",
       [](const Frame& f) { return std::to_string(f.degenerate_directions); }},
      {"unobserved", [](const Frame& f) { return quoted(f.unobserved.text()); }},
      {"iterations", [](const Frame& f) { return std::to_string(f.iterations); }},
      {"stored_points", [](const Frame& f) { return std::to_string(f.inserted.stored); }}};
  return kColumns;
}

}  // namespace

std::string frame_header() {
  std::string header;
  for (const Column& column : columns()) {
    header += column.name + std::string(",");
  }
  for (const Stage& stage : stages()) {
    header += stage.key + std::string(",");
  }
  header.back() = '\n';
  return header;
}

std::string frame_row(const lio::FrameResult& frame) {
  std::string row;
  for (const Column& column : columns()) {
    row += column.cell(frame) + ',';
  }
  for (const Stage& stage : stages()) {
    row += fmt::format("{:.3f},", stage.time(frame.times));
  }
  row.back() = '\n';
  return row;
}

}  // namespace nvm::app
