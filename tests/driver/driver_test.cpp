#include "driver/driver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "apps/scenes/tables.hpp"

namespace signorini::test {
namespace {

const std::string elastic = tables::block("block", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]") +
                            tables::fix("block", "top", "[0, 0, 0]") + R"(
[[fix]]
body = "block"
on = "left"
frame = "normal"
value = [0.001, "free", "free"]
)" + tables::load("block", "[0, 0, -0.02]", "right") +
                            R"(
[[obstacle]]
type = "contact"
body = "block"
where = "z < 0.001"
shape = "sphere"
center = [0.6, 0.5, -2.99]
radius = 3
[solver]
tolerance = 1e-11
[refine]
uniform = 2
)";

const std::string scalar = tables::block("membrane", "[-1, -1]", "[1, 1]", "[36, 36]", "equation = 'diffusion'\n") +
                           tables::fix("membrane", "boundary", "'0.1 * x'") + tables::load("membrane", "'-2 - x'") +
                           tables::floor("membrane", "'-0.3 + 0.1 * x^2'") +
                           "[solver]\ntolerance = 1e-11\n[refine]\nuniform = 1\n";

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "test.toml", ".", overrides);
}

template <class Shape>
Shape& shape(Driver& driver) {
  return std::get<Shape>(*driver.scene().obstacles[0].shape);
}

/// The driver's last results are those of a new driver, which has kept nothing.
void expect_as_new(Driver& kept) {
  Driver fresh(kept.scene());
  ASSERT_TRUE(kept.report().converged());
  ASSERT_TRUE(fresh.solve().converged());
  const std::vector<double>&a = kept.solution(), &b = fresh.solution();
  double size = 0, error = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    size = std::max(size, std::abs(b[k]));
    error = std::max(error, std::abs(a[k] - b[k]));
  }
  EXPECT_LT(error, 1e-8 * size);
  const StepReport &last = kept.report().last(), &expected = fresh.report().last();
  const auto expect_same = [](const std::vector<double>& found, const std::vector<double>& wanted, double unit) {
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-7 * unit);
  };
  double force = 0;
  for (const double f : expected.contact[0].force) force = std::max(force, std::abs(f));
  EXPECT_GT(force, 0);
  expect_same(last.contact[0].force, expected.contact[0].force, force);
  for (std::size_t k = 0; k < expected.reactions.size(); ++k)
    expect_same(last.reactions[k].force, expected.reactions[k].force, force);
  for (std::size_t k = 0; k < expected.applied.size(); ++k) EXPECT_EQ(last.applied[k].force, expected.applied[k].force);
  EXPECT_NEAR(last.summary.energy, expected.summary.energy, 1e-9 * std::abs(expected.summary.energy));
}

void expect_assembled(const Driver& driver, int stiffness, int load, int constraints) {
  const Assemblies& count = driver.report().time.assemblies;
  EXPECT_EQ(count.stiffness, stiffness);
  EXPECT_EQ(count.load, load);
  EXPECT_EQ(count.constraints, constraints);
}

constexpr int levels = 3;  // of the elastic scene

TEST(Driver, computes_again_only_what_changed_of_an_elastic_body) {
  Driver driver(scene_of(elastic));
  ASSERT_TRUE(driver.solve().converged());
  expect_assembled(driver, levels, levels, levels);
  expect_as_new(driver);
  {
    SCOPED_TRACE("nothing");
    const int before = driver.report().last().summary.iterations;
    driver.solve();
    expect_assembled(driver, 0, 0, 1);  // coarser meshes are not asked
    EXPECT_LT(driver.report().last().summary.iterations, before);
    expect_as_new(driver);
  }
  {
    SCOPED_TRACE("load");
    driver.scene().loads[0].value[2] = -0.05;
    driver.solve();
    expect_assembled(driver, 0, levels, levels);
    expect_as_new(driver);
  }
  {
    SCOPED_TRACE("prescribed value");
    driver.scene().fixes[1].value[0] = -0.002;
    driver.solve();
    expect_assembled(driver, 0, 0, levels);
    expect_as_new(driver);
  }
  {
    SCOPED_TRACE("material");
    driver.scene().bodies[0].young = 3;
    driver.solve();
    expect_assembled(driver, levels, 0, levels);
    expect_as_new(driver);
  }
  {
    SCOPED_TRACE("a sphere that moves turns frames, also where components are prescribed");
    shape<Scene::SphereShape>(driver).center[0] = 0.4;
    driver.solve();
    expect_assembled(driver, levels, 0, levels);
    expect_as_new(driver);
  }
  {
    SCOPED_TRACE("other components prescribed");
    driver.scene().fixes[1].value[1] = 0.001;
    driver.solve();
    expect_assembled(driver, levels, 0, levels);
    expect_as_new(driver);
  }
}

