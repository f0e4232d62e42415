// What the solver's work must not depend on: the fineness of the mesh; and how fast it converges in the end.
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/support/nightly.hpp"

namespace signorini::test {
namespace {

/// At most two cycles more on any of the meshes than on the first of them.
template <int D, int B>
void expect_no_growth(const std::string& scene, int from, int to) {
  int first = 0;
  for (int k = from; k <= to; ++k) {
    const auto r = run_shipped<D, B>(scene, {uniform(k)});
    show("{}, {} unknowns: {} cycles, rate {:.3f}\n", scene, r.summary().level_unknowns.back(), r.summary().iterations,
         r.summary().rate);
    if (first == 0) first = r.summary().iterations;
    EXPECT_LE(r.summary().iterations, first + 2) << scene << ", " << k << " refinements";
  }
}

TEST(Iterations, DoNotGrowWithTheMesh) {
  expect_no_growth<2, 1>("obstacle_radial_2d.toml", 3, 5);
  expect_no_growth<3, 1>("obstacle_radial_3d.toml", 1, nightly(3, 2));
  expect_no_growth<2, 1>("obstacle_spiral.toml", nightly(5, 4), nightly(7, 6));
  expect_no_growth<2, 1>("obstacle_degenerate.toml", nightly(4, 3), nightly(6, 5));
  expect_no_growth<2, 2>("signorini_elastic_2d.toml", nightly(4, 3), nightly(6, 5));
  expect_no_growth<2, 2>("cylinder_on_plane_2d.toml", 1, 3);
  expect_no_growth<3, 3>("ball_on_plane.toml", nightly(2, 1), nightly(3, 2));
}

/// The ball of the documentation.
const SceneText ball{.body = R"(
shape    = "ball"
center   = [0, 0, 0]
radius   = 1.0
size     = 0.25
order = 1
young    = 1.0
poisson  = 0.3)",
                     .fixes = {"where = \"z > 0.5\"\nvalue = [0, 0, -0.02]"},
                     .obstacle = R"(
type  = "contact"
on    = "boundary"
shape = "plane"
point = [0, 0, -1]
normal = [0, 0, 1])"};

/// V(2,2) with symmetric smoothing.
const std::vector<std::string> symmetric{"solver.smoother=symmetric", "solver.pre=2", "solver.post=2",
                                         "solver.tolerance=1e-12"};

template <int D, int B>
void expect_fast(const Scene& scene, double rate = 0.3) {
  const auto r = run<D, B>(scene);
  show("{}: {} cycles, rate {:.3f}\n", scene.title, r.summary().iterations, r.summary().rate);
  EXPECT_LE(r.summary().rate, rate);
}

std::vector<std::string> with(std::vector<std::string> settings, const std::string& more) {
  settings.push_back(more);
  return settings;
}

TEST(Iterations, AsymptoticRate) {
  expect_fast<2, 1>(read_scene(shipped_scenes / "obstacle_radial_2d.toml", symmetric));
  for (int k = 1; k <= 2; ++k)
    expect_fast<3, 3>(parse_scene(std::string(ball), "ball", ".", with(symmetric, uniform(k))));
}

// The ball takes longer alone, 0.38 to 0.46 by where its support ends; acceleration brings that below 0.3.
TEST(Iterations, AsymptoticRateWithoutAcceleration) {
  const auto alone = with(symmetric, "solver.krylov=false");
  expect_fast<2, 1>(read_scene(shipped_scenes / "obstacle_radial_2d.toml", alone));
  for (int k = 1; k <= nightly(2, 1); ++k)
    expect_fast<3, 3>(parse_scene(std::string(ball), "ball", ".", with(alone, uniform(k))), 0.5);
}

// A wavy obstacle below a mesh that is not refined: restricted bounds let contact spread slowly on aggregates.
TEST(Iterations, WithoutBoundsOnAggregates) {
  const auto r =
      run_shipped<3, 3>("cube_on_bump.toml", {"body.0.cells=[24, 24, 24]", "refine.uniform=0",
                                              "obstacle.0.distance=z + 0.02 + 0.02 * sin(20 * x) * sin(20 * y)"});
  show("{} cycles\n", r.summary().iterations);
  EXPECT_LE(r.summary().iterations, 17);
}

// Levels below a large coarsest mesh are chosen by the matrix, wherever the iteration starts.
TEST(Iterations, GoBelowTheCoarsestMeshFromAnyStart) {
  const auto levels = [](const std::string& start, int refinements) {
    const auto r = run_shipped<2, 1>("obstacle_spiral.toml",
                                     {uniform(refinements), "body.0.cells=[36, 36]", "solver.start=" + start});
    return r.summary().level_unknowns;
  };
  for (const int refinements : {0, 1, 2}) {
    const auto nested = levels("nested", refinements), zero = levels("zero", refinements);
    EXPECT_EQ(zero, nested) << refinements << " refinements";
    EXPECT_LT(zero.front(), 1000);
  }
}

// The last solution is a start, and never a bad one: the solution on coarser meshes and the change there are others.
TEST(Iterations, StepsTakeNoMoreCyclesThanFreshSolves) {
  for (const int count : {4, 16})
    for (const int refinements : {2, nightly(4, 3)}) {
      const std::vector<std::string> settings{uniform(refinements)};
      const Scene scene = shipped("disk_in_bed_steps.toml", settings);
      Registry registry = solver_components();
      load_plugins(scene, registry);
      const Progress quiet;
      Times times;
      const auto meshes = build_hierarchy<2>(scene, 2);
      NestedSolver<2, 2> steps(meshes, scene.solver, registry, quiet, times);
      std::vector<double> u;
      int all = 0, all_fresh = 0;
      for (int step = 1; step <= count; ++step) {
        const auto model = build_model<2>(scene, 2, registry, static_cast<double>(step) / count);
        NestedSolver<2, 2> alone(meshes, scene.solver, registry, quiet, times);
        const int fresh = alone.solve(model).summary.iterations;
        const auto solution = step == 1 ? steps.solve(model) : steps.solve_after(model, u);
        u = to_global(solution.discretization.problem, solution.x);
        EXPECT_TRUE(solution.summary.converged());
        EXPECT_LE(solution.summary.iterations, fresh + 1) << "step " << step << " of " << count;
        all += solution.summary.iterations;
        all_fresh += fresh;
        show("{} refinements, step {} of {}: {} cycles, {} fresh\n", refinements, step, count,
             solution.summary.iterations, fresh);
      }
      EXPECT_LE(all, all_fresh);
    }
}

/// A rectangle or a box with its lower corner in the origin.
template <int D>
std::string block(Point<D> to, int cells) {
  return D == 2 ? fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [{}, {}]\ncells = [{}, {}]\n", to[0], to[1],
                              cells, cells)
                : fmt::format("shape = \"box\"\nfrom = [0, 0, 0]\nto = [{}, {}, {}]\ncells = [{}, {}, {}]\n", to[0],
                              to[1], to[D - 1], cells, cells, cells);
}

