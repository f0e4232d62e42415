#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <map>
#include <set>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/pairs/contact_pairs.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/slave_choice.hpp"
#include "driver/components.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/touching_bodies.hpp"
#include "tests/bodies/scenes.hpp"
#include "tests/support/dense.hpp"

// Nodes that touch several other bodies: blocks around a point, walls, and a floor beside another block.

namespace signorini::test {
namespace {

using tables::block, tables::fix, tables::load;

/// Whether each of four pairs has its first body as the slave.
using Slaves = std::array<bool, 4>;

std::string slave_key(bool body) { return fmt::format("slave = \"{}\"\n", body ? "body" : "other"); }

/// Four blocks around the origin, one after the other each touching the next one.
std::string four_blocks(int order, const Slaves& slaves, const std::string& more = "") {
  const std::string of = material(1000, 0, order);
  return block("sw", "[-5, -5]", "[0, 0]", "[4, 4]", of) + block("se", "[0, -5]", "[5, 0]", "[5, 5]", of) +
         block("ne", "[0, 0]", "[5, 5]", "[3, 3]", of) + block("nw", "[-5, 0]", "[0, 5]", "[6, 6]", of) +
         fix("sw", "left", "[0, \"free\"]") + fix("sw", "bottom", "[\"free\", 0]") +
         fix("nw", "left", "[0, \"free\"]") + fix("se", "bottom", "[\"free\", 0]") +
         pair("sw", "right", "se", "left", slave_key(slaves[0]) + more) +
         pair("se", "top", "ne", "bottom", slave_key(slaves[1]) + more) +
         pair("ne", "left", "nw", "right", slave_key(slaves[2]) + more) +
         pair("nw", "bottom", "sw", "top", slave_key(slaves[3]) + more);
}

std::vector<Slaves> all_slaves() {
  std::vector<Slaves> out;
  for (unsigned k = 0; k < 16; ++k) out.push_back({(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0});
  return out;
}

// Chains, nodes that are slaves twice, and circles: pressed from all sides each is compressed uniformly.
TEST(FourBlocks, PassThePatchTestWhoeverIsTheSlave) {
  const std::string loads = load("se", "[-10, 0]", "right") + load("ne", "[-10, 0]", "right") +
                            load("ne", "[0, -10]", "top") + load("nw", "[0, -10]", "top") +
                            tables::probe("corner", "ne", "[5, 5]");
  for (const int order : {1, 2})
    for (const Slaves& slaves : all_slaves()) {
      Driver driver(scene_of(four_blocks(order, slaves) + loads));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      const std::array<std::array<double, 2>, 4> expected{{{-50, 0}, {0, -50}, {50, 0}, {0, 50}}};
      for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 2; ++i)
          EXPECT_NEAR(report.last().contact[k].force[i], expected[k][i], 1e-6) << "obstacle " << k;
      for (const ContactReport& contact : report.last().contact) {
        EXPECT_NEAR(contact.max_pressure, 10, 1e-6);
        EXPECT_FALSE(contact.peaks_at_edge);
      }
      for (const double u : report.last().probes[0].value) EXPECT_NEAR(u, -0.1, 1e-8);
    }
}

/// A problem in displacements: min 1/2 u'Ku - f'u where rows of C say C u <= g, and of F that F u = h.
struct SaddlePoint {
  Eigen::SparseMatrix<double> K;
  Eigen::VectorXd f;
  std::vector<std::map<Index, double>> C, F;
  std::vector<double> g, h;
  std::vector<Index> obstacle;     // per row of C
  std::vector<Point<2>> on_slave;  // per row of C: what a multiplier of 1 does on the slave
};

/// Primal-dual active sets, with an indefinite matrix: no change of basis, no penalty.
/// @return multipliers of the rows of C
std::vector<double> active_set(const SaddlePoint& problem, Eigen::VectorXd& u) {
  const auto n = static_cast<Index>(problem.K.rows()), m = static_cast<Index>(problem.C.size()),
             fixed = static_cast<Index>(problem.F.size());
  std::set<Index> active;
  for (Index k = 0; k < m; ++k) active.insert(k);
  std::vector<double> lambda(problem.C.size());
  for (int step = 0; step < 100; ++step) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int c = 0; c < problem.K.outerSize(); ++c)
      for (Eigen::SparseMatrix<double>::InnerIterator it(problem.K, c); it; ++it)
        entries.emplace_back(it.row(), it.col(), it.value());
    const auto add = [&](Index row, const std::map<Index, double>& coefficients) {
      for (const auto& [column, value] : coefficients) {
        entries.emplace_back(row, column, value);
        entries.emplace_back(column, row, value);
      }
    };
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + fixed + m);
    b.head(n) = problem.f;
    for (Index k = 0; k < fixed; ++k) add(n + k, problem.F[k]), b[n + k] = problem.h[k];
    for (Index k = 0; k < m; ++k)
      if (active.contains(k))
        add(n + fixed + k, problem.C[k]), b[n + fixed + k] = problem.g[k];
      else
        entries.emplace_back(n + fixed + k, n + fixed + k, 1);
    Eigen::SparseMatrix<double> all(b.size(), b.size());
    all.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(all);
    const Eigen::VectorXd x = solver.solve(b);
    u = x.head(n);
    std::set<Index> next;
    for (Index k = 0; k < m; ++k) {
      lambda[k] = active.contains(k) ? x[n + fixed + k] : 0;
      double violation = -problem.g[k];
      for (const auto& [column, value] : problem.C[k]) violation += value * u[column];
      if (active.contains(k) ? lambda[k] > 0 : violation > 1e-12) next.insert(k);
    }
    if (next == active) return lambda;
    active = std::move(next);
  }
  ADD_FAILURE() << "the active sets do not rest";
  return lambda;
}