TEST(Driver, turns_the_matrix_where_no_component_is_prescribed) {
  Scene scene = scene_of(elastic);
  scene.fixes.pop_back();
  Driver driver(scene);
  driver.solve();
  for (const double center : {0.5, 0.45, 0.4}) {
    shape<Scene::SphereShape>(driver).center[0] = center;
    driver.solve();
    expect_assembled(driver, 0, 0, levels);
    expect_as_new(driver);
  }
}

// With levels chosen by the matrix below the coarsest mesh, and all of them.
TEST(Driver, computes_again_only_what_changed_of_a_scalar_body) {
  for (const std::string hierarchy : {"meshes", "matrix"}) {
    SCOPED_TRACE(hierarchy);
    Driver driver(scene_of(scalar, {"solver.hierarchy=" + hierarchy}));
    const int meshes = hierarchy == "meshes" ? 2 : 1;
    driver.solve();
    expect_assembled(driver, meshes, meshes, meshes);
    EXPECT_EQ(driver.report().time.assemblies.hierarchies, 1);
    driver.scene().obstacles[0] = scene_of(scalar, {"obstacle.0.lower=-0.2"}).obstacles[0];
    driver.solve();
    expect_assembled(driver, 0, 0, meshes);
    EXPECT_EQ(driver.report().time.assemblies.hierarchies, 0);
    expect_as_new(driver);
    driver.scene().fixes[0].value[0] = 0.05;
    driver.scene().loads[0].value[0] = -3;
    driver.solve();
    expect_assembled(driver, 0, meshes, meshes);
    expect_as_new(driver);
  }
}

// Starts without coarser meshes, active sets, and levels by the matrix of stretched cells, which may fall back to
// meshes.
TEST(Driver, keeps_matrices_with_every_method) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"solver.start=zero"},
        {"solver.start=zero", "body.0.cells=[12, 12, 12]", "refine.uniform=1"},
        {"solver.method=pdas"},
        {"body.0.cells=[12, 2, 2]", "refine.uniform=1"},
        {"body.0.cells=[12, 2, 2]", "refine.uniform=0", "solver.hierarchy=matrix"}}) {
    SCOPED_TRACE(options.front() + " " + options.back());
    Scene scene = scene_of(elastic, options);
    scene.fixes.pop_back();
    scene.obstacles[0].renew = false;  // what is tried in vain assembles, too
    Driver driver(scene);
    driver.solve();
    for (const double radius : {2.985, 2.98}) {
      shape<Scene::SphereShape>(driver).radius = radius;
      driver.solve();
      expect_assembled(driver, 0, 0, driver.report().time.assemblies.constraints);
      expect_as_new(driver);
    }
  }
}

TEST(Driver, steps_assemble_what_depends_on_t) {
  Scene scene = scene_of(elastic, {"steps.count=4", "fix.1.value=[\"0.001 * t\", \"free\", \"free\"]",
                                   "load.0.value=[0, 0, \"-0.02 * t\"]"});
  Driver driver(scene);
  driver.solve();
  expect_assembled(driver, levels, 4 * levels, 4 * levels);
  EXPECT_EQ(driver.report().steps.size(), 4u);
  Driver last(scene_of(elastic));
  last.solve();
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(driver.report().last().contact[0].force[i], last.report().last().contact[0].force[i], 1e-9);
}

TEST(Driver, starts_where_it_is_told_to) {
  Driver first(scene_of(elastic)), second(scene_of(elastic));
  first.solve();
  second.start_from(0, first.solution());
  second.solve();
  EXPECT_LT(second.report().last().summary.iterations, first.report().last().summary.iterations);
  expect_as_new(second);
  EXPECT_THROW(second.start_from(0, {1, 2, 3}), Error);
  std::vector<double> wrong = first.solution();
  wrong.back() = NAN;
  EXPECT_THROW(second.start_from(0, wrong), Error);
  EXPECT_EQ(first.points().size(), first.solution().size());
}

/// Counts cycles, on all levels.
class Counting : public Progress {
 public:
  void cycle(const IterationRecord&) const override { ++cycles; }
  mutable int cycles = 0;
};

int cycles_of_next_solve(Driver& driver, const Counting& counting) {
  counting.cycles = 0;
  EXPECT_TRUE(driver.solve().converged());
  return counting.cycles;
}

