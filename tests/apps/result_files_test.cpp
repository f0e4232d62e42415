// Where results are written, and what is left where they cannot be.
#include "program.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

namespace signorini::test {
namespace {
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class ResultFiles : public Program {};

TEST_F(ResultFiles, UnwritableFolderIsBadInputBeforeAnythingIsSolved) {
  write("membrane.toml", membrane);
  write("file", "");
  for (const char* folder : {"file", "file/below", "/proc/nowhere"}) {
    const Ended ended = signorini({"solve", "membrane.toml", "--out", folder});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr(folder));
  }
  EXPECT_THAT(written(), testing::ElementsAre("file"));
}

TEST_F(ResultFiles, ResultsReplaceNoInputsAndNothingThatIsReadOnly) {
  write("membrane.toml", membrane);
  fs::create_directory(folder_ / "o");
  write("o/report.json", "old");
  fs::permissions(folder_ / "o/report.json", fs::perms::owner_read);
  Ended ended = signorini({"solve", "membrane.toml", "--out", "o"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("o/report.json: is read-only"));
  fs::rename(folder_ / "membrane.toml", folder_ / "o/solution_001.vtu");  // any name does for a scene
  fs::permissions(folder_ / "o/report.json", fs::perms::owner_write, fs::perm_options::add);
  ended = signorini({"solve", "o/solution_001.vtu", "--out", "o"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("o/solution_001.vtu: is read by this run"));
  EXPECT_EQ(read(folder_ / "o/solution_001.vtu"), membrane);
  fs::permissions(folder_ / "o", fs::perms::owner_read | fs::perms::owner_exec);
  ended = signorini({"solve", "o/solution_001.vtu", "--out", "o"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("o: cannot write results here: Permission denied"));
  fs::permissions(folder_ / "o", fs::perms::owner_all);
}

TEST_F(ResultFiles, OutputThatCannotBePrintedIsAnError) {
  write("membrane.toml", membrane);
  const std::string program = "cd '" + folder_.string() + "' && " SIGNORINI_BINARY_DIR "/bin/signorini ";
  for (const char* arguments : {"check membrane.toml", "list", "--help"}) {
    const int status = std::system((program + arguments + " > /dev/full 2> .err").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << arguments;
    EXPECT_THAT(read(folder_ / ".err"), StartsWith("signorini: error: standard output: cannot be written"));
  }
}

TEST_F(ResultFiles, ResultsThatAreWrittenKeepTheirStatusWhereNothingCanBePrinted) {
  write("membrane.toml", membrane);
  const std::string program = "cd '" + folder_.string() + "' && " SIGNORINI_BINARY_DIR "/bin/signorini ";
  struct {
    const char* options;
    int status;
  } cases[] = {{"", 0}, {" --set solver.max_iterations=1 --set solver.start=zero", 3}, {" --set refine.uniform=1", 0}};
  for (const auto& [options, expected] : cases) {
    const int status = std::system((program + "solve membrane.toml" + options + " > /dev/full 2> .err").c_str());
    EXPECT_EQ(WEXITSTATUS(status), expected) << options;
    EXPECT_THAT(read(folder_ / ".err"), StartsWith("signorini: warning: standard output: cannot be written"));
    EXPECT_THAT(written("membrane"), testing::Contains("report.json"));
    fs::remove_all(folder_ / "membrane");
  }
}

// As with `ulimit -f`.
class LargestFile {
 public:
  explicit LargestFile(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~LargestFile() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(ResultFiles, AFileThatMayNotGrowIsAFullDisk) {
  write("membrane.toml", membrane);
  pid_t child = 0;
  {
    const LargestFile limit(2000);
    child = start("signorini", {"solve", "membrane.toml", "--out", "o"});
  }
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 2) << ended.err;
  EXPECT_THAT(ended.err, AllOf(StartsWith("signorini: error: "), HasSubstr("cannot be written: File too large")));
  EXPECT_THAT(written(), IsEmpty());
}

TEST_F(ResultFiles, APictureThatCannotBeWrittenIsMissingAlone) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  const auto size = [&](const char* name) { return fs::file_size(folder_ / "o" / name); };
  const auto enough =
      std::max({size("report.json"), size("solution.vtu"), size("convergence.csv"), size("phases.csv")});
  ASSERT_GT(size("result.png"), enough + 1000);
  pid_t child = 0;
  {
    const LargestFile limit(enough + 1000);
    child = start("signorini", {"solve", "membrane.toml", "--out", "p"});
  }
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("warning: a picture is missing: result.png: cannot be written: File too large"));
  EXPECT_THAT(report("p").at("warnings").dump(), HasSubstr("a picture is missing: result.png"));
  EXPECT_THAT(written("p"), testing::IsSupersetOf({"report.json", "solution.vtu", "convergence.csv"}));
  EXPECT_THAT(written("p"), testing::Not(testing::Contains("result.png")));
}

// Results beside which there is no place for pictures, on a file system of its own.
TEST_F(ResultFiles, PicturesDoNotTakeThePlaceOfResults) {
  if (std::system("unshare -rm mount -t tmpfs tmpfs /mnt > /dev/null 2>&1") != 0) GTEST_SKIP() << "mounts nothing";
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  const auto pages = [&](const char* name) {
    return static_cast<long>(fs::file_size(folder_ / "o" / name) / 4096) + 1;
  };
  const long results = pages("report.json") + pages("solution.vtu") + pages("convergence.csv") + pages("phases.csv");
  const long pictures = pages("result.png") + pages("convergence.png");
  fs::create_directory(folder_ / "disk");
  fs::create_directory(folder_ / "copy");
  const std::string program = SIGNORINI_BINARY_DIR "/bin/signorini";
  // Times and warnings make one run's report longer or shorter than another's: by a page where it is near its end.
  for (const long more : {2L, 3L, pictures - pages("result.png") / 2, pictures - 2}) {
    const std::string size = std::to_string(4 * (results + more)) + "k";
    const std::string inside = "mount -t tmpfs -o size=" + size + " tmpfs disk && " + program +
                               " solve membrane.toml --out disk/p 2> .err && cp -r disk/p copy/" + std::to_string(more);
    ASSERT_EQ(std::system(("cd '" + folder_.string() + "' && unshare -rm sh -c '" + inside + "' > .out").c_str()), 0)
        << more << read(folder_ / ".err");
    EXPECT_THAT(read(folder_ / ".err"), HasSubstr("a picture is missing: ")) << more;
    const std::string copy = "copy/" + std::to_string(more);
    EXPECT_THAT(report(copy).at("warnings").dump(), HasSubstr("a picture is missing: ")) << more;
    EXPECT_THAT(written(copy), testing::IsSupersetOf({"report.json", "solution.vtu", "convergence.csv"})) << more;
  }
}

}  // namespace
}  // namespace signorini::test
