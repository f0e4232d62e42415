// What goes over from one load step to the next, and problems as seen by bodies that have moved.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/dense.hpp"
#include "core/constraints/own_numbers.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/mesh/refine.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/local_coordinates.hpp"
#include "driver/levels/level_solution.hpp"
#include "driver/levels/level_start.hpp"
#include "driver/levels/moved_problem.hpp"
#include "driver/levels/turned_friction.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

/// A membrane with u = t (1 + x) on its boundary, whose solution that is, on two meshes.
struct Stretched {
  explicit Stretched(double t) {
    Model<1> model;
    model.fixes.push_back({on("boundary"), {field([t](const double* x) { return t * (1 + x[0]); })}});
    problems = discretize_all<2, 1>(cube<2>(0, 1, 4), 1, model);
    meshes = hierarchy<2>(cube<2>(0, 1, 4), 1);
  }
  /// The solution at step t on one of them.
  std::vector<double> exact(std::size_t level, double t) const {
    std::vector<double> out;
    for (const Point<2>& x : meshes.levels[level].points) out.push_back(t * (1 + x[0]));
    return out;
  }
  Nested<1> problems;
  MeshHierarchy<2> meshes;
};

void expect_near(const std::vector<double>& found, const std::vector<double>& wanted, double off = 1e-13) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], wanted[i], off) << i;
}

// From t = 1 to t = 3: with the change that the coarser mesh saw the start is the solution.
TEST(StartAfter, AddsTheChangeOfTheCoarserMesh) {
  const Stretched now(3);
  const LevelSolution<1> coarse_before{now.exact(0, 1), {}, {}}, before{now.exact(1, 1), {}, {}};
  const std::vector<double> coarse_now = now.exact(0, 3), none;
  const DiscreteProblem<1>& fine = now.problems.levels[1];
  const CoarserStep<1> coarser{now.problems.levels[0], coarse_now, none, coarse_before, now.problems.prolongations[0]};
  EXPECT_TRUE(coarser.knows_change());
  expect_near(start_after(fine, before, &coarser, {}), now.exact(1, 3));
  // Where it knows none, or there is none, the last solution with what is prescribed now.
  const CoarserStep<1> ignorant{now.problems.levels[0], none, none, coarse_before, now.problems.prolongations[0]};
  EXPECT_FALSE(ignorant.knows_change());
  const std::vector<double> last = start_after(fine, before, &ignorant, {});
  for (Index p = 0; p < fine.A.size(); ++p)
    EXPECT_NEAR(last[p], (fine.fixed[p] ? 3 : 1) * (1 + now.meshes.finest().points[p][0]), 1e-14);
  EXPECT_EQ(start_after<1>(fine, before, nullptr, {}), last);
}

TEST(StartAfter, TakesWhatHasLeastEnergy) {
  const Stretched now(3);
  const LevelSolution<1> before{now.exact(1, 1), {}, {}};
  std::vector<double> poor = now.exact(1, 3);
  for (std::size_t i = 0; i < poor.size(); ++i) poor[i] += 50 * std::sin(static_cast<double>(i * i));
  expect_near(start_after<1>(now.problems.levels[1], before, nullptr, {poor, now.exact(1, 3), poor}), now.exact(1, 3));
  EXPECT_EQ(start_after<1>(now.problems.levels[1], before, nullptr, {poor}),
            start_after<1>(now.problems.levels[1], before, nullptr, {}));
}

TEST(StartAfter, IsAdmissible) {
  Nested<1> problems = discretize_all<2, 1>(cube<2>(0, 1, 4), 0, membrane(-1, [](const double*) { return -0.01; }, {}));
  const LevelSolution<1> before{std::vector<double>(25, -5), {}, {}};
  for (const double v : start_after<1>(problems.finest(), before, nullptr, {})) EXPECT_GE(v, -0.01);
}

