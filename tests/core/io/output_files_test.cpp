#include "core/io/output_files.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "tests/core/mesh/mesh_checks.hpp"
#include "tests/support/folder.hpp"

namespace signorini {
namespace {
namespace fs = std::filesystem;
using test::input_error_of;
using testing::HasSubstr;

class Outputs : public test::Folder {
 protected:
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  void put(const fs::path& file, const std::string& text) const {
    OutputFiles files({});
    ASSERT_TRUE(files.add(file));
    files.write(file, text);
    files.commit();
  }
};

TEST_F(Outputs, LinksAreFollowedAlsoToNowhere) {
  fs::create_directories(folder_ / "far");
  std::ofstream(folder_ / "far/old") << "old";
  fs::permissions(folder_ / "far/old", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("far/old", folder_ / "middle");
  fs::create_symlink("middle", folder_ / "link");
  fs::create_symlink("far/new", folder_ / "nowhere");
  for (const char* name : {"link", "nowhere"}) {
    put(folder_ / name, "text");
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
    EXPECT_EQ(read(name), "text");
  }
  EXPECT_EQ(read("far/old"), "text");
  EXPECT_EQ(fs::status(folder_ / "far/old").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "far"), {}), 2);
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THAT(input_error_of([&] { put(folder_ / "circle", ""); }), HasSubstr("circle: cannot be written"));
}

TEST_F(Outputs, DevicesAndPipesAreWrittenThrough) {
  put("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const int reader = open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  put(folder_ / "pipe", "through");
  char text[16] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 7);
  EXPECT_STREQ(text, "through");
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
  close(reader);
}

TEST_F(Outputs, AFullDeviceIsAnErrorAndLeavesTheOtherFilesAsTheyWere) {
  std::ofstream(folder_ / "a") << "old";
  OutputFiles files({});
  ASSERT_TRUE(files.add(folder_ / "a"));
  ASSERT_TRUE(files.add("/dev/full"));
  files.write(folder_ / "a", "new");
  files.write("/dev/full", "text");
  EXPECT_THAT(input_error_of([&] { files.commit(); }),
              HasSubstr("/dev/full: cannot be written: No space left on device"));
  EXPECT_EQ(read("a"), "old");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Outputs, ReadOnlyFilesFoldersAndInputsAreRefused) {
  std::ofstream(folder_ / "a") << "a";
  fs::create_hard_link(folder_ / "a", folder_ / "twin");
  fs::create_symlink("a", folder_ / "link");
  for (const char* name : {"a", "twin", "link"}) {
    OutputFiles files({"", folder_ / "a"});
    EXPECT_THAT(input_error_of([&] { files.add(folder_ / name); }), HasSubstr("is read by this run")) << name;
  }
  fs::permissions(folder_ / "a", fs::perms::owner_read);
  for (const char* name : {"a", "link"})
    EXPECT_THAT(input_error_of([&] { put(folder_ / name, "b"); }), HasSubstr("is read-only")) << name;
  EXPECT_EQ(read("a"), "a");
  EXPECT_THAT(input_error_of([&] { put(folder_, "b"); }), HasSubstr("is a folder"));
  fs::create_directory(folder_ / "shut");
  fs::permissions(folder_ / "shut", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(input_error_of([&] { put(folder_ / "shut/a", "b"); }), HasSubstr("shut: cannot write results here"));
}

TEST_F(Outputs, TwoNamesOfOneFileAreSeen) {
  std::ofstream(folder_ / "a") << "a";
  fs::create_symlink("a", folder_ / "link");
  for (const char* other : {"a", "./a", "link"}) {
    OutputFiles files({});
    EXPECT_TRUE(files.add(folder_ / "a"));
    EXPECT_FALSE(files.add(folder_ / other)) << other;
  }
  OutputFiles files({});
  EXPECT_TRUE(files.add("/dev/null"));
  EXPECT_TRUE(files.add("/dev/null")) << "which holds nothing";
}

TEST_F(Outputs, FilesOfARunsOwnNamesAreRefusedWhereTheyCannotBeReplaced) {
  const auto ours = [](const std::string& name) { return name == "report.json"; };
  std::ofstream(folder_ / "mesh") << "";
  fs::create_symlink("mesh", folder_ / "report.json");
  EXPECT_THAT(input_error_of([&] { AtomicFiles files(folder_, ours); }), HasSubstr("report.json: is a folder, a link"));
  EXPECT_NO_THROW(AtomicFiles files(folder_)) << "not this run's";
  fs::rename(folder_ / "mesh", folder_ / "report.json");
  EXPECT_NO_THROW(AtomicFiles files(folder_, ours));
  const std::vector<fs::path> inputs{folder_ / "report.json"};
  EXPECT_THAT(input_error_of([&] { AtomicFiles files(folder_, ours, inputs); }), HasSubstr("is read by this run"));
}

}  // namespace
}  // namespace signorini
