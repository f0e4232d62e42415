// What the solver's work must not depend on: the fineness of the mesh; and how fast it converges in the end.
#include "run.hpp"

namespace signorini::test {
namespace {

/// Cycles on the three finest meshes: at most two more than on the coarsest of them.
template <int D, int B>
void expect_no_growth(const std::string& scene, int refinements) {
  int first = 0;
  for (int k = refinements - 2; k <= refinements; ++k) {
    const auto r = run_shipped<D, B>(scene, {uniform(k)});
    show("{}, {} unknowns: {} cycles, rate {:.3f}\n", scene, r.summary().level_unknowns.back(), r.summary().iterations,
         r.summary().rate);
    if (first == 0) first = r.summary().iterations;
    EXPECT_LE(r.summary().iterations, first + 2) << scene << ", " << k << " refinements";
  }
}

TEST(Iterations, DoNotGrowWithTheMesh) {
  expect_no_growth<2, 1>("obstacle_radial_2d.toml", 5);
  expect_no_growth<3, 1>("obstacle_radial_3d.toml", 3);
  expect_no_growth<2, 1>("obstacle_spiral.toml", 7);
  expect_no_growth<2, 1>("obstacle_degenerate.toml", 6);
  expect_no_growth<2, 2>("signorini_elastic_2d.toml", 6);
  expect_no_growth<2, 2>("cylinder_on_plane_2d.toml", 3);
  expect_no_growth<3, 3>("ball_on_plane.toml", 3);
}

/// The ball of the documentation.
constexpr const char* ball = R"(
title = "Ball pressed on a plane"
[[body]]
name     = "ball"
shape    = "ball"
center   = [0, 0, 0]
radius   = 1.0
size     = 0.25
young    = 1.0
poisson  = 0.3
[[fix]]
body  = "ball"
where = "z > 0.5"
value = [0, 0, -0.02]
[[obstacle]]
type  = "contact"
body  = "ball"
on    = "boundary"
shape = "plane"
point = [0, 0, -1]
normal = [0, 0, 1]
)";

/// The cycle alone, V(2,2) with symmetric smoothing.
const std::vector<std::string> symmetric{"solver.smoother=symmetric", "solver.pre=2", "solver.post=2",
                                         "solver.krylov=false", "solver.tolerance=1e-12"};

TEST(Iterations, AsymptoticRateOfTheRadialProblem) {
  const auto r = run_shipped<2, 1>("obstacle_radial_2d.toml", symmetric);
  show("radial: {} cycles, rate {:.3f}\n", r.summary().iterations, r.summary().rate);
  EXPECT_LE(r.summary().rate, 0.3);
}

TEST(Iterations, AsymptoticRateOfTheBall) {
  for (int k = 1; k <= 2; ++k) {
    auto settings = symmetric;
    settings.push_back(uniform(k));
    const auto r = run<3, 3>(ball, settings);
    show("ball: {} cycles, rate {:.3f}\n", r.summary().iterations, r.summary().rate);
    EXPECT_LE(r.summary().rate, 0.3);
  }
}

}  // namespace
}  // namespace signorini::test
