// `signorini plugin check` and `signorini plugin new`, as they are called.
#include "program.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class PluginCommand : public Program {
 protected:
  Ended check(const std::vector<std::string>& more, const std::string& file = SIGNORINI_FAULTY) const {
    std::vector<std::string> all{"plugin", "check", file, "--no-solves"};
    all.insert(all.end(), more.begin(), more.end());
    return signorini(all);
  }
};

TEST_F(PluginCommand, CheckEndsWellWhereAllPasses) {
  const Ended ended = check({});
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("passed: loads exports id"), HasSubstr(" checks passed, 0 failed")));
}

TEST_F(PluginCommand, CheckTellsWhatWasExpectedAndFoundWithAnExampleAndAPage) {
  const Ended ended = check({"--set", "fault=slope_of_wrong_sign"});
  EXPECT_EQ(ended.status, 5);
  EXPECT_THAT(ended.out, AllOf(HasSubstr("FAILED: slope_derivative\n"), HasSubstr("  expected: slope(x, d) is the"),
                               HasSubstr("  found: from "), HasSubstr("  example: 1 unknown per node, with fault="),
                               HasSubstr("  read: docs/plugin_check.md#change-and-slope")));
  EXPECT_THAT(ended.err, HasSubstr("the plugin does not do what is expected of it"));
  const auto json = nlohmann::json::parse(check({"--set", "fault=gradient_zero", "--json"}).out);
  EXPECT_EQ(json.at("conforms"), false);
  EXPECT_EQ(json.at("failed").at(0).at("id"), "linearise_gradient");
}

TEST_F(PluginCommand, CheckOfBadInputIsStatusTwo) {
  EXPECT_EQ(check({}, "nowhere.so").status, 2);
  const Ended wrong = check({"--set", "gap=-1"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("gap"));
  const Ended unknown = check({"--set", "gapp=1"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'gap'?"));
  EXPECT_EQ(signorini({"plugin", "check"}).status, 1);
  EXPECT_EQ(signorini({"plugin", "chek", "x"}).status, 1);
  EXPECT_THAT(signorini({"plugin", "chek", "x"}).err, HasSubstr("no command 'plugin chek', did you mean 'check'?"));
}

TEST_F(PluginCommand, NewWritesAPluginOfThatName) {
  const Ended ended = signorini({"plugin", "new", "moving_wall", "wall", "--kind", "functional"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(written("wall"),
              testing::UnorderedElementsAre("CMakeLists.txt", "README.md", "moving_wall.cpp", "moving_wall_test.cpp"));
  EXPECT_THAT(read(folder_ / "wall/moving_wall.cpp"),
              AllOf(HasSubstr("class MovingWall final : public FunctionalObstacle"),
                    HasSubstr("SIGNORINI_PLUGIN(\"moving_wall\""), testing::Not(HasSubstr("my_obstacle"))));
  EXPECT_THAT(read(folder_ / "wall/moving_wall.toml"), HasSubstr("type = \"moving_wall\""));
  EXPECT_THAT(read(folder_ / "wall/README.md"),
              AllOf(HasSubstr("ctest --test-dir build"), testing::Not(HasSubstr("@"))));
}

TEST_F(PluginCommand, NewOverwritesNothingAndTakesNamesThatAreOnes) {
  ASSERT_EQ(signorini({"plugin", "new", "wall"}).status, 0);
  const Ended again = signorini({"plugin", "new", "wall"});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("nothing was written"));
  for (const char* name : {"Wall", "1wall", "a-wall", "../wall", ""})
    EXPECT_EQ(signorini({"plugin", "new", name, "other"}).status, 1) << name;
  EXPECT_THAT(signorini({"plugin", "new", "x", "--kind", "frction"}).err, HasSubstr("did you mean 'friction'?"));
  EXPECT_FALSE(fs::exists(folder_ / "other"));
}

TEST_F(PluginCommand, HelpAndManualKnowIt) {
  EXPECT_EQ(signorini({"help", "plugin check"}).out, signorini({"plugin", "check", "--help"}).out);
  EXPECT_THAT(signorini({"help", "plugin"}).out, AllOf(HasSubstr("check"), HasSubstr("new")));
  EXPECT_THAT(signorini({"help", "--manual"}).out, HasSubstr(".B signorini plugin check [options] FILE"));
}

}  // namespace
}  // namespace signorini::test
