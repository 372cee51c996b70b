// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "eval/html_report.hpp"
#include "eval/json_report.hpp"
#include "eval/wall_pictures.hpp"
#include "io/file.hpp"
#include "io/pending_path.hpp"

namespace nvm::eval {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  io::AtomicFile file(path.string());
  file.stream() << text;
  file.commit();
}

/// `name` with everything but letters, digits, '-' and '.' turned into '_'.
std::string file_name(std::string name) {
  std::replace_if(
      name.begin(),
      name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; },
      '_');
  return name;
}

}  // namespace

void write_report(const Evaluation& evaluation, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    io::fail(folder, "cannot be made: " + error.message());
  }
  const std::filesystem::path path(folder);
  const std::vector<WallPicture> pictures = wall_pictures(evaluation);
  for (const WallPicture& picture : pictures) {
    write_text(path / ("wall_" + file_name(picture.name) + ".svg"), picture.svg);
  }
  write_text(path / "evaluation.json", json_report(evaluation));
  write_text(path / "report.html", html_report(evaluation, pictures));
}

}  // namespace nvm::eval