TEST(StartWithPressure, AddsTheChangesOfBoth) {
  const Stretched now(3);
  const LevelSolution<1> coarse_before{now.exact(0, 1), {}, {10, 20}}, before{now.exact(1, 1), {}, {1, 2, 3}};
  const std::vector<double> coarse_now = now.exact(0, 3), coarse_pressure{14, 26}, none;
  const RefinedPressure refined = [](const std::vector<double>& p) {
    return std::vector<double>{p[0], (p[0] + p[1]) / 2, p[1]};
  };
  const DiscreteProblem<1>& fine = now.problems.levels[1];
  const CoarserStep<1> coarser{now.problems.levels[0], coarse_now, coarse_pressure, coarse_before,
                               now.problems.prolongations[0]};
  std::vector<double> x, pressure;
  start_with_pressure(fine, before, &coarser, refined, x, pressure);
  expect_near(x, now.exact(1, 3));
  EXPECT_EQ(pressure, (std::vector<double>{5, 7, 9}));
  start_with_pressure<1>(fine, before, nullptr, refined, x, pressure);
  EXPECT_EQ(pressure, before.pressure);
  // A coarser mesh that does not know the last step leaves what is there.
  const CoarserStep<1> ignorant{now.problems.levels[0], none, none, coarse_before, now.problems.prolongations[0]};
  x.assign(1, 7);
  pressure.assign(1, 8);
  start_with_pressure(fine, before, &ignorant, refined, x, pressure);
  EXPECT_EQ(x, std::vector<double>{7});
  EXPECT_EQ(pressure, std::vector<double>{8});
}

/// Some nodes with numbers of their own, of obstacle 0 but for those listed, whose have none or belong to another one.
Discretization<2> numbered(const std::vector<Index>& nodes, const std::vector<Index>& functional, int width) {
  Discretization<2> out;
  Constraints<2>& c = out.problem.constraints;
  c.width = width;
  c.vector = nodes;
  c.before.assign(nodes.size() * static_cast<std::size_t>(width), 0);
  for (const Index p : nodes)
    for (int k = 0; k < width; ++k) c.data.push_back(10 * p + k);
  out.functional = functional;
  return out;
}

OwnNumbers<2> kept_of(const Discretization<2>& step) { return {step.problem, step.functional, {}}; }

TEST(OwnNumbers, GoOverByNodeAndObstacle) {
  const OwnNumbers<2> kept = kept_of(numbered({1, 4, 7, 9}, {0, -1, 0, 1}, 2));
  Discretization<2> next = numbered({1, 4, 7, 8, 9}, {0, 0, 0, 0, 0}, 2);
  kept.hand_to(next.functional, next.problem.constraints);
  EXPECT_EQ(next.problem.constraints.before, (std::vector<double>{10, 11, 0, 0, 70, 71, 0, 0, 0, 0}));
  Discretization<2> narrow = numbered({7, 9}, {0, 1}, 1);
  kept.hand_to(narrow.functional, narrow.problem.constraints);
  EXPECT_EQ(narrow.problem.constraints.before, (std::vector<double>{70, 90}));
}

TEST(OwnNumbers, GoOverToOtherNodes) {
  const OwnNumbers<2> kept = kept_of(numbered({1, 4, 7}, {0, 0, 1}, 1));
  const std::vector<Index> source{4, -1, 7, 4, 3};
  Discretization<2> next = numbered({0, 1, 2, 3, 4}, {0, 0, 1, 0, 0}, 1);
  kept.at_nodes(source).hand_to(next.functional, next.problem.constraints);
  EXPECT_EQ(next.problem.constraints.before, (std::vector<double>{40, 0, 70, 40, 0}));
  Discretization<2> untouched = numbered({0}, {0}, 1);
  OwnNumbers<2>().hand_to(untouched.functional, untouched.problem.constraints);
  EXPECT_EQ(untouched.problem.constraints.before, std::vector<double>{0});
}

