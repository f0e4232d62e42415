// Coefficients and meshes that are hard on a solver: it may take longer, but must not fail.
#include "core/mesh/structured.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

/// Solved, or as near as rounding allows, and the same as by a direct solver to `tolerance` in the energy norm.
template <int D, int B>
void expect_solved(const std::string& scene, std::vector<std::string> settings = {}, double tolerance = 1e-7) {
  const auto r = run<D, B>(scene, settings);
  const Reference exact = reference(r.problem());
  const double size = energy_norm(r.problem().A, exact.x);
  const double error = energy_norm<B>(r.problem().A, vector(r.solution.x) - exact.x);
  EXPECT_LE(error, tolerance * size);
  EXPECT_GT(exact.active(), 0);
  show("{}: {} cycles, error {:.1e}, {}\n", testing::UnitTest::GetInstance()->current_test_info()->name(),
       r.summary().iterations, error / size, r.summary().reason);
}

/// Point smoothing and isotropic coarsening converge slowly where couplings are strong in one direction only: these
/// need more cycles than the default limit of 200.
const std::vector<std::string> patient{"solver.max_iterations=5000"};

SceneText membrane(const std::string& diffusion, double width, const std::string& lower) {
  return {.body = fmt::format(R"(
shape = "rectangle"
from = [0, 0]
to = [{:.17g}, 1]
cells = [4, 4]
equation = "diffusion"
diffusion = "{}")",
                              width, diffusion),
          .fixes = {"on = \"boundary\"\nvalue = [0]"},
          .loads = {fmt::format("value = ['-10*({})']", diffusion)},
          .obstacle = fmt::format("type = \"scalar\"\nlower = \"{}\"", lower),
          .refinements = 4};
}

TEST(Robustness, JumpsOfTheDiffusion) {
  for (const char* jump : {"x < 0.5 ? 1 : 1e6", "x < 0.5 ? 1e6 : 1", "(x < 0.4) == (y < 0.3) ? 1e6 : 1",
                           "abs(x - 0.5) < 0.07 ? 1e-6 : 1"}) {
    SCOPED_TRACE(jump);
    expect_solved<2, 1>(membrane(jump, 1, "-0.1 + 0.1*sin(5*x)*y"));
  }
}

TEST(Robustness, CellsStretchedByAHundred) {
  expect_solved<2, 1>(membrane("1", 100, "-0.4 - 0.1*sin(x/5)"));
  expect_solved<2, 1>(membrane("1", 0.01, "-1e-4 + 0.5e-4*sin(5*y)"), patient);
}

SceneText block(const std::string& shape, const std::string& young, double poisson, int refinements) {
  return {.body = fmt::format("{}\norder = 1\nyoung = \"{}\"\npoisson = {}", shape, young, poisson),
          .fixes = {"on = \"top\"\nvalue = [0, 0, -0.02]"},
          .obstacle = R"(
type = "contact"
on = "bottom"
shape = "sphere"
center = [0.4, 0.6, -2]
radius = 2)",
          .refinements = refinements};
}

constexpr const char* cube = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [2, 2, 2]";

TEST(Robustness, JumpsOfTheModulus) {
  expect_solved<3, 3>(block(cube, "z < 0.5 ? 1 : 1e6", 0.3, nightly(2, 1)));
  expect_solved<3, 3>(block(cube, "(x < 0.5) == (y < 0.5) ? 1e6 : 1", 0.3, nightly(2, 1)));
  // A stiff lower half that hangs on a soft one.
  expect_solved<3, 3>(block(cube, "z < 0.5 ? 1e6 : 1", 0.3, 2), patient);
}

TEST(Robustness, NearlyIncompressible) { expect_solved<3, 3>(block(cube, "1", 0.499, 1), {"body.0.order=auto"}); }

TEST(Robustness, SaysThatLinearElementsLock) {
  const auto warnings = [](double poisson) {
    const Scene scene = parse_scene(std::string(block(cube, "1", poisson, 0)), "test.toml", ".", {{"body.0.order=1"}});
    return scene_warnings(scene, build_hierarchy<3>(scene, 3).levels.front());
  };
  ASSERT_EQ(warnings(0.499).size(), 1u);
  EXPECT_NE(warnings(0.499)[0].text.find("too stiff"), std::string::npos);
  EXPECT_TRUE(warnings(0.3).empty());
}

TEST(Robustness, ElasticCellsStretchedByAHundred) {
  expect_solved<3, 3>(block("shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 0.01]\ncells = [2, 2, 2]", "1", 0.3, 2));
  // A thin wall, held at its upper edge, on the sphere: bending of slender linear elements.
  expect_solved<3, 3>(block("shape = \"box\"\nfrom = [0.4, 0, 0]\nto = [0.41, 1, 1]\ncells = [2, 2, 2]", "1", 0.3, 1),
                      patient);
}

/// A tolerance that rounding forbids ends the iteration as solved, not at the limit.
TEST(Robustness, StopsWhereRoundingDoes) {
  const std::vector<std::string> settings{"solver.tolerance=1e-15", uniform(3)};
  for (const char* scene : {"obstacle_radial_2d.toml", "obstacle_degenerate.toml", "obstacle_torsion_disk.toml"})
    EXPECT_LE((run_shipped<2, 1>(scene, settings).summary().iterations), 30) << scene;
  EXPECT_LE((run_shipped<2, 2>("cylinder_on_plane_2d.toml", settings).summary().iterations), 40);
  EXPECT_LE((run_shipped<3, 3>("punch.toml", settings).summary().iterations), 20);
}

/// The block's coarse mesh with a vertex inside that comes as near to the next one as `thin` times the mesh width, and
/// the same with all vertices of a plane, which makes a layer of thin cells.
Mesh<3> needles(double thin, bool layer) {
  Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  const auto third = [](double v) { return v > 0.3 && v < 0.4; };
  for (Point<3>& x : mesh.points)
    if (third(x[0]) && (layer || (third(x[1]) && third(x[2])))) x[0] = 2.0 / 3 - thin / 3;
  return mesh;
}

TEST(Robustness, NeedleElements) {
  const TemporaryFolder folder;
  for (const double thin : {1e-2, 1e-4, 1e-6}) {
    SCOPED_TRACE(thin);
    const std::string file = folder.write("needles.msh", msh(needles(thin, false)));
    expect_solved<3, 3>(block(fmt::format("mesh = \"{}\"", file), "1", 0.3, 1), patient, 1e-6);
  }
}

TEST(Robustness, LayerOfThinCells) {
  const TemporaryFolder folder;
  for (const double thin : {1e-2, 1e-3}) {
    SCOPED_TRACE(thin);
    const std::string file = folder.write("layer.msh", msh(needles(thin, true)));
    expect_solved<3, 3>(block(fmt::format("mesh = \"{}\"", file), "1", 0.3, 1), patient, 1e-6);
  }
}

}  // namespace
}  // namespace signorini::test