// From the last solution, where that is near; coarser meshes and levels by the matrix begin what has changed more.
TEST(Driver, StartsOnTheFinestMeshWhereLittleHasChanged) {
  for (const auto& [text, hierarchy] :
       {std::pair(elastic, "meshes"), std::pair(scalar, "meshes"), std::pair(scalar, "matrix")}) {
    SCOPED_TRACE((text == elastic ? "elastic, " : "scalar, ") + std::string(hierarchy));
    const Counting counting;
    Driver driver(scene_of(text, {std::string("solver.hierarchy=") + hierarchy}), counting);
    const int first = cycles_of_next_solve(driver, counting);
    EXPECT_EQ(cycles_of_next_solve(driver, counting), 1);
    const std::string more = text == elastic ? "[0, 0, -0.02002]" : "\"-2.002 - 1.001 * x\"";
    driver.scene().loads = scene_of(text, {"load.0.value=" + more}).loads;
    const int changed = cycles_of_next_solve(driver, counting);
    EXPECT_LT(changed, first);
    EXPECT_EQ(changed, driver.report().last().summary.iterations);
    expect_as_new(driver);
    driver.scene().loads[0].value.back() = Field(text == elastic ? -0.05 : -3.0);
    cycles_of_next_solve(driver, counting);
    expect_as_new(driver);
  }
}

TEST(Driver, SolvesAgainAfterItsMatricesAreForgotten) {
  for (const std::string& text : {elastic, scalar})
    for (const std::string hierarchy : {"meshes", "matrix"}) {
      SCOPED_TRACE((text == elastic ? "elastic, " : "scalar, ") + hierarchy);
      Driver driver(scene_of(text, {"solver.hierarchy=" + hierarchy}));
      driver.solve();
      driver.forget_matrices();
      driver.scene().loads[0].value.back() = Field(text == elastic ? -0.05 : -3.0);
      driver.solve();
      expect_as_new(driver);
    }
}

/// Ends after so many cycles.
class Impatient : public Progress {
 public:
  void cycle(const IterationRecord&) const override { --patience; }
  bool interrupted() const override { return patience <= 0; }
  mutable int patience = 3;
};

TEST(Driver, goes_on_after_it_was_ended) {
  const Impatient progress;
  Driver driver(scene_of(elastic), progress);
  try {
    driver.solve();
    FAIL() << "it was to end";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::interrupted);
  }
  progress.patience = 1000;
  driver.solve();
  expect_as_new(driver);
}

/// Says once that work is to end, in the first cycle of a given level.
class SaysSoOnce : public Progress {
 public:
  explicit SaysSoOnce(int level) : level_(level) {}
  void phase(const std::string& what) const override { level_ -= what.starts_with("level "); }
  void cycle(const IterationRecord&) const override { now_ = level_ < 0 && !std::exchange(said_, true); }
  bool interrupted() const override { return std::exchange(now_, false); }

 private:
  mutable int level_;
  mutable bool now_ = false, said_ = false;
};

TEST(Driver, EndsOnWhateverLevelItIsToldTo) {
  for (int level = 0; level < 3; ++level) {
    const SaysSoOnce progress(level);
    Driver driver(scene_of(elastic), progress);
    try {
      driver.solve();
      FAIL() << "level " << level;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::interrupted);
    }
    const bool finest = level == 2;  // which has an iterate of what was asked for
    EXPECT_EQ(driver.report().interrupted, finest) << level;
    ASSERT_EQ(driver.report().steps.size(), finest ? 1u : 0u);
    if (finest) {
      EXPECT_EQ(driver.report().last().summary.outcome, Outcome::interrupted);
      EXPECT_EQ(driver.report().last().summary.iterations, 1);
      EXPECT_FALSE(driver.report().converged());
    }
    driver.solve();
    EXPECT_FALSE(driver.report().interrupted);
    expect_as_new(driver);
  }
}

TEST(Driver, TellsWhatTheBoundaryOfAMeshIsTakenFor) {
  const std::filesystem::path scenes = std::filesystem::path(SIGNORINI_SOURCE_DIR) / "apps/scenes";
  Driver driver(read_scene(scenes / "lever.toml"));
  const Report& report = driver.solve();
  ASSERT_EQ(report.geometry.size(), 1u);
  EXPECT_EQ(report.geometry[0].body, "lever");
  EXPECT_EQ(report.geometry[0].straightened, 0);
  std::vector<double> radii;
  for (const SurfacePiece& piece : report.geometry[0].pieces)
    if (piece.kind == "circle") radii.push_back(std::round(1e6 * piece.radius) / 1e6);
  std::ranges::sort(radii);
  EXPECT_EQ(radii, (std::vector<double>{5, 9, 10}));  // hole, and the rounded ends
  const auto json = to_json(report)["geometry"][0];
  EXPECT_EQ(json["pieces"].size(), 5u);
  EXPECT_EQ(json["straightened"], 0);
  EXPECT_TRUE(to_json(Driver(scene_of(scalar)).solve())["geometry"].empty());
}

/// A change of a scene after a first solve that the next one refuses, saying so.
struct Refused {
  std::function<void(Scene&)> change;
  Exit status;
  std::vector<std::string> told;  // parts of the message
};

