// Nothing takes the number of a node for that of a vertex: a mesh torn apart and glued together by nodes with random
// numbers gives what the whole mesh does.
#include "core/fem/elements/nodes.hpp"

#include <gtest/gtest.h>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/fem/elements/probe.hpp"
#include "core/fem/motions/rigid_motions.hpp"
#include "core/fem/recovery/contact.hpp"
#include "core/fem/recovery/error_norm.hpp"
#include "core/fem/recovery/forces.hpp"
#include "core/fem/recovery/rigid_gap.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/geometry/shapes.hpp"
#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"
#include "tests/support/torn.hpp"

namespace signorini::testing {
namespace {

constexpr double rounding = 1e-12;

template <int D>
struct Glued {
  Mesh<D> whole = unit_mesh<D>(4), torn = test::torn(whole, 0.5);
  Nodes<D> vertices{whole}, nodes{torn, test::glued_at_random(torn)};
  std::vector<Index> node = test::nodes_at(whole, nodes);  // per vertex of the whole mesh

  /// The values per node in the order of the whole mesh's vertices.
  std::vector<double> sorted(const std::vector<double>& values, int count) const {
    std::vector<double> out;
    for (const Index p : node)
      out.insert(out.end(), values.begin() + Offset{p} * count, values.begin() + Offset{p + 1} * count);
    return out;
  }
};

void expect_same(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  double size = 0;
  for (const double v : expected) size = std::max(size, std::fabs(v));
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], rounding * size) << "at " << k;
}

template <std::size_t N>
void expect_same(const std::vector<std::array<double, N>>& found, const std::vector<std::array<double, N>>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t i = 0; i < N; ++i) EXPECT_NEAR(found[k][i], expected[k][i], rounding) << k;
}

/// A body with all kinds of data, none of them symmetric: loads inside and on faces, fixes along axes and normals, an
/// obstacle that part of the bottom comes to lie on.
template <int D, int B>
Model<B> body() {
  Model<B> model;
  const auto field = [](double a, double b) {
    return expression([=](const Site& s) { return a + b * s.x[0] * s.x[D - 1]; });
  };
  model.diffusion = model.young = field(1, 0.5);
  model.poisson = 0.3;
  Load<B> inside, on{Selection{"right", {}, ""}, {}};
  for (int i = 0; i < B; ++i) {
    inside.value[i] = field(-0.1 * (i + 1), 0.03);
    on.value[i] = field(0.02, -0.05 * (i + 1));
  }
  model.loads = {inside, on};
  std::array<std::optional<Field>, B> value;
  for (int i = 0; i < B; ++i) value[i] = field(-0.02, 0.01 * i);
  model.fixes = {fix<B>("top", value)};
  if (B == D) {
    model.fixes.push_back(fix<B>("left", {}, Frame::normal));
    model.fixes.back().value[0] = 0.001;
  }
  std::array<double, B> up{};
  up[B - 1] = 1;
  model.obstacles = {term<B>(
      [up](const SurfaceVertex& v) { return bound<B>(up, -0.05 - 0.04 * v.position[0] - v.position[D - 1], infinity); },
      "bottom")};
  model.obstacles[0].shape = geometry::sphere(std::vector<Field>(D, 0), 1, false, 1, "bottom");  // any: it is rigid
  return model;
}

template <int D, int B>
void expect_the_same_solution() {
  const Glued<D> g;
  const Model<B> model = body<D, B>();
  const auto expected = discretize<D, B>(g.vertices, model), found = discretize<D, B>(g.nodes, model);
  const auto wanted_x = solve_bounded(expected.problem), x = solve_bounded(found.problem);
  const auto wanted_u = to_global(expected.problem, wanted_x), u = to_global(found.problem, x);
  expect_same(g.sorted(u, B), wanted_u);
  expect_same(g.nodes.at_vertices(u, B), Nodes<D>(g.torn).at_vertices(g.nodes.at_vertices(u, B), B));
  expect_same(g.nodes.at_nodes(g.nodes.at_vertices(u, B), B), u);

  const auto wanted = contact_state<D, B>(g.vertices, model, expected, wanted_x);
  const auto state = contact_state<D, B>(g.nodes, model, found, x);
  EXPECT_GT(wanted.obstacles[0].nodes, 0);
  EXPECT_LT(wanted.obstacles[0].nodes, static_cast<Index>(wanted.nodes.size()));
  EXPECT_EQ(state.obstacles[0].nodes, wanted.obstacles[0].nodes);
  EXPECT_NEAR(state.obstacles[0].area, wanted.obstacles[0].area, rounding);
  EXPECT_NEAR(state.obstacles[0].max_pressure, wanted.obstacles[0].max_pressure, rounding);
  const Forces<B> wanted_forces = forces(model, expected, wanted, wanted_x), all = forces(model, found, state, x);
  expect_same(all.applied, wanted_forces.applied);
  expect_same(all.reactions, wanted_forces.reactions);
  expect_same(all.contact, wanted_forces.contact);

  const auto wanted_gap = deformed_contact<D, B>(g.vertices, model, 0, wanted, wanted_u);
  const auto gap = deformed_contact<D, B>(g.nodes, model, 0, state, u);
  EXPECT_NEAR(gap->penetration, wanted_gap->penetration, rounding);
  EXPECT_NEAR(gap->opening, wanted_gap->opening, rounding);
  EXPECT_NEAR(gap->displacement, wanted_gap->displacement, rounding);

  Point<D> at;
  for (int i = 0; i < D; ++i) at[i] = 0.61 + 0.1 * i;
  const auto wanted_value = evaluate<B>(g.vertices, locate<D>(g.whole, at, ""), wanted_u);
  const auto value = evaluate<B>(g.nodes, locate<D>(g.torn, at, ""), u);
  for (int i = 0; i < B; ++i) EXPECT_NEAR(value[i], wanted_value[i], rounding);
  const ExactGradient<D, B> flat = [](const Point<D>&) { return Gradient<D, B>{}; };
  EXPECT_NEAR((energy_error<D, B>(g.nodes, model, u, flat)), (energy_error<D, B>(g.vertices, model, wanted_u, flat)),
              rounding);
  const ExactValue<D, B> far = [](const Point<D>& y) {
    std::array<double, B> v;
    v.fill(y[0] - 2 * y[D - 1]);
    return v;
  };
  EXPECT_NEAR((max_nodal_error<D, B>(g.nodes, u, far)), (max_nodal_error<D, B>(g.vertices, wanted_u, far)), rounding);
  if constexpr (B == D)
    expect_same(element_stress<D>(g.nodes, model, u), element_stress<D>(g.vertices, model, wanted_u));
}

