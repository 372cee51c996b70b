// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "io/sequence/trajectory_io.hpp"
#include "io/temporary_folder.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::test {

struct Outcome {
  int status = -1;  ///< as a shell tells it
  std::string output;
  std::string errors;
};

inline std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A folder with scans of a room, and the program to run on it.
class ProgramFixture : public TemporaryFolder {
 protected:
  static constexpr int kScans = 5;

  void SetUp() override {
    TemporaryFolder::SetUp();
    auto random = rng();
    const Room room;
    std::string times;
    for (int k = 0; k < kScans; ++k) {
      Pose T_map_scan = Pose::Identity();
      T_map_scan.translation() << 0.1 * k, 0.0, 0.0;
      truth_.push_back({100.0 + k, T_map_scan});
      const std::string name = "scan" + std::to_string(k) + ".pcd";
      write("scans/" + name, pcd(room.scan(T_map_scan, 3000, 0.003, random).points));
      times += name + " " + std::to_string(truth_.back().time) + "\n";
    }
    write("timestamps.txt", times);
    io::write_tum(path("poses.tum"), truth_);
    io::write_kitti_poses(path("poses.txt"), truth_);
  }

  static std::string pcd(const std::vector<Eigen::Vector3f>& points) {
    std::ostringstream file;
    file << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
         << points.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << points.size()
         << "\nDATA ascii\n";
    for (const Eigen::Vector3f& point : points) {
      file << point.transpose() << "\n";
    }
    return file.str();
  }

  /// Runs the program; `before` goes before it on the command line.
  Outcome nvm(const std::string& arguments, const std::string& before = "") const {
    const std::string command = before + std::string(NVM_PROGRAM) + " " + arguments + " >" +
                                path("output") + " 2>" + path("errors");
    const int status = std::system(command.c_str());
    return {
        WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
        text_of(path("output")),
        text_of(path("errors"))};
  }

  /// Scans of the test are sparse.
  static std::string for_sparse_scans() {
    return " --set normals.min_radius=0.4 --set normals.max_radius=0.6 ";
  }

  std::string run(const std::string& more) const {
    return "run " + path("") + " --out " + path("out") + for_sparse_scans() + more;
  }

  std::string map(const std::string& poses, const std::string& more = "") const {
    return "map " + path("") + " --poses " + path(poses) + " --out " + path("out") +
           for_sparse_scans() + more;
  }

  std::vector<std::string> names_in(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder))) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  /// The program says what is wrong in one line, whatever it noted while reading, and leaves
  /// nothing in the folder.
  void expect_failure(const std::string& arguments, const std::string& message) const {
    const Outcome outcome = nvm(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.errors, ::testing::HasSubstr(message));
    int lines = 0;
    std::istringstream errors(outcome.errors);
    for (std::string line; std::getline(errors, line);) {
      lines += line.rfind("nvm: note: ", 0) == 0 ? 0 : 1;
    }
    EXPECT_EQ(lines, 1) << outcome.errors;
    if (std::filesystem::exists(path("out"))) {
      EXPECT_THAT(names_in("out"), ::testing::IsEmpty());
    }
  }

  Trajectory truth_;
};

}  // namespace nvm::test