void expect_refused(const std::string& text, const Refused& refused) {
  SCOPED_TRACE(refused.told.back());
  Driver driver(scene_of(text));
  ASSERT_TRUE(driver.solve().converged());
  const Scene right = driver.scene();
  refused.change(driver.scene());
  try {
    driver.solve();
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), refused.status);
    for (const std::string& part : refused.told) EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
  driver.scene() = right;
  EXPECT_TRUE(driver.solve().converged());
}

// What rounding leaves of a motion deforms nothing, whatever the number that prescribes it.
TEST(Driver, moves_bodies_that_touch_nothing) {
  for (const double by : {-0.02, -0.01, -0.0625, 0.3, -1.7}) {
    SCOPED_TRACE(by);
    Driver driver(
        parse_scene(fmt::format("[[body]]\nname = 'box'\nshape = 'box'\nfrom = [-0.5, -0.5, 0]\n"
                                "to = [0.5, 0.5, 0.5]\ncells = [8, 8, 4]\norder = 1\nyoung = 1\npoisson = 0.3\n"
                                "[[fix]]\nbody = 'box'\non = 'top'\nvalue = [0, 0, {}]\n"
                                "[refine]\nuniform = 1\n",
                                by),
                    "test.toml", "."));
    const Report& report = driver.solve();
    EXPECT_TRUE(report.converged()) << report.reason();
    for (const double force : report.last().reactions[0].force) EXPECT_NEAR(force, 0, 1e-13);
  }
}

TEST(Driver, refuses_wrong_names_and_lengths_as_the_reader_does) {
  const Refused cases[] = {
      {[](Scene& s) { s.obstacles[0].body = "nobody"; }, Exit::input, {"obstacle.0.body", "no body 'nobody'"}},
      {[](Scene& s) { s.loads[0].body = "x"; }, Exit::input, {"load.0.body", "no body 'x'"}},
      {[](Scene& s) { s.fixes[1].body = "blok"; }, Exit::input, {"fix.1.body", "did you mean 'block'"}},
      {[](Scene& s) { s.obstacles[0].other = "nobody"; }, Exit::input, {"no body 'nobody'"}},
      {[](Scene& s) { s.obstacles[0].type = "contakt"; }, Exit::plugin, {"obstacle.0.type", "contakt"}},
      {[](Scene& s) { s.bodies[0].young = NAN; }, Exit::input, {"young", "body.0"}},
      {[](Scene& s) { s.probes.emplace_back(); }, Exit::input, {"no body ''"}},
      {[](Scene& s) { s.fixes[0].value.clear(); }, Exit::input, {"fix.0.value", "nothing is fixed"}},
      {[](Scene& s) { s.loads[0].value.clear(); }, Exit::input, {"load.0", "none of 'value'"}},
      {[](Scene& s) { s.loads[0].value[1] = NAN; }, Exit::input, {"load.0.value", "found nan"}},
      {[](Scene& s) { s.fixes[0].value[2] = -INFINITY; }, Exit::input, {"fix.0.value", "found -inf"}},
      {[](Scene& s) { std::get<Scene::SphereShape>(*s.obstacles[0].shape).center.pop_back(); },
       Exit::input,
       {"obstacle.0.center", "expected 3 coordinates, found 2"}},
      {[](Scene& s) { std::get<Scene::SphereShape>(*s.obstacles[0].shape).center[1] = NAN; },
       Exit::input,
       {"obstacle.0.center", "found nan"}},
      {[](Scene& s) { s.bodies.push_back(s.bodies[0]), s.bodies[1].name = "b", s.fixes[0].body = "b"; },
       Exit::usage,
       {"bodies are others (block, b)", "solved before (block)"}},
  };
  for (const Refused& refused : cases) expect_refused(elastic, refused);
}

TEST(Driver, finds_probes_that_were_added) {
  Driver driver(scene_of(elastic));
  driver.solve();
  driver.scene().probes = {{"corner", "block", {0, 0, 1}, {}}};
  EXPECT_NEAR(driver.solve().last().probes.at(0).value[2], 0, 1e-12);
  driver.scene().probes[0].at[0] = 7;
  EXPECT_THROW(driver.solve(), Error);
}

TEST(Driver, knows_no_other_bodies) {
  Driver driver(scene_of(elastic));
  EXPECT_THROW(driver.solution(), Error);  // of no solve yet
  for (const auto& ask : {std::function([&] { driver.start_from(9, {}); }), std::function([&] { driver.solution(9); }),
                          std::function([&] { driver.points(1); })})
    try {
      ask();
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::usage);
      EXPECT_THAT(error.what(), testing::HasSubstr("there is no body"));
    }
}

}  // namespace
}  // namespace signorini::test