/// A scene of one group of bodies on its finest mesh.
struct Discrete {
  Scene scene;
  Registry registry = all_components();
  MeshHierarchy<2> hierarchy;
  Nodes<2> nodes;
  Model<2> model;
  std::vector<SlaveChoice> choices;

  explicit Discrete(const std::string& text)
      : scene(with_touching_bodies(scene_of(text))),
        hierarchy(build_hierarchy<2>(scene, 2)),
        nodes(nodes_of(hierarchy, scene.bodies[0].order).back()) {
    load_plugins(scene, registry);
    model = build_model<2>(scene, 2, registry, 1);
    choices = choose_slaves(Nodes<2>(hierarchy.levels.front()), model);
    exchange_sides(choices, model);
  }
};

// Each node is the slave of the pair that covers most of it, and the faces of the others are covered all the same.
TEST(ContactPair, LeavesNodesToAnotherOne) {
  const Discrete of(four_blocks(2, {true, false, true, false}));  // sw and ne are slaves on both sides
  const auto fixes = collect_fixes<2, 2>(of.nodes, of.model);
  std::vector<ContactPair<2>> pairs;
  for (Index k = 0; k < 4; ++k)
    pairs.emplace_back(of.nodes, of.model, fixes, k, paired_faces(of.nodes.mesh(), of.model.obstacles[k], 1),
                       std::vector<Point<2>>(), std::vector<Index>());
  const auto corners = [&](bool of_both) {
    Index count = 0;
    for (Index v = 0; v < of.nodes.mesh().vertices(); ++v) {
      const auto has = std::ranges::count_if(pairs, [&](const auto& pair) { return pair.has(v); });
      count += of_both ? has == 2 : has == 1 && of.nodes.mesh().points[v] == Point<2>{0, 0};
    }
    return count;
  };
  EXPECT_EQ(corners(true), 2);
  share_slaves(pairs);
  EXPECT_EQ(corners(true), 0);
  EXPECT_EQ(corners(false), 2);
  for (const ContactPair<2>& pair : pairs) {
    const MortarCoupling<2>& found = pair.coupling();
    double length = 0;
    for (Index k = 0; k < found.nodes(); ++k) length += found.weight[k] * found.part(k);
    EXPECT_NEAR(length, 5, 1e-12);
  }
}

