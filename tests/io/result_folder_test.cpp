// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/result_folder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/file/file.hpp"
#include "io/file/pending_path.hpp"
#include "io/temporary_folder.hpp"

namespace nvm::io {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

class ResultFolderTest : public test::TemporaryFolder {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("out"))) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  // What a process does that is killed at the end of `action`: no destructor runs.
  static void die_after(const std::function<void()>& action) {
    const pid_t child = ::fork();
    if (child == 0) {
      action();
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
  }

  void write_results(const ResultFolder& results, const std::string& text) const {
    for (const char* name : {"/trajectory.tum", "/map.ply"}) {
      AtomicFile file(results.path() + name);
      file.stream() << text;
      file.commit();
    }
  }

  void publish(const std::string& text) const {
    ResultFolder results(path("out"));
    write_results(results, text);
    results.publish();
  }
};

TEST_F(ResultFolderTest, ReplacesAllResultsOfAnOlderRunAndNothingElse) {
  write("out/trajectory.tum", "old");
  write("out/map.nvm", "old");
  write("out/notes.txt", "mine");
  publish("new");
  EXPECT_THAT(names(), UnorderedElementsAre("trajectory.tum", "map.ply", "notes.txt"));
  EXPECT_EQ(read_file(path("out/trajectory.tum")), "new");
}

TEST_F(ResultFolderTest, ChangesNothingUntilPublished) {
  write("out/map.nvm", "old");
  {
    const ResultFolder results(path("out"));
    write_results(results, "new");
    EXPECT_THAT(names(), SizeIs(2));
  }
  EXPECT_THAT(names(), ElementsAre("map.nvm"));
}

TEST_F(ResultFolderTest, FindsWhatAKilledProcessLeftAndRemovesItWhenPublished) {
  die_after([&] { write_results(*new ResultFolder(path("out")), "half"); });
  {
    const ResultFolder results(path("out"));
    ASSERT_THAT(results.unfinished(), SizeIs(1));
    EXPECT_EQ(read_file(results.unfinished()[0] + "/trajectory.tum"), "half");
  }
  EXPECT_THAT(names(), SizeIs(1));  // still there: nothing has replaced it
  publish("new");
  EXPECT_THAT(names(), UnorderedElementsAre("trajectory.tum", "map.ply"));
}

TEST_F(ResultFolderTest, LeavesARunThatIsAliveAlone) {
  ResultFolder first(path("out"));
  write_results(first, "first");
  {
    ResultFolder second(path("out"));
    EXPECT_THAT(second.unfinished(), IsEmpty());
    write_results(second, "second");
    second.publish();
  }
  first.publish();
  EXPECT_EQ(read_file(path("out/map.ply")), "first");
  EXPECT_THAT(names(), UnorderedElementsAre("trajectory.tum", "map.ply"));
}

// A process that is killed while results replace others: wherever that is, the next one finds
// those of one run only, and completes them.
TEST_F(ResultFolderTest, CompletesWhatAKilledProcessHadBegunToPutInPlace) {
  for (const int killed_at : {0, 1, 2, 3}) {
    SCOPED_TRACE(killed_at);
    std::filesystem::remove_all(path("out"));
    write("out/trajectory.tum", "old");
    write("out/map.nvm", "old");
    const std::string complete = killed_at < 2 ? "out/nvm-results" : "out/nvm-results.moving";
    write(complete + "/trajectory.tum", "new");
    write(complete + "/map.ply", "new");
    if (killed_at >= 1) {
      std::filesystem::remove(path("out/map.nvm"));
    }
    if (killed_at >= 2) {
      std::filesystem::remove(path("out/trajectory.tum"));
    }
    if (killed_at == 3) {
      std::filesystem::rename(path(complete + "/map.ply"), path("out/map.ply"));
    }
    { const ResultFolder results(path("out")); }
    EXPECT_THAT(names(), UnorderedElementsAre("trajectory.tum", "map.ply"));
    EXPECT_EQ(read_file(path("out/trajectory.tum")), "new");
    EXPECT_EQ(read_file(path("out/map.ply")), "new");
  }
}

TEST_F(ResultFolderTest, LeftoversAreThoseOfTheVeryName) {
  die_after([&] { new PendingPath(path("map.ply"), PendingPath::Kind::kFile); });
  write("map.ply.partition", "mine");
  write("map.ply.part-20240101", "mine too, by chance");
  write("map.ply2.part-abcdefgh", "of map.ply2");
  const std::vector<std::string> leftovers = leftovers_of(path("map.ply"));
  EXPECT_THAT(leftovers, SizeIs(2));
  EXPECT_THAT(leftovers, ::testing::Not(::testing::Contains(path("map.ply2.part-abcdefgh"))));
  const PendingPath alive(path("map.ply"), PendingPath::Kind::kFile);
  EXPECT_EQ(leftovers_of(path("map.ply")), leftovers);
}

}  // namespace
}  // namespace nvm::io