TEST(Nodes, GlueAMeshTogether) {
  expect_the_same_solution<2, 1>();
  expect_the_same_solution<3, 1>();
  expect_the_same_solution<2, 2>();
  expect_the_same_solution<3, 3>();
}

TEST(Nodes, AreTheVerticesUnlessToldOtherwise) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  const Nodes nodes(mesh);
  EXPECT_EQ(nodes.size(), mesh.vertices());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) EXPECT_EQ(nodes.of_simplex(e), mesh.elements[e]);
  for (Index v = 0; v < nodes.size(); ++v) {
    EXPECT_EQ(nodes.of_vertex(v), v);
    EXPECT_EQ(nodes.vertex(v), v);
  }
}

TEST(Nodes, HaveTheAreasAndNormalsOfAllVerticesThere) {
  const Glued<3> g;
  for (const Index p : g.node) EXPECT_GE(g.nodes.vertex(p), 0);
  EXPECT_LT(g.nodes.size(), g.torn.vertices());
  const Surface<3> all = surface(g.vertices), glued = surface(g.nodes);
  const auto areas = node_areas(g.vertices, all), of_glued = node_areas(g.nodes, glued);
  const auto normals = node_normals(g.vertices, all), normals_of_glued = node_normals(g.nodes, glued);
  for (std::size_t v = 0; v < all.nodes.size(); ++v) {
    const auto found = std::ranges::lower_bound(glued.nodes, g.node[all.nodes[v]]);
    ASSERT_NE(found, glued.nodes.end());
    ASSERT_EQ(*found, g.node[all.nodes[v]]);
    EXPECT_NEAR(of_glued[found - glued.nodes.begin()], areas[v], rounding);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(normals_of_glued[found - glued.nodes.begin()][i], normals[v][i], rounding);
  }
  expect_same(g.sorted(node_volumes(g.nodes), 1), node_volumes(g.vertices));
}

// Motions of a rigid body have no energy, which is asked of the matrix.
template <int D>
void expect_motions_without_energy() {
  const Glued<D> g;
  const BlockMatrix<D> A = stiffness<D, D>(g.nodes, body<D, D>());
  const RigidMotions<D, D> motions(g.nodes);
  for (int mode = 0; mode < RigidMotions<D, D>::modes; ++mode) {
    Eigen::VectorXd z(A.size() * D);
    for (Index p = 0; p < A.size(); ++p)
      for (int i = 0; i < D; ++i) {
        double axis[D] = {};
        axis[i] = 1;
        z[p * D + i] = motions.along(p, axis)[mode];
      }
    EXPECT_LT((dense(A) * z).norm(), rounding * z.norm()) << mode;
  }
}

TEST(Nodes, MoveRigidlyWithoutEnergy) {
  expect_motions_without_energy<2>();
  expect_motions_without_energy<3>();
}

// Interpolation between glued meshes keeps linear functions.
template <int D>
void expect_linear_interpolation() {
  const auto meshes = hierarchy<D>(test::torn(unit_mesh<D>(2), 0.5), 2);
  const auto nodes = test::glued_at_random(meshes);
  const auto P = prolongations(meshes, nodes);
  const auto value = [](const Point<D>& x) { return 1 + x[0] - 3 * x[D - 1]; };
  for (std::size_t k = 0; k < P.size(); ++k) {
    ASSERT_EQ(P[k].fine(), nodes[k + 1].size());
    ASSERT_EQ(P[k].coarse, nodes[k].size());
    EXPECT_LT(nodes[k].size(), meshes.levels[k].vertices());
    for (Index p = 0; p < P[k].fine(); ++p) {
      double sum = 0;
      for (Offset i = P[k].row[p]; i < P[k].row[p + 1]; ++i) sum += P[k].weight[i] * value(nodes[k].at(P[k].column[i]));
      EXPECT_NEAR(sum, value(nodes[k + 1].at(p)), rounding);
    }
  }
}

TEST(Nodes, InterpolateLinearFunctions) {
  expect_linear_interpolation<2>();
  expect_linear_interpolation<3>();
}

}  // namespace
}  // namespace signorini::testing
