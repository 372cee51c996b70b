// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/report.hpp"

#include <filesystem>
#include <system_error>

#include "eval/report/drawing_json.hpp"
#include "eval/report/json_report.hpp"
#include "io/file/file.hpp"
#include "io/file/pending_path.hpp"

namespace nvm::eval {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  io::AtomicFile file(path.string());
  file.stream() << text;
  file.commit();
}

}  // namespace

void write_report(const Evaluation& evaluation, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    io::fail(folder, "cannot be made: " + error.message());
  }
  const std::filesystem::path path(folder);
  write_text(path / "drawing.json", drawing_json(evaluation));
  write_text(path / "evaluation.json", json_report(evaluation));
}

}  // namespace nvm::eval
