#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene.hpp"
#include "scenes.hpp"

namespace signorini {
namespace {

using test::ball;
using test::membrane;
using test::parse;
using testing::HasSubstr;

TEST(Override, ReplacesAValueOfTheScene) {
  const Scene scene = parse(ball, {"solver.tolerance=1e-6", "refine.uniform=3", "title=Two words", "body.0.young=2"});
  EXPECT_EQ(scene.solver.tolerance, 1e-6);
  EXPECT_EQ(scene.refine.uniform, 3);
  EXPECT_EQ(scene.title, "Two words");
  EXPECT_EQ(scene.bodies[0].young.constant(), 2);
}

TEST(Override, CreatesKeysAndTablesThatTheSceneDoesNotHave) {
  const Scene scene = parse(membrane, {"steps.count=4", "output.vtu=false", "plugins.path=..", "title=\"7\"",
                                       "obstacle.0.upper=2", "fix.0.frame=global"});
  EXPECT_EQ(scene.steps.count(), 4);
  EXPECT_FALSE(scene.output.vtu);
  EXPECT_EQ(scene.plugin_path.at(0), "./..");
  EXPECT_EQ(scene.title, "7");
  EXPECT_EQ(std::get<std::int64_t>(scene.obstacles[0].options.find("upper")->value), 2);
}

TEST(Override, ReachesIntoLists) {
  const Scene scene = parse(ball, {"fix.0.value.2=-0.05", "fix.0.value.0=free", "obstacle.0.point=[0, 0, \"-1-t\"]"});
  EXPECT_EQ(scene.fixes[0].value[2]->constant(), -0.05);
  EXPECT_FALSE(scene.fixes[0].value[0]);
  EXPECT_EQ(std::get<Scene::PlaneShape>(*scene.obstacles[0].shape).point[2].text(), "-1-t");
}

TEST(Override, WhatIsNoTomlIsABareText) {
  const Scene scene = parse(ball, {"fix.0.where=z >= 0.5 && x == 0", "body.0.young=1 + x^2"});
  EXPECT_EQ(scene.fixes[0].on.where->text(), "z >= 0.5 && x == 0");
  EXPECT_EQ(scene.bodies[0].young.text(), "1 + x^2");
}

TEST(Override, TheLastOneCounts) { EXPECT_EQ(parse(ball, {"refine.uniform=3", "refine.uniform=1"}).refine.uniform, 1); }

TEST(Override, IsTheOriginOfItsValue) {
  const Scene scene = parse(ball, {"body.0.young=1 - x"});
  EXPECT_EQ(scene.bodies[0].source.of("young"), "--set body.0.young=1 - x");
  EXPECT_EQ(scene.bodies[0].young.origin(), "--set body.0.young=1 - x");
}

struct Wrong {
  const char* assignment;
  const char* message;
};

TEST(Override, UnknownPathsAreBadInputAsInTheScene) {
  const Wrong wrong[] = {{"refine.unifrom=3", "unknown key 'unifrom' in 'refine', did you mean 'uniform'?"},
                         {"slover.tolerance=1", "unknown table 'slover', did you mean 'solver'?"},
                         {"body.0.raduis=1", "did you mean 'radius'?"},
                         {"obstacle.1.lower=1", "index 1 is out of range: 'obstacle' has 1"},
                         {"load.7.value=1", "index 7 is out of range: 'load' has 1"},
                         {"fix.0.value.3=1", "index 3 is out of range: 'value' has 3"},
                         {"fix.first.value=1", "expected an index after 'fix', found 'first'"},
                         {"fix.-1.value=1", "expected an index"},
                         {"fix.value=1", "expected fix.INDEX.KEY=VALUE"},
                         {"solver=1", "expected solver.KEY=VALUE"},
                         {"refine.uniform.0=1", "'uniform' is no list"},
                         {"refine.uniform", "expected KEY=VALUE"},
                         {"=1", "expected KEY=VALUE"},
                         {"refine..uniform=1", "single dots"}};
  for (const Wrong& w : wrong) {
    const test::Outcome result = test::outcome([&] { parse(ball, {w.assignment}); });
    EXPECT_EQ(result.status, Exit::input) << w.assignment;
    EXPECT_THAT(result.message, HasSubstr(w.message));
    EXPECT_THAT(result.message, HasSubstr(std::string("--set ") + w.assignment));
  }
}

TEST(Override, WrongValuesAreBadInput) {
  const Wrong wrong[] = {{"refine.uniform=-1", "found -1"},
                         {"refine.uniform=many", "found the text 'many'"},
                         {"refine.uniform=", "found the text ''"},
                         {"body.0.young=inf", "finite"},
                         {"body.0.young={a=1}", "a table cannot stand here"},
                         {"body.0.shape=cube", "unknown shape 'cube'"},
                         {"refine.uniform=1\nsolver.pre=3", "whole number"},
                         {"fix.0.value=[0, 0]", "expected 3 components, found 2"}};
  for (const Wrong& w : wrong) {
    const test::Outcome result = test::outcome([&] { parse(ball, {w.assignment}); });
    EXPECT_EQ(result.status, Exit::input) << w.assignment;
    EXPECT_THAT(result.message, HasSubstr(w.message));
    EXPECT_THAT(result.message, HasSubstr("--set "));
  }
}

}  // namespace
}  // namespace signorini
