// What is between nodes, and what contact between bodies does on the other side.
#include <gtest/gtest.h>

#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/recovery/between_nodes.hpp"
#include "core/fem/recovery/contact_surface.hpp"
#include "core/fem/recovery/counterforces.hpp"
#include "core/fem/recovery/master_side.hpp"
#include "core/geometry/shapes.hpp"
#include "core/mesh/join.hpp"
#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// Non-penetration of a rigid shape.
template <int D>
ObstacleTerm<D> rigid(std::shared_ptr<const DistanceFunction> shape, const std::string& part) {
  ObstacleTerm<D> out = term<D>(
      [shape](const SurfaceVertex& v) {
        Status status;
        const Distance d = shape->at(v.position, v.normal, status);
        std::array<double, D> n;
        std::copy_n(d.normal, D, n.begin());
        return bound<D>(n, -d.value, infinity);
      },
      part);
  out.shape = shape;
  return out;
}

/// The bottom of a unit block, in contact at all of its nodes with a ball of that radius right below its middle.
template <int D>
struct OnBall {
  explicit OnBall(double radius, int order = 1) : coarse(unit_mesh<D>(3)) {
    refine_uniformly(coarse, fine);
    nodes.emplace(order == 1 ? coarse : fine, order);
    std::vector<Field> center(D, Field(0.5));
    center[D - 1] = -radius;
    model.obstacles = {rigid<D>(geometry::sphere(center, radius, false, 1, "ball"), "bottom")};
    for (Index p = 0; p < nodes->size(); ++p) {
      if (nodes->at(p)[D - 1] != 0) continue;
      ContactNode<D>& node = state.nodes.emplace_back();
      node.vertex = p;
      node.contact = true;
    }
  }
  double violation(const std::vector<double>& u) const {
    return violation_between_nodes<D, D>(*nodes, model, 0, state, u);
  }
  std::vector<double> still() const { return std::vector<double>(nodes->size() * D, 0); }

  Mesh<D> coarse, fine;
  std::optional<Nodes<D>> nodes;
  Model<D> model;
  ContactState<D> state;
};

// The square's bottom has nodes at multiples of 1/3: between the inner two it touches in their middle. Pushed down by
// 0.01 it is so deep there; farther out the ball falls back.
TEST(BetweenNodes, MiddlesOfEdgesAreCompared) {
  OnBall<2> square(0.7);
  EXPECT_NEAR(square.violation(square.still()), 0, 1e-15);
  std::vector<double> u = square.still();
  for (std::size_t p = 0; p < u.size() / 2; ++p) u[2 * p + 1] = -0.01;
  EXPECT_NEAR(square.violation(u), 0.01, 1e-14);
  u.assign(u.size(), 0.01);  // up, and to the side
  EXPECT_EQ(square.violation(u), 0);
  OnBall<3> cube(0.7);
  u = cube.still();
  for (std::size_t p = 0; p < u.size() / 3; ++p) u[3 * p + 2] = -0.01;
  EXPECT_NEAR(cube.violation(u), 0.01, 0.006);  // no middle of an edge is right above the ball
  EXPECT_GT(cube.violation(u), 0.003);
}

// A node in the middle and quarters beside it: quadratic elements are looked at there as well.
TEST(BetweenNodes, QuartersOfQuadraticElementsAreCompared) {
  OnBall<2> square(0.7, 2);
  std::vector<double> u = square.still();
  for (std::size_t p = 0; p < u.size() / 2; ++p) u[2 * p + 1] = -0.01;
  const double quarter = 1.0 / 12;  // from the middle of the edge, which is a node
  EXPECT_NEAR(square.violation(u), 0.7 - std::hypot(quarter, 0.69), 1e-14);
}

TEST(BetweenNodes, WhatIsFarOffIsClear) {
  OnBall<2> square(0.7);
  std::vector<double> u = square.still();
  for (std::size_t p = 0; p < u.size() / 2; ++p) u[2 * p + 1] = -0.01;
  for (ContactNode<2>& node : square.state.nodes) node.contact = false, node.gap = 0.34;  // faces are 1/3 long
  EXPECT_EQ(square.violation(u), 0);
  square.state.nodes[1].gap = 0.3;
  EXPECT_NEAR(square.violation(u), 0.01, 1e-14);
}