/// An elastic block whose top is moved, above a plane, and which springs hold all around; the way is one of all of it.
template <int D>
void expect_moved() {
  Point<D> up{};
  up[D - 1] = 1;
  Point<D> below{};
  below[D - 1] = -9;  // out of the way
  Model<D> model = pressed_block<D>(plane<D>(below, up), 0.3);
  Spring<D>& spring = model.springs.emplace_back(Spring<D>{{std::nullopt, Field(1.0), ""}, {}});
  for (int i = 0; i < D; ++i) spring.stiffness[i] = 0.1 * (i + 1);
  const Mesh<D> mesh = cube<D>(0, 1, 2);
  Discretization<D> discretization = discretize<D, D>(mesh, model);
  const DiscreteProblem<D>& problem = discretization.problem;
  const auto solution = [&] {  // without the bounds
    const Eigen::VectorXd x = SymmetricFactors(dense(problem.A)).solve(vector(problem.b));
    return std::vector<double>(x.begin(), x.end());
  };
  const DiscreteProblem<D> before = problem;
  const std::vector<double> whole = solution();
  std::vector<double> way_u;
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int i = 0; i < D; ++i) way_u.push_back(i == D - 1 ? -0.25 : 0.1);
  const std::vector<double> way = to_local(problem, way_u);
  std::vector<double> x = whole, pressure, of_springs(way.size());
  add_spring_forces<D, D>(Nodes<D>(mesh), model, way_u, of_springs);
  const double all = energy(problem, whole);
  MovedProblem<D> moved(discretization, way, of_springs, x, pressure);
  EXPECT_NEAR(energy(problem, x), all, 1e-13);
  // What is left is as if nothing had moved, and solves the problem of now.
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], whole[i] - way[i], 1e-13);
  expect_near(solution(), x, 1e-12);
  const Constraints<D>& c = problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < D; ++k) {
      const double by = way[Offset{c.vector[slot]} * D + k];
      EXPECT_EQ(c.lower[slot * D + k], before.constraints.lower[slot * D + k] - by);
      EXPECT_EQ(c.upper[slot * D + k], before.constraints.upper[slot * D + k] - by);
    }
  // One node comes to its bound.
  const Index touching = c.vector[0];
  x[Offset{touching} * D] = c.lower[0];
  moved.back();
  EXPECT_EQ(x[Offset{touching} * D], before.constraints.lower[0]);  // without rounding
  x[Offset{touching} * D] = whole[Offset{touching} * D];
  expect_near(x, whole, 1e-13);
  EXPECT_EQ(problem.constraints.lower, before.constraints.lower);
  EXPECT_EQ(problem.constraints.upper, before.constraints.upper);
  EXPECT_EQ(problem.start, before.start);
  expect_near(problem.b, before.b, 1e-13);
  EXPECT_NEAR(problem.prescribed_work, before.prescribed_work, 1e-13);
  EXPECT_NEAR(problem.prescribed_energy, before.prescribed_energy, 1e-13);
}

TEST(MovedProblem, SeeksWhatIsLeftOfADisplacement) {
  expect_moved<2>();
  expect_moved<3>();
}

TEST(MovedProblem, StaysWithoutAWay) {
  Discretization<2> discretization = discretize<2, 2>(cube<2>(0, 1, 2), pressed_block<2>(plane<2>({}, {0, 1}), 0.3));
  const DiscreteProblem<2> before = discretization.problem;
  std::vector<double> x(before.b.size(), 0.5), pressure;
  MovedProblem<2> moved(discretization, {}, {}, x, pressure);
  EXPECT_EQ(discretization.problem.b, before.b);
  EXPECT_EQ(discretization.problem.constraints.lower, before.constraints.lower);
  EXPECT_EQ(moved.back(), 0);
  EXPECT_EQ(x, std::vector<double>(before.b.size(), 0.5));
}

