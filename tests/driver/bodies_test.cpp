#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "apps/scenes/tables.hpp"
#include "driver/driver.hpp"
#include "tests/support/folder.hpp"

// Bodies that are not coupled, in one scene: each has the results that it has alone, under the scene's numbers.

namespace signorini::test {
namespace {

/// The tables of a body, with those of others between them.
struct Part {
  std::string body, fix, load, obstacle, probe;
};

const Part block{tables::block("block", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]"),
                 tables::fix("block", "top", "[0, 0, -0.01]"), tables::load("block", "[0.02, 0, '0.01 * t']", "right"),
                 tables::plane("block", "bottom", "[0, 0, 0]", "[0, 0, 1]"),
                 tables::probe("corner", "block", "[1, 1, 0]")};

const Part film{
    tables::block("film", "[2, 0, 0]", "[3, 1, 1]", "[11, 10, 12]", "equation = 'diffusion'\ndiffusion = 2\n"),
    tables::fix("film", "boundary", "0"), tables::load("film", "'-20 * t'"), tables::floor("film", "-0.2"),
    tables::probe("middle", "film", "[2.5, 0.5, 0.5]")};

const Part soft{tables::block("soft", "[0, 2, 0]", "[2, 3, 1]", "[4, 2, 2]", "order = 1\nyoung = 0.1\npoisson = 0.2\n"),
                tables::fix("soft", "left", "[0, 0, 0]"), tables::load("soft", "[0, 0, -0.001]"),
                tables::plane("soft", "bottom", "[0, 0, -0.01]", "[0, 0, 1]"),
                tables::probe("end", "soft", "[2, 2, 0]")};

const std::string settings = "[refine]\nuniform = 1\n[steps]\ncount = 2\n";

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

/// The tables are interleaved: each kind in another order of the bodies.
std::string together() {
  return block.body + film.body + soft.body + soft.fix + block.fix + film.fix + film.load + soft.load + block.load +
         soft.obstacle + film.obstacle + block.obstacle + film.probe + soft.probe + block.probe + settings;
}

std::string alone(const Part& part) { return part.body + part.fix + part.load + part.obstacle + part.probe + settings; }

TEST(Bodies, have_the_results_that_each_has_alone) {
  Driver all(scene_of(together()));
  std::vector<StepReport> steps;
  ASSERT_TRUE(all.solve().converged());
  const Report& report = all.report();
  ASSERT_EQ(all.bodies(), 3u);
  ASSERT_EQ(report.steps.size(), 2u);
  const struct {
    const Part& part;
    int fix, load, obstacle, probe;
  } places[] = {{block, 1, 2, 2, 2}, {film, 2, 0, 1, 0}, {soft, 0, 1, 0, 1}};
  Index unknowns = 0;
  int iterations = 0;
  double energy = 0;
  for (std::size_t body = 0; body < 3; ++body) {
    SCOPED_TRACE(all.scene().bodies[body].name);
    const auto& [part, fix, load, obstacle, probe] = places[body];
    Driver one(scene_of(alone(part)));
    ASSERT_TRUE(one.solve().converged());
    EXPECT_EQ(all.solution(body), one.solution());
    for (std::size_t k = 0; k < 2; ++k) {
      const StepReport &found = report.steps[k], &expected = one.report().steps[k];
      EXPECT_EQ(found.reactions[fix].number, fix);
      EXPECT_EQ(found.reactions[fix].force, expected.reactions[0].force);
      EXPECT_EQ(found.applied[load].force, expected.applied[0].force);
      EXPECT_EQ(found.contact[obstacle].obstacle, obstacle);
      EXPECT_EQ(found.contact[obstacle].force, expected.contact[0].force);
      EXPECT_GT(found.contact[obstacle].nodes, 0);
      EXPECT_EQ(found.probes[probe].name, expected.probes[0].name);
      EXPECT_EQ(found.probes[probe].value, expected.probes[0].value);
      EXPECT_EQ(found.bodies[body].name, all.scene().bodies[body].name);
      EXPECT_EQ(found.bodies[body].summary.residual, expected.summary.residual);
      EXPECT_EQ(found.balance[body].sum(), expected.balance[0].sum());
    }
    const Summary& summary = one.report().last().summary;
    unknowns += summary.level_unknowns.back();
    iterations += summary.iterations;
    energy += summary.energy;
  }
  const Summary& summary = report.last().summary;
  EXPECT_EQ(summary.level_unknowns.back(), unknowns);
  EXPECT_EQ(summary.iterations, iterations);
  EXPECT_EQ(summary.history.size(), static_cast<std::size_t>(iterations));
  EXPECT_EQ(summary.history.back().iteration, iterations);
  EXPECT_DOUBLE_EQ(summary.energy, energy);
  for (const IterationRecord& record : summary.history) EXPECT_EQ(record.levels.size(), summary.level_unknowns.size());
  EXPECT_THAT(summary.reason, testing::AllOf(testing::HasSubstr("block: "), testing::HasSubstr("; soft: ")));
}

TEST(Bodies, one_that_does_not_converge_is_told_by_name) {
  Scene scene = scene_of(together());
  scene.solver.max_iterations = 2;
  scene.solver.method = "monotone";
  Driver driver(scene);
  EXPECT_FALSE(driver.solve().converged());
  const auto& bodies = driver.report().last().bodies;
  EXPECT_TRUE(std::ranges::any_of(bodies, [](const BodyReport& body) { return !body.summary.converged(); }));
}

void expect_refused(const std::string& text, const std::string& message) {
  try {
    scene_of(text);
    FAIL() << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    EXPECT_THAT(error.what(), testing::HasSubstr(message));
  }
}

TEST(Bodies, are_all_held_and_have_as_many_dimensions) {
  expect_refused(block.body + block.fix + film.body,
                 "body.1: there is neither [[fix]] nor [[spring]] nor [[obstacle]]");
  expect_refused(block.body + block.fix + tables::block("flat", "[0, 0]", "[1, 1]", "[2, 2]") +
                     tables::fix("flat", "left", "[0, 0]"),
                 "a body with 2 dimensions, expected 3 as the bodies before it");
}

/// A triangle, or a tetrahedron, as a file of Gmsh.
std::string mesh_file(int dimension) {
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 {}\n$EndNodes\n"
      "$Elements\n1\n1 {}\n$EndElements\n",
      dimension == 3 ? 1 : 0, dimension == 3 ? "4 2 1 1 1 2 3 4" : "2 2 1 1 1 2 3");
}

class BodiesOfFiles : public Folder {
 protected:
  std::string body(const char* name, int dimension) {
    const std::filesystem::path file = folder_ / (std::string(name) + ".msh");
    std::ofstream(file) << mesh_file(dimension);
    return fmt::format("[[body]]\nname = '{}'\nmesh = '{}'\nequation = 'diffusion'\n", name, file.string()) +
           tables::fix(name, "boundary", "0");
  }

  static void expect_refused(const std::string& text, const std::string& place) {
    Driver driver(scene_of(text));
    try {
      driver.solve();
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::input);
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr(place), testing::HasSubstr("expected 3 as the other "
                                                                                             "bodies have")));
    }
  }
};

TEST_F(BodiesOfFiles, have_one_dimension) {
  expect_refused(body("solid", 3) + body("flat", 2), "body.1.mesh: a mesh with 2 dimensions");
  expect_refused(body("flat", 2) + block.body + block.fix, "body.0.mesh: a mesh with 2 dimensions");
  Driver both(scene_of(body("one", 3) + body("other", 3)));
  EXPECT_TRUE(both.solve().converged());
}

}  // namespace
}  // namespace signorini::test