TEST(BetweenNodes, IsNotKnownWithoutAShapeOrWhereTheObstacleFails) {
  OnBall<2> square(0.7);
  square.model.obstacles[0].shape = nullptr;
  EXPECT_TRUE(std::isnan(square.violation(square.still())));
  class Failing final : public TestObstacle<2> {
   public:
    Failing() : TestObstacle<2>({}) {}
    void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<2>*, Status& status) const noexcept override {
      status.fail(2, "no");
    }
  };
  OnBall<2> other(0.7);
  other.model.obstacles[0].obstacle = std::make_shared<Failing>();
  EXPECT_TRUE(std::isnan(other.violation(other.still())));
}

// A membrane u = 0 over the floor 0.1 - 4 (x - 1/2)^2 on its bottom; nodes at multiples of 1/3.
TEST(BetweenNodes, ScalarsAreComparedWhereANodeTouches) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  Model<1> model;
  const auto parabola = [](const SurfaceVertex& v) {
    return bound<1>({1}, 0.1 - 4 * (v.position[0] - 0.5) * (v.position[0] - 0.5), infinity);
  };
  model.obstacles = {term<1>(parabola, "bottom"), term<1>(parabola, {})};
  ContactState<1> state;
  ContactNode<1>& node = state.nodes.emplace_back();
  node.vertex = 1;
  node.contact = true;
  const std::vector<double> u(mesh.points.size(), 0);
  const Nodes<2> nodes(mesh);
  EXPECT_NEAR((violation_between_nodes<2, 1>(nodes, model, 0, state, u)), 0.1, 1e-15);
  state.nodes[0].vertex = 0;  // the edge in the middle has no node in contact
  EXPECT_EQ((violation_between_nodes<2, 1>(nodes, model, 0, state, u)), 0);
  EXPECT_TRUE(std::isnan(violation_between_nodes<2, 1>(nodes, model, 1, state, u)));  // on all of the body
}

/// Two unit blocks, one on the other, whose nodes do not match; the upper one presses.
template <int D>
struct Pressing {
  explicit Pressing(double pressure) : mesh(joined()), nodes(mesh) {
    model.obstacles = {term<D>(
        [](const SurfaceVertex& v) {
          std::array<double, D> away;
          std::copy_n(v.away, D, away.begin());
          return bound<D>(away, -v.gap, infinity);
        },
        "up/bottom")};
    model.obstacles[0].other = Selection{"low/top", {}, ""};
    pairs = pair_bodies(nodes, model, {});
    problem.jumps = pairs->jumps;
    const ContactSurface<D, D> surface(nodes, model, 0);
    contact.obstacles.resize(1);
    for (const PairedNode<D>& pair : pairs->nodes) {
      ContactNode<D>& node = contact.nodes.emplace_back();
      node.vertex = pair.node;
      node.contact = true;
      node.direction = pair.away;
      node.area = surface.area(node);
      node.pressure = pressure;
      node.force[0] = node.tangential[0] = 0.1 * pressure * node.area;
      node.force[D - 1] = pressure * node.area;
      node.friction = true;
    }
  }
  static Mesh<D> joined() {
    Mesh<D> up = unit_mesh<D>(2);
    for (Point<D>& x : up.points) x[D - 1] += 1;
    return join<D>({unit_mesh<D>(3), std::move(up)}, {"low", "up"}, {0, 0});
  }

  Mesh<D> mesh;
  Nodes<D> nodes;
  Model<D> model;
  std::shared_ptr<const PairedBodies<D>> pairs;
  DiscreteProblem<D> problem;
  ContactState<D> contact;
};