// All that is prescribed is the way itself: nothing but rounding would be left, and so would be a start's.
TEST(MovedProblem, RestsWhereNothingElseIsLeftToDo) {
  Discretization<2> discretization =
      discretize<2, 2>(cube<2>(0, 1, 2), pressed_block<2>(plane<2>({0, -9}, {0, 1}), 0.3));
  std::vector<double> way_u;
  for (Index p = 0; p < discretization.problem.A.size(); ++p) way_u.insert(way_u.end(), {0, -0.3});
  std::vector<double> x(way_u.size(), 0.5), pressure(3, 0.5);
  const std::vector<double> way = to_local(discretization.problem, way_u);
  MovedProblem<2> moved(discretization, way, {}, x, pressure);
  EXPECT_EQ(x, std::vector<double>(x.size(), 0));
  EXPECT_EQ(pressure, std::vector<double>(3, 0));
  moved.back();
  EXPECT_EQ(x, way);
}

/// Contact with one obstacle: nodes with what friction exerts on them.
ContactState<2> rubbing(const std::vector<std::pair<Index, double>>& nodes) {
  ContactState<2> out;
  out.obstacles.resize(1);
  for (const auto& [vertex, force] : nodes) {
    ContactNode<2>& node = out.nodes.emplace_back();
    node.vertex = vertex;
    node.obstacle = 0;
    node.contact = true;
    node.tangential = {force, 0};
  }
  return out;
}

TEST(TurnedFriction, IsThatOfNewcomersAgainstWhatItWas) {
  const auto last = rubbing({{1, 1}, {2, 1}});
  EXPECT_NE(doubt_of_friction(last, rubbing({{2, 0.5}, {3, -2}, {4, -2}}), true, 1e-12), nullptr);
  EXPECT_EQ(doubt_of_friction(last, rubbing({{2, 0.5}, {3, 2}, {4, 2}}), true, 1e-12), nullptr);  // the same way
  EXPECT_EQ(doubt_of_friction(last, rubbing({{1, -2}, {2, -2}, {3, -1}}), true, 1e-12),
            nullptr);  // at the same nodes: it turned back
  EXPECT_EQ(doubt_of_friction(last, rubbing({{3, -2}, {4, 1.9}}), true, 1e-12), nullptr);  // without a direction
  EXPECT_EQ(doubt_of_friction(rubbing({{1, 1}, {2, -1}}), rubbing({{3, -2}}), true, 1e-12), nullptr);  // there was none
  auto open = rubbing({{1, 1}, {3, 0}});
  open.nodes[1].contact = false;  // one that was near is a newcomer all the same
  EXPECT_NE(doubt_of_friction(open, rubbing({{3, -2}}), true, 1e-12), nullptr);
}

// Before the first step, and where nothing touched in the last one, the node with the least distance is where contact
// begins.
TEST(TurnedFriction, IsInDoubtWhereContactIsNoLongerWhereItBegan) {
  ContactState<2> last;
  auto now = rubbing({{1, 0}, {2, 2}, {3, 2}});
  for (ContactNode<2>& node : now.nodes) node.start = 0.1 * node.vertex;
  now.nodes[0].contact = false;
  EXPECT_STREQ(doubt_of_friction(last, now, false, 1e-12), "contact moved on from where it was");
  EXPECT_EQ(doubt_of_friction(last, now, true, 1e-12), nullptr);  // the next step tells
  now.nodes[1].start = now.nodes[0].start;                        // one that is as near stays
  EXPECT_EQ(doubt_of_friction(last, now, false, 1e-12), nullptr);
  last = now;
  for (ContactNode<2>& node : last.nodes) node.contact = false, node.tangential = {}, node.gap = 0.1 * node.vertex;
  EXPECT_NE(doubt_of_friction(last, now, false, 1e-12), nullptr);
  now.nodes[2].tangential = {-2, 0};  // without a direction
  EXPECT_EQ(doubt_of_friction(last, now, false, 1e-12), nullptr);
}

}  // namespace
}  // namespace signorini::test
