// What the program says of a plugin that fails in a solve.
#include "program.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FailingPlugin : public Program {
 protected:
  /// A membrane with the plugin `misbehaving`, told how.
  void write_scene(const std::string& way) const {
    std::string scene = membrane;
    const std::string obstacle = "type = \"scalar\"", bound = "lower = \"0.5 - x^2 - y^2\"";
    scene.replace(scene.find(obstacle), obstacle.size(), "type = \"misbehaving\"");
    scene.replace(scene.find(bound), bound.size(), "way = \"" + way + "\"");
    write("scene.toml", scene + "[plugins]\npath = \"" SIGNORINI_FIXTURES "\"\n");
  }

  Ended solve(const std::string& way) const {
    write_scene(way);
    const Ended ended = signorini({"solve", "scene.toml", "--quiet"});
    EXPECT_EQ(ended.status == 0, fs::exists(folder_ / "scene" / "report.json")) << way << ": " << ended.err;
    return ended;
  }
};

TEST_F(FailingPlugin, TheOneThatBehavesIsSolved) {
  const Ended ended = solve("behave");
  EXPECT_EQ(ended.status, 0) << ended.err;
}

TEST_F(FailingPlugin, AnExitIsNoSuccess) {
  const Ended ended = solve("exit");
  EXPECT_EQ(ended.status, 5);
  EXPECT_THAT(ended.err, HasSubstr("libsignorini_obstacle_misbehaving.so"));
  EXPECT_TRUE(fs::is_empty(folder_ / "scene"));
}

TEST_F(FailingPlugin, OneThatHangsEndsWithTheFirstSignal) {
  write_scene("hang");
  const pid_t child = start("signorini", {"solve", "scene.toml", "--quiet"});
  wait_until(child, [&] { return fs::exists(folder_ / "scene"); });  // all that is left to do is to assemble
  usleep(200000);
  kill(child, SIGTERM);
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("this plugin does not return: "), HasSubstr("obstacle_misbehaving.so")));
  EXPECT_THAT(written(), testing::IsEmpty());
}

TEST_F(FailingPlugin, OneThatHangsWhileItIsLoadedEndsWithTheFirstSignal) {
  setenv("SIGNORINI_PLUGIN_PATH", SIGNORINI_FIXTURES "/hanging", 1);
  const pid_t child = start("signorini", {"list", "obstacles"});
  unsetenv("SIGNORINI_PLUGIN_PATH");
  usleep(200000);
  kill(child, SIGINT);
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("interrupted"));
}

TEST_F(FailingPlugin, WhatAConstructorThrowsIsToldWithPlaceFileAndName) {
  const Ended ended = solve("throw_number");
  EXPECT_EQ(ended.status, 5);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("scene.toml:"), HasSubstr("libsignorini_obstacle_misbehaving.so"),
                               HasSubstr("the constructor of 'misbehaving' failed: an exception of unknown type")));
}

TEST_F(FailingPlugin, OptionsThatItsTableDoesNotHaveAreToldBeforeWhatTheyLeadTo) {
  for (const std::string way : {"misspell_has", "misspell_throw"}) {
    const Ended ended = solve(way);
    EXPECT_EQ(ended.status, 5) << way;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("scene.toml:"), HasSubstr("'gapp'"), HasSubstr("did you mean 'gap'?")));
  }
}

TEST_F(FailingPlugin, OptionsOfAnotherTypeAreToldAlsoWhereTheSceneDoesNotGiveThem) {
  for (const std::string way : {"wrong_type", "wrong_type_later"}) {
    const Ended ended = solve(way);
    EXPECT_EQ(ended.status, 5) << way;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("scene.toml:"), HasSubstr("'gap' as if it were of another type")));
  }
}

}  // namespace
}  // namespace signorini::test