template <int D>
int cycles_of_membrane(Point<D> size, int cells, int refinements) {
  const SceneText scene{.body = block<D>(size, cells) + "equation = \"diffusion\"",
                        .fixes = {"on = \"boundary\"\nvalue = 0"},
                        .loads = {"value = -1"},
                        .obstacle = "type = \"scalar\"\nlower = -0.03",
                        .refinements = refinements};
  return run<D, 1>(scene).summary().iterations;
}

template <int D>
int cycles_of_body(Point<D> size, int cells, int refinements) {
  const double load = -1e-4 / std::pow(size[0], 3);
  SceneText scene{.body = block<D>(size, cells) + "order = 1\nyoung = 1\npoisson = 0.3", .refinements = refinements};
  if (D == 2) {
    scene.fixes = {"on = \"top\"\nvalue = [0, 0]"};
    scene.loads = {fmt::format("value = [0, {}]", load)};
    scene.obstacle = "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]";
  } else {
    scene.fixes = {"on = \"top\"\nvalue = [0, 0, 0]"};
    scene.loads = {fmt::format("value = [0, 0, {}]", load)};
    scene.obstacle = "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]";
  }
  return run<D, D>(scene).summary().iterations;
}

// Point smoothing on nested meshes takes two to three times the cycles at 6, and from 64 on hardly converges.
TEST(Iterations, CellsThatAreStretchedTakeAtMostTwiceThoseOfCompactOnes) {
  const int plane = cycles_of_membrane<2>({1, 1}, 16, 3), space = cycles_of_membrane<3>({1, 1, 1}, 6, 2);
  const int strip = cycles_of_body<2>({1, 1}, 12, 2), bar = cycles_of_body<3>({1, 1, 1}, 7, 1);
  show("compact: {} {} {} {}\n", plane, space, strip, bar);
  for (const double a : {6, 32, 1000}) {
    const int found[] = {cycles_of_membrane<2>({a, 1}, 16, 3), cycles_of_membrane<3>({a, 1, 1}, 6, 2),
                         cycles_of_membrane<3>({2 * a, 2 * a, 1}, 6, 2)};
    for (const int cycles : found) EXPECT_LE(cycles, 2 * std::min(plane, space)) << a;
    const int elastic[] = {cycles_of_body<2>({a, 1}, 12, 2), cycles_of_body<3>({a, 1, 1}, 7, 1),
                           cycles_of_body<3>({2 * a, 2 * a, 1}, 7, 1)};
    for (const int cycles : elastic) EXPECT_LE(cycles, 2 * std::min(strip, bar)) << a;
    show("{}: {} {} {}, {} {} {}\n", a, found[0], found[1], found[2], elastic[0], elastic[1], elastic[2]);
  }
}

// Whoever asks for the meshes gets them.
TEST(Iterations, LevelsComeFromTheMatrixOnlyWhereCellsAreStretched) {
  const auto meshes = [](const std::string& body, const std::string& hierarchy) {
    const SceneText scene{.body = body + "equation = \"diffusion\"",
                          .fixes = {"on = \"boundary\"\nvalue = 0"},
                          .loads = {"value = -1"},
                          .obstacle = "type = \"scalar\"\nlower = -0.03",
                          .refinements = 2};
    return run<2, 1>(scene, {"solver.hierarchy=" + hierarchy}).summary().finest_level;
  };
  EXPECT_EQ(meshes(block<2>({1, 1}, 16), "auto"), 2);
  EXPECT_EQ(meshes(block<2>({1, 1}, 16), "matrix"), 0);
  EXPECT_EQ(meshes(block<2>({9, 1}, 16), "auto"), 0);
  EXPECT_EQ(meshes(block<2>({9, 1}, 16), "meshes"), 2);
}

}  // namespace
}  // namespace signorini::test
