// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/pending_files.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/file/file.hpp"
#include "temporary_folder.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

class PendingFilesTest : public test::TemporaryFolder {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path(""))) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  static void fill(const PendingFiles& files) {
    std::ofstream(files.temporary()) << "new";
    std::ofstream(fs::path(files.temporary()).replace_extension(".ply")) << "new points";
  }
};

TEST_F(PendingFilesTest, ReplacesAllAtOnceAndLeavesOthersAlone) {
  write("all.nvm", "old");
  write("all.ply", "old points");
  write("notes.txt", "mine");
  PendingFiles files(path("all.nvm"));
  fill(files);
  EXPECT_EQ(read_file(path("all.ply")), "old points");
  files.commit();
  EXPECT_EQ(read_file(path("all.nvm")), "new");
  EXPECT_EQ(read_file(path("all.ply")), "new points");
  EXPECT_EQ(read_file(path("notes.txt")), "mine");
}

TEST_F(PendingFilesTest, LeavesNothingWithoutCommit) {
  fill(PendingFiles(path("all.nvm")));
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(PendingFilesTest, LosesNothingWhenOneCannotBePutInPlace) {
  write("all.nvm", "old");
  write("all.ply/inside", "of a folder");
  {
    PendingFiles files(path("all.nvm"));
    fill(files);
    EXPECT_THAT(
        test::runtime_error_of([&] { files.commit(); }), HasSubstr("all.ply: cannot be written"));
  }
  EXPECT_EQ(read_file(path("all.nvm")), "old");
  EXPECT_THAT(names(), UnorderedElementsAre("all.nvm", "all.ply"));
}

TEST_F(PendingFilesTest, RefusesAFolderThatIsMissing) {
  EXPECT_THAT(
      test::runtime_error_of([&] { PendingFiles(path("none/all.nvm")); }),
      HasSubstr("/none; make it first"));
  EXPECT_THAT(names(), IsEmpty());
}

}  // namespace
}  // namespace nvm::io
