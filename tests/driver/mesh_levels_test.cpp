// Levels come, go and are replaced while a solver lives, which knows the last step as before.
#include "driver/levels/mesh_levels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "amg/registration.hpp"
#include "apps/scenes/tables.hpp"
#include "core/mesh/refine.hpp"
#include "core/solver/local_coordinates.hpp"
#include "driver/components.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "tests/support/on_mesh.hpp"

namespace signorini::test {
namespace {

/// A block that is pressed down, and then slides with friction.
const char* const sliding = R"toml(
[[body]]
name = "block"
shape = "rectangle"
from = [0, 0]
to = [2, 1]
cells = [4, 2]
young = 1
poisson = 0.3
order = 1
[[fix]]
body = "block"
on = "top"
value = ["0.02*max(0, 2*t - 1)", "-0.01*min(1, 2*t)"]
[[obstacle]]
type = "coulomb"
friction = 0.3
body = "block"
on = "bottom"
shape = "plane"
point = [0, 0]
normal = [0, 1]
[refine]
uniform = 3
[steps]
count = 2
)toml";

class Levels : public ::testing::Test {
 protected:
  Levels() : scene_(parse_scene(sliding, "test.toml", ".", {})) {
    load_plugins(scene_, registry_);
    meshes_ = build_hierarchy<2>(scene_, 2);
    shorter_ = meshes_;
    shorter_.levels.pop_back();
    shorter_.refinements.pop_back();
  }

  NestedSolver<2, 2> solver(const MeshHierarchy<2>& meshes) {
    return {meshes, scene_.solver, registry_, quiet_, times_};
  }
  Model<2> model(double t) const { return build_model<2>(scene_, 2, registry_, t); }
  static std::vector<double> displacement(const Solution<2>& solution) {
    EXPECT_TRUE(solution.summary.converged()) << solution.summary.reason;
    return to_global(solution.discretization.problem, solution.x);
  }

  Registry registry_ = solver_components();
  Scene scene_;
  MeshHierarchy<2> meshes_, shorter_;
  const Progress quiet_;
  Times times_;
};

TEST_F(Levels, ThatAreAppendedAreAsIfTheyHadAlwaysBeen) {
  auto grown = solver(shorter_), whole = solver(meshes_);
  displacement(grown.solve(model(0.5)));
  grown.append(meshes_.finest(), meshes_.refinements.back(), Nodes<2>(meshes_.finest()));
  EXPECT_EQ(displacement(grown.solve(model(0.5))), displacement(whole.solve(model(0.5))));
}

TEST_F(Levels, ThatAreDroppedLeaveTheOthersAsTheyWere) {
  auto cut = solver(meshes_), whole = solver(shorter_);
  displacement(cut.solve(model(0.5)));
  cut.drop_finest();
  EXPECT_EQ(displacement(cut.solve(model(0.5))), displacement(whole.solve(model(0.5))));
}

/// Friction counts from where nodes were, whatever their numbers are now.
TEST_F(Levels, ThatAreReplacedKnowTheLastStep) {
  auto same = solver(meshes_), other = solver(meshes_);
  const std::vector<double> u = displacement(same.solve(model(0.5)));
  other.solve(model(0.5));
  same.accept();
  other.accept();
  std::vector<Index> number(meshes_.finest().points.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(1));
  other.replace_finest(meshes_.finest(), meshes_.refinements.back(), Nodes<2>(meshes_.finest(), number));
  std::vector<double> renumbered(u.size());
  for (std::size_t v = 0; v < number.size(); ++v)
    for (std::size_t k = 0; k < 2; ++k) renumbered[2 * static_cast<std::size_t>(number[v]) + k] = u[2 * v + k];
  const std::vector<double> wanted = displacement(same.solve_after(model(1), u));
  const std::vector<double> found = displacement(other.solve_after(model(1), renumbered));
  for (std::size_t v = 0; v < number.size(); ++v)
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_NEAR(found[2 * static_cast<std::size_t>(number[v]) + k], wanted[2 * v + k], 1e-8) << "vertex " << v;
}

/// Where other edges are cut a linear displacement stays what it is.
TEST(MeshLevels, CarryOverByVertices) {
  const auto with = [](const Mesh<2>& coarse, std::vector<std::array<Index, 2>> parents) {
    MeshHierarchy<2> out;
    Mesh<2> fine;
    for (const auto [a, b] : parents)
      fine.points.push_back(
          {(coarse.points[a][0] + coarse.points[b][0]) / 2, (coarse.points[a][1] + coarse.points[b][1]) / 2});
    out.levels = {coarse, fine};
    out.refinements.emplace_back().parents = std::move(parents);
    return out;
  };
  Mesh<2> coarse;
  coarse.points = {{0, 0}, {2, 0}, {0, 2}, {2, 2}};
  const auto one = with(coarse, {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {1, 2}});
  const auto other = with(coarse, {{3, 3}, {0, 1}, {1, 1}, {2, 1}, {0, 0}, {2, 3}, {2, 2}});
  const auto linear = [](const Point<2>& p) { return 1 + 3 * p[0] - 2 * p[1]; };
  MeshLevels<2, 1> levels(one, {Nodes<2>(one.levels[0]), Nodes<2>(one.levels[1])});
  for (const Point<2>& p : one.finest().points) levels.finest().before.u.push_back(linear(p));
  levels.replace_finest(other.finest(), other.refinements[0], Nodes<2>(other.finest()));
  ASSERT_EQ(levels.finest().before.u.size(), other.finest().points.size());
  for (std::size_t v = 0; v < other.finest().points.size(); ++v)
    EXPECT_DOUBLE_EQ(levels.finest().before.u[v], linear(other.finest().points[v]));
  EXPECT_TRUE(levels.finest().now.u.empty());
}

}  // namespace
}  // namespace signorini::test