/// What the program discretises a frictionless scene as, before any change of unknowns.
SaddlePoint saddle_point(const std::string& text, std::vector<SlaveChoice>& choices) {
  const Discrete of(text);
  const auto& [scene, registry, hierarchy, nodes, model, chosen] = of;
  choices = chosen;
  const auto fixes = collect_fixes<2, 2>(nodes, model);
  const auto pairs = pair_bodies<2>(nodes, model, fixes);
  SaddlePoint out;
  out.K = sparse(stiffness<2, 2>(nodes, model));
  const std::vector<double> f = load_vector<2, 2>(nodes, model);
  out.f = Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<Index>(f.size()));
  for (const auto& fixed : fixes)
    for (int k = 0; k < fixed.count; ++k) {
      auto& row = out.F.emplace_back();
      for (int i = 0; i < 2; ++i)
        if (fixed.direction[k][i] != 0) row[2 * fixed.vertex + i] = fixed.direction[k][i];
      out.h.push_back(fixed.value[k]);
    }
  const Jumps<2>& jumps = *pairs->jumps;
  for (const PairedNode<2>& node : pairs->nodes) {
    const auto s = std::ranges::lower_bound(jumps.vector, node.node) - jumps.vector.begin();
    auto& row = out.C.emplace_back();
    for (Offset k = jumps.inverse.row[s]; k < jumps.inverse.row[s + 1]; ++k)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          row[2 * jumps.inverse.column[k] + j] -= node.away[i] * jumps.inverse.at(k)[2 * i + j];
    out.g.push_back(node.part * node.gap);
    out.obstacle.push_back(node.obstacle);
    out.on_slave.push_back({node.part * node.away[0], node.part * node.away[1]});
  }
  return out;
}

/// The load opens a part of an interface.
std::string uneven_loads() {
  return load("se", "[\"-10 - y\", 0]", "right") + load("ne", "[-10, 0]", "right") +
         load("ne", "[0, \"x < 1.67 ? -60 : 6\"]", "top") + load("nw", "[0, \"-10 - 3 * x\"]", "top");
}

// Displacements and the force at every interface are those of multipliers in place of jumps, about the bodies as drawn.
TEST(FourBlocks, AreWhatMultipliersMakeOfThem) {
  for (const int order : {1, 2})
    for (const Slaves& slaves : {Slaves{true, true, true, true}, Slaves{true, false, true, false},
                                 Slaves{false, true, true, false}, Slaves{true, true, true, false}}) {
      const std::string text =
          four_blocks(order, slaves, "renew = false\n") + uneven_loads() + "[refine]\nuniform = 1\n";
      Driver driver(scene_of(text));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      std::vector<SlaveChoice> choices;
      const SaddlePoint problem = saddle_point(text, choices);
      Eigen::VectorXd u;
      const std::vector<double> lambda = active_set(problem, u);
      EXPECT_GT(std::ranges::count(lambda, 0.0), 2) << "something opens";
      std::array<Point<2>, 4> force{};
      for (std::size_t k = 0; k < lambda.size(); ++k)
        for (int i = 0; i < 2; ++i) force[problem.obstacle[k]][i] += lambda[k] * problem.on_slave[k][i];
      for (int k = 0; k < 4; ++k) {
        const ContactReport& contact = report.last().contact[k];
        const std::vector<double>& on_slave = choices[k].exchanged ? contact.pair->force : contact.force;
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(on_slave[i], force[k][i], 1e-5) << "obstacle " << k;
        expect_opposite(contact, 1e-10);
      }
      driver.visit(0, [&](const auto& run) {
        const std::vector<double>& found = run.results().u;
        ASSERT_EQ(static_cast<Index>(found.size()), static_cast<Index>(u.size()));
        double off = 0;
        for (std::size_t k = 0; k < found.size(); ++k)
          off = std::max(off, std::abs(found[k] - u[static_cast<Index>(k)]));
        EXPECT_LE(off, 1e-7 * u.cwiseAbs().maxCoeff());
      });
    }
}

// Who is the slave matters within the error of the mesh.
TEST(FourBlocks, DoNotDependOnTheSlave) {
  std::vector<double> spread;
  for (const int refinements : {0, 1, 2}) {
    double low = infinity, high = -infinity;
    for (const Slaves& slaves : {Slaves{true, true, true, true}, Slaves{false, false, false, false},
                                 Slaves{true, false, true, false}, Slaves{false, true, true, false}}) {
      Driver driver(scene_of(four_blocks(2, slaves) + uneven_loads() + tables::probe("corner", "ne", "[5, 5]") +
                             fmt::format("[refine]\nuniform = {}\n", refinements)));
      const Report& report = driver.solve();
      ASSERT_TRUE(report.converged()) << report.reason();
      EXPECT_LE(report.last().summary.iterations, 25);
      EXPECT_NEAR(report.last().contact[1].force[1], -80, 1e-5) << "what the upper block is pressed by";
      EXPECT_NEAR(std::abs(report.last().contact[2].force[0]), 50, 1e-5);
      const double u = report.last().probes[0].value[1];
      low = std::min(low, u), high = std::max(high, u);
    }
    spread.push_back((high - low) / std::abs(high));
    show("{} refinements: spread {:.2e}\n", refinements, spread.back());
  }
  EXPECT_LE(spread.back(), 5e-3);
  EXPECT_LE(spread.back(), 0.5 * spread.front());
}

