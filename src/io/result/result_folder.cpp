// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/result_folder.hpp"

#include <filesystem>
#include <system_error>

#include "io/file/file.hpp"
#include "io/result/session_file.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

/// All that a run or a map may leave, in any version.
constexpr const char* kResults[] = {
    "trajectory.tum",
    "trajectory_kitti.txt",
    "frames.csv",
    "timing.json",
    "map.ply",
    "map.nvm",
    "map_origin.txt",
    SessionWriter::kFileName};

// A pending folder gets the first of these names when it is complete, and the second when the old
// results are gone: the name tells where a process that was killed has been.
constexpr const char* kComplete = "/nvm-results";
constexpr const char* kMoving = "/nvm-results.moving";

/// Takes the results in `folder` that are complete from there to their place.
void put_in_place(const std::string& folder) {
  if (fs::exists(folder + kComplete) && !fs::exists(folder + kMoving)) {
    for (const char* name : kResults) {
      fs::remove(fs::path(folder) / name);
    }
    fs::rename(folder + kComplete, folder + kMoving);
    flush_to_disk(folder);
  }
  if (fs::exists(folder + kMoving)) {
    for (const auto& entry : fs::directory_iterator(folder + kMoving)) {
      fs::rename(entry.path(), fs::path(folder) / entry.path().filename());
    }
    fs::remove(folder + kMoving);
    flush_to_disk(folder);
  }
}

/// The same; one process at a time, and naming what cannot be replaced.
void put_in_place_alone(const std::string& folder) {
  const PathLock lock(folder);
  try {
    put_in_place(folder);
  } catch (const fs::filesystem_error& error) {
    fail(error.path1().string(), "cannot be replaced: " + error.code().message());
  }
}

}  // namespace

ResultFolder::ResultFolder(const std::string& folder)
    : folder_(folder),
      unfinished_(leftovers_of(folder + kComplete)),
      pending_(folder + kComplete, PendingPath::Kind::kFolder) {
  put_in_place_alone(folder_);
}

void ResultFolder::publish() {
  pending_.commit();
  put_in_place_alone(folder_);
  for (const std::string& path : unfinished_) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
}

}  // namespace nvm::io
