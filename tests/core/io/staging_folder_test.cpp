#include "core/io/staging_folder.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <climits>
#include <fstream>

#include "core/io/atomic_files.hpp"
#include "tests/support/folder.hpp"

namespace signorini {
namespace {
namespace fs = std::filesystem;

class Staging : public test::Folder {
 protected:
  std::vector<std::string> found() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    return names;
  }
};

// As processes of two containers see each other's: the number in the name means nothing here.
TEST_F(Staging, AFolderThatIsHeldStaysWhateverItsNumber) {
  const fs::path live = folder_ / ".signorini-2147483647", own = folder_ / (".signorini-" + std::to_string(getpid()));
  std::vector<int> locks;
  for (const fs::path& folder : {live, own}) {
    fs::create_directory(folder);
    std::ofstream(folder / "report.json") << "{}";
    locks.push_back(open(folder.c_str(), O_RDONLY | O_DIRECTORY));
    ASSERT_EQ(flock(locks.back(), LOCK_EX), 0);
  }
  {
    AtomicFiles files(folder_);
    write_text(files.stage("a"), "a");
    files.commit();
  }
  EXPECT_THAT(found(), testing::UnorderedElementsAre(live.filename(), own.filename(), "a"));
  for (const int lock : locks) close(lock);
  AtomicFiles files(folder_);
  EXPECT_THAT(found(), testing::ElementsAre("a")) << "nobody holds them any more";
}

TEST_F(Staging, WhatAKilledProcessLeavesIsRemovedByTheNextOneOnly) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    AtomicFiles files(folder_);
    write_text(files.stage("a"), "half");
    if (write(ready[1], "x", 1) == 1) pause();
    _exit(1);
  }
  char byte;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  {
    AtomicFiles files(folder_);
    write_text(files.stage("b"), "b");
    files.commit();
    EXPECT_EQ(found().size(), 3u) << "the other's staging folder, ours and b";
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  StagingFolder::remove_left_overs(folder_);
  EXPECT_THAT(found(), testing::ElementsAre("b"));
  close(ready[0]);
  close(ready[1]);
}

TEST_F(Staging, OthersFoldersStay) {
  fs::create_directory(folder_ / ".signorini-backup");
  fs::create_directory(folder_ / ".signorini-");
  fs::create_directory_symlink(folder_ / ".signorini-backup", folder_ / ".signorini-1");
  StagingFolder::remove_left_overs(folder_);
  EXPECT_EQ(found().size(), 3u);
}

TEST_F(Staging, NothingIsStagedBeforeTheFirstFile) {
  AtomicFiles files(folder_ / "o");
  EXPECT_THAT(found(), testing::ElementsAre("o"));
  EXPECT_TRUE(fs::is_empty(folder_ / "o")) << "a kill while meshing would leave it";
  write_text(files.stage("a"), "a");
  EXPECT_FALSE(fs::is_empty(folder_ / "o"));
}

}  // namespace
}  // namespace signorini