/// What acts on each body, by contact and its own weight.
void expect_each_in_balance(const Report& report, const std::map<std::string, std::vector<double>>& applied,
                            double tolerance) {
  std::map<std::string, std::vector<double>> sum = applied;
  for (const ContactReport& contact : report.last().contact) {
    if (!contact.pair) continue;
    const bool first = contact.body == contact.pair->slave;
    const std::string& other = first ? contact.pair->master : contact.pair->slave;
    for (std::size_t i = 0; i < contact.force.size(); ++i) {
      if (sum.contains(contact.body)) sum[contact.body][i] += contact.force[i];
      if (sum.contains(other)) sum[other][i] += contact.pair->force[i];
    }
  }
  for (const auto& [body, force] : sum)
    for (const double left : force) EXPECT_NEAR(left, 0, tolerance) << body;
}

// Bricks in a running bond under their weight, with friction, and pushed: a node of the upper ones is above two others.
TEST(Wall, OfBricksWithFrictionIsInBalanceBrickByBrick) {
  constexpr double weight = 0.01;
  struct Brick {
    const char *name, *from, *to, *cells;
    double area;
  };
  const Brick bricks[] = {{"a", "[0, 0]", "[2, 1]", "[4, 2]", 2}, {"b", "[2, 0]", "[4, 1]", "[5, 2]", 2},
                          {"c", "[0, 1]", "[1, 2]", "[3, 2]", 1}, {"d", "[1, 1]", "[3, 2]", "[3, 2]", 2},
                          {"e", "[3, 1]", "[4, 2]", "[2, 2]", 1}, {"f", "[0, 2]", "[2, 3]", "[5, 3]", 2},
                          {"g", "[2, 2]", "[4, 3]", "[3, 3]", 2}};
  std::string text = fix("a", "bottom", "[0, 0]") + fix("b", "bottom", "[0, 0]") + "[refine]\nuniform = 1\n";
  for (const Brick& brick : bricks)
    text += block(brick.name, brick.from, brick.to, brick.cells, material(1000, 0.2, 2)) +
            load(brick.name, fmt::format("[0, {}]", -weight));
  text += load("f", "[0.002, -0.02]", "top") + load("g", "[0.002, -0.02]", "top");
  const auto touch = [&](const char* body, const char* on, const char* other, const char* other_on) {
    text += pair(body, on, other, other_on, "friction = 0.5\n", "elastic_coulomb");
  };
  touch("a", "right", "b", "left"), touch("c", "bottom", "a", "top"), touch("d", "bottom", "a", "top");
  touch("d", "bottom", "b", "top"), touch("e", "bottom", "b", "top"), touch("c", "right", "d", "left");
  touch("d", "right", "e", "left"), touch("f", "bottom", "c", "top"), touch("f", "bottom", "d", "top");
  touch("g", "bottom", "d", "top"), touch("g", "bottom", "e", "top"), touch("f", "right", "g", "left");
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  show("{} iterations\n", report.last().summary.iterations);
  std::map<std::string, std::vector<double>> applied;
  for (const Brick& brick : bricks)
    if (brick.name[0] > 'b') applied[brick.name] = {0, -weight * brick.area};
  for (const char* top : {"f", "g"}) applied[top][0] += 0.004, applied[top][1] -= 0.04;
  expect_each_in_balance(report, applied, 1e-7);
  for (const ContactReport& contact : report.last().contact) expect_opposite(contact, 1e-10);
}