// Action and reaction: sums vanish, and moments do, for the weights reproduce linear functions. Tangential parts do not
// cross the coupling of bodies without friction.
template <int D>
void expect_counterforces() {
  const Pressing<D> bodies(0.7);
  const auto back = counterforces(bodies.nodes, bodies.model, bodies.problem, bodies.contact);
  std::vector<double> force(D, 0), moment(D, 0);
  const auto add = [&](const Point<D>& x, const std::array<double, D>& f) {
    force[D - 1] += f[D - 1];
    for (int i = 0; i < D; ++i) moment[i] += f[D - 1] * x[i];
  };
  for (const ContactNode<D>& node : bodies.contact.nodes) add(bodies.nodes.at(node.vertex), node.force);
  EXPECT_NEAR(force[D - 1], 0.7, 1e-13);
  for (const NodalForce<D>& f : back) {
    add(bodies.nodes.at(f.node), f.force);
    EXPECT_EQ(bodies.nodes.at(f.node)[D - 1], 1);
    EXPECT_EQ(f.obstacle, 0);
    EXPECT_FALSE(f.on_slave);
    EXPECT_TRUE(f.friction);
    EXPECT_FALSE(f.sticks);
  }
  EXPECT_NEAR(force[D - 1], 0, 1e-12);
  for (const double m : moment) EXPECT_NEAR(m, 0, 1e-12);
  EXPECT_NEAR((totals<D>(back, 1)[0][D - 1]), -0.7, 1e-12);
  EXPECT_NEAR((totals<D>(back, 1, true)[0][D - 1]), 0, 1e-15);
  EXPECT_NEAR((totals<D>(back, 2)[1][D - 1]), 0, 1e-15);
  EXPECT_NEAR((totals<D>(back, 1, false, &NodalForce<D>::tangential)[0][D - 1]), 0, 1e-12);
  DiscreteProblem<D> alone;
  EXPECT_TRUE(counterforces(bodies.nodes, bodies.model, alone, bodies.contact).empty());
}

TEST(Counterforces, BalanceWhatActsOnTheSlave) {
  expect_counterforces<2>();
  expect_counterforces<3>();
}

// Under a uniform pressure the master has that, too, at all its nodes, and its gaps are what displacements leave.
template <int D>
void expect_master() {
  const double p = 0.7;
  const Pressing<D> bodies(p);
  const auto back = counterforces(bodies.nodes, bodies.model, bodies.problem, bodies.contact);
  std::vector<double> u(bodies.mesh.points.size() * D, 0);
  for (Index v = unit_mesh<D>(3).vertices(); v < bodies.mesh.vertices(); ++v) u[v * D + D - 1] = 0.05;
  const MasterSide<D> side = master_side<D, D>(bodies.nodes, bodies.model, back, u);
  const std::vector<ContactNode<D>>& found = side.nodes;
  EXPECT_EQ(found.size(), D == 2 ? 4u : 20u);
  EXPECT_TRUE(std::ranges::is_sorted(found, {}, &ContactNode<D>::vertex));
  double area = 0, force = 0;
  for (const ContactNode<D>& node : found) {
    EXPECT_TRUE(node.contact);
    EXPECT_NEAR(node.direction[D - 1], -1, 1e-14);
    EXPECT_NEAR(node.gap, 0.05, 1e-13);
    EXPECT_NEAR(node.covered, 1, 1e-12);
    area += node.area;
    force += node.pressure * node.area;
    EXPECT_NEAR(node.pressure * node.area, -node.force[D - 1], 1e-13);
  }
  EXPECT_NEAR(area, 1, 1e-12);
  EXPECT_NEAR(force, p, 1e-12);
  ASSERT_EQ(side.pressures.size(), bodies.model.obstacles.size());
  EXPECT_NEAR(side.pressures[0].error, 0, 1e-12);
  EXPECT_EQ(side.seen[0].node.size(), found.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(side.seen[0].node[k], found[k].vertex);
  Model<D> alone;
  EXPECT_TRUE((master_side<D, D>(bodies.nodes, alone, back, u).nodes.empty()));
}

TEST(MasterSide, HasTheForcesAndGapsOfTheSlave) {
  expect_master<2>();
  expect_master<3>();
}

// Nothing presses on it: no contact, and no pressure.
TEST(MasterSide, IsOpenWithoutForces) {
  const Pressing<2> bodies(1);
  const std::vector<double> u(bodies.mesh.points.size() * 2, 0);
  for (const ContactNode<2>& node : master_side<2, 2>(bodies.nodes, bodies.model, {}, u).nodes) {
    EXPECT_FALSE(node.contact);
    EXPECT_EQ(node.recovered, 0);
    EXPECT_NEAR(node.gap, 0, 1e-14);
  }
}

}  // namespace
}  // namespace signorini::testing
