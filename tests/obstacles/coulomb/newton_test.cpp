// Friction by multigrid against a semismooth Newton method with a direct solver, which shares neither sweeps nor the
// local problem with it: the same sets of what sticks and slips, and the same displacements.
#include <array>
#include <filesystem>
#include <fstream>
#include <map>

#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

constexpr const char* plane2 = "on = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n";
constexpr const char* plane3 = "on = \"bottom\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";

std::string coulomb(const std::string& where, const std::string& friction) {
  return where + "type = \"coulomb\"\nfriction = " + friction;
}

SceneText block2(const std::string& obstacle, int refinements) {
  return {
      .body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0.01, -0.03]"},
      .obstacle = obstacle,
      .refinements = refinements};
}

SceneText block3(const std::string& obstacle, int refinements) {
  return {
      .body =
          "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [2, 1, 1]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0.01, 0.005, -0.03]"},
      .obstacle = obstacle,
      .refinements = refinements};
}

enum class State { open, sticks, slips };

template <int D, int B>
std::map<Index, State> states(const Run<D, B>& run) {
  std::map<Index, State> out;
  for (const ContactNode<B>& node : run.results.contact.nodes)
    out[node.vertex] = !node.contact ? State::open : node.sticks ? State::sticks : State::slips;
  return out;
}

/// @param states_met which have to occur
template <int D>
void expect_like_newton(const std::string& scene, std::initializer_list<State> states_met) {
  const auto newton = run<D, D>(scene, {"solver.method=newton", "solver.tolerance=1e-12"});
  const auto cycles = run<D, D>(scene, {"solver.tolerance=1e-11"});
  EXPECT_EQ(states(newton), states(cycles));
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < newton.u().size(); ++i) {
    largest = std::max(largest, std::abs(newton.u()[i]));
    apart = std::max(apart, std::abs(newton.u()[i] - cycles.u()[i]));
  }
  EXPECT_LE(apart, 1e-7 * largest);
  for (const State wanted : states_met)
    EXPECT_TRUE(std::ranges::any_of(states(newton), [&](const auto& s) { return s.second == wanted; }))
        << "a state that does not occur: no test";
  show("{} and {} iterations, apart {:.1e}\n", newton.summary().iterations, cycles.summary().iterations,
       apart / largest);
}

TEST(Newton, FrictionInThePlane) {
  expect_like_newton<2>(block2(coulomb(plane2, "0.3"), 3), {State::sticks, State::slips});
  expect_like_newton<2>(block2(coulomb(plane2, "\"0.1 + 0.4*x\""), 3), {State::sticks, State::slips});
  SceneText round = block2(coulomb("on = \"bottom\"\nshape = \"sphere\"\ncenter = [0.8, -3]\nradius = 3\n", "0.2"), 3);
  round.fixes = {"on = \"top\"\nvalue = [0.004, -0.03]"};
  expect_like_newton<2>(round, {State::open, State::sticks, State::slips});
  SceneText soft = block2(coulomb(plane2, "1"), 3);
  soft.body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = 1\nyoung = 1\npoisson = 0.45";
  soft.fixes = {"on = \"top\"\nvalue = [0.05, -0.02]"};
  expect_like_newton<2>(soft, {State::sticks, State::slips});
  SceneText pressed = block2(coulomb(plane2, "0.5"), 3);
  pressed.fixes = {"on = \"left\"\nvalue = [0, \"free\"]"};
  pressed.loads = {"on = \"top\"\nvalue = [0.002, -0.02]"};
  expect_like_newton<2>(pressed, {State::sticks, State::slips});
}

TEST(Newton, FrictionInSpace) {
  expect_like_newton<3>(block3(coulomb(plane3, "0.3"), 2), {State::sticks, State::slips});
  expect_like_newton<3>(block3(coulomb(plane3, "\"0.1 + 0.3*y\""), 2), {State::sticks, State::slips});
  SceneText round =
      block3(coulomb("on = \"bottom\"\nshape = \"sphere\"\ncenter = [0.8, 0.4, -3]\nradius = 3\n", "0.2"), 2);
  round.fixes = {"on = \"top\"\nvalue = [0.004, 0.002, -0.03]"};
  expect_like_newton<3>(round, {State::open, State::sticks, State::slips});
  SceneText guided = block3(coulomb(plane3, "0.4"), 2);
  guided.fixes.push_back("on = \"left\"\nvalue = [0.01, \"free\", \"free\"]");
  expect_like_newton<3>(guided, {State::slips});
  SceneText tresca = block3(std::string(plane3) + "type = \"tresca\"\nbound = 0.008", 2);
  expect_like_newton<3>(tresca, {State::sticks, State::slips});
}

// 26 928 unknowns are more than are factorised in space.
TEST(Newton, GoesOnByMultigridWhereFactorisationsAreDear) {
  const SceneText scene = block3(coulomb(plane3, "0.3"), 4);
  const auto newton = run<3, 3>(scene, {"solver.method=newton"});
  EXPECT_EQ(newton.summary().stages.back().linear, "multigrid");
  EXPECT_LE(newton.summary().iterations, 20);
  expect_like_newton<3>(scene, {State::sticks, State::slips});
}

/// The smallest and largest coordinates of a surface file.
std::array<Point<3>, 2> extent(const std::filesystem::path& file) {
  std::array<Point<3>, 2> out{Point<3>{infinity, infinity, infinity}, Point<3>{-infinity, -infinity, -infinity}};
  std::ifstream stream(file);
  Point<3> p;
  for (std::string line; std::getline(stream, line);)
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3)
      for (std::size_t i = 0; i < 3; ++i) {
        out[0][i] = std::min(out[0][i], p[i]);
        out[1][i] = std::max(out[1][i], p[i]);
      }
  return out;
}

// Held at its upper quarter, which goes down and aside, pressed on a plane that is inside it by a hundredth.
TEST(Newton, RealSolids) {
  const char* folder = std::getenv("SIGNORINI_MESHES");
  if (!folder) GTEST_SKIP() << "SIGNORINI_MESHES does not name a folder with spot.obj and fandisk.obj";
  for (const char* name : {"spot.obj", "fandisk.obj"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
    const auto [low, high] = extent(file);
    const double height = high[1] - low[1], size = 0.07 * std::hypot(high[0] - low[0], height, high[2] - low[2]);
    expect_like_newton<3>(
        SceneText{
            .body = fmt::format("shape = \"solid\"\nfile = \"{}\"\nsize = {}\norder = 1\nyoung = 1\npoisson = 0.3",
                                file.string(), size),
            .fixes = {fmt::format("where = \"y > {}\"\nvalue = [{}, {}, {}]", high[1] - 0.25 * height, 0.01 * height,
                                  -0.01 * height, 0.005 * height)},
            .obstacle = coulomb(fmt::format("on = \"boundary\"\nshape = \"plane\"\npoint = [0, {}, 0]\n"
                                            "normal = [0, 1, 0]\n",
                                            low[1] + 0.01 * height),
                                "0.4")},
        {State::open, State::slips});
  }
}

}  // namespace
}  // namespace signorini::test