// Eight cubes around a point: at its edges two obstacles bound a node, in the middle three. With linear elements faces
// in the middle have no other nodes.
TEST(EightCubes, PassThePatchTest) {
  const char* cells[] = {"[2, 2, 2]", "[3, 3, 3]", "[2, 3, 2]", "[3, 2, 3]"};
  for (const int order : {1, 2}) {
    std::string text;
    const auto name = [](int k) { return fmt::format("c{}", k); };
    for (int k = 0; k < 8; ++k) {
      std::array<int, 3> from{k & 1, k >> 1 & 1, k >> 2 & 1};
      text += block(name(k), fmt::format("[{}, {}, {}]", from[0], from[1], from[2]),
                    fmt::format("[{}, {}, {}]", from[0] + 1, from[1] + 1, from[2] + 1), cells[(k * 3) % 4],
                    material(100, 0, order));
      const char *low[] = {"left", "front", "bottom"}, *high[] = {"right", "back", "top"};
      const char* held[] = {"[0, \"free\", \"free\"]", "[\"free\", 0, \"free\"]", "[\"free\", \"free\", 0]"};
      const char* pressed[] = {"[-1, 0, 0]", "[0, -1, 0]", "[0, 0, -1]"};
      for (int i = 0; i < 3; ++i) {
        text += from[i] == 0 ? fix(name(k), low[i], held[i]) : load(name(k), pressed[i], high[i]);
        if (from[i] == 0) text += pair(name(k), high[i], name(k | 1 << i), low[i], slave_key((k + i) % 2 == 0));
      }
    }
    if (order == 1) {
      expect_error(text, Exit::input, "at all nodes of an element's face");
      continue;
    }
    Driver driver(scene_of(text + tables::probe("corner", "c7", "[2, 2, 2]")));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    show("{} iterations\n", report.last().summary.iterations);
    for (const double u : report.last().probes[0].value) EXPECT_NEAR(u, -0.02, 1e-8);
    for (const ContactReport& contact : report.last().contact) EXPECT_NEAR(length(contact.force), 1, 1e-6);
  }
}

// A rigid floor beside another block: the slave's node at the floor leaves the block to its neighbours.
TEST(Floor, BesideAnotherBlock) {
  for (const bool first : {true, false}) {
    Driver driver(
        scene_of(block("a", "[0, 0]", "[1, 1]", "[3, 3]", material(100, 0, 2)) +
                 block("b", "[1, 0]", "[2, 1]", "[4, 4]", material(100, 0, 2)) + fix("a", "left", "[0, \"free\"]") +
                 load("b", "[-1, 0]", "right") + load("a", "[0, -1]", "top") + load("b", "[0, -1]", "top") +
                 tables::plane("a", "bottom", "[0, 0]", "[0, 1]") + tables::plane("b", "bottom", "[0, 0]", "[0, 1]") +
                 pair("a", "right", "b", "left", slave_key(first)) + tables::probe("corner", "b", "[2, 1]")));
    const Report& report = driver.solve();
    ASSERT_TRUE(report.converged()) << report.reason();
    EXPECT_NEAR(report.last().probes[0].value[0], -0.02, 1e-8);
    EXPECT_NEAR(report.last().probes[0].value[1], -0.01, 1e-8);
    EXPECT_NEAR(report.last().contact[0].force[1], 1, 1e-7);
    EXPECT_NEAR(report.last().contact[1].force[1], 1, 1e-7);
    EXPECT_NEAR(report.last().contact[2].force[0], -1, 1e-7);
  }
}

// One element has no other nodes that could take over what both ends carry.
TEST(FourBlocks, OfOneLinearElementAreRefused) {
  const std::string of = material(1000, 0, 1);
  const std::string text =
      block("a", "[0, 0]", "[1, 1]", "[1, 1]", of) + block("b", "[1, 0]", "[2, 1]", "[2, 2]", of) +
      block("c", "[0, 1]", "[1, 2]", "[2, 2]", of) + block("d", "[0, -1]", "[1, 0]", "[2, 2]", of) +
      fix("b", "right", "[0, 0]") + fix("c", "top", "[0, 0]") + fix("d", "bottom", "[0, 0]") + load("a", "[1, 0]") +
      pair("a", "top", "c", "bottom", slave_key(true)) + pair("a", "bottom", "d", "top", slave_key(true)) +
      pair("a", "right", "b", "left", slave_key(true));
  expect_error(text, Exit::input, "at all nodes of an element's face");
}

}  // namespace
}  // namespace signorini::test
