#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/elements/select.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

template <int B>
double component_sum(const std::vector<double>& b, int component) {
  double s = 0;
  for (std::size_t k = component; k < b.size(); k += B) s += b[k];
  return s;
}

// sum_p b_p w(x_p) is the integral of f w for a linear w.
template <int D>
double moment(const Mesh<D>& mesh, const std::vector<double>& b, int axis) {
  double s = 0;
  for (Index p = 0; p < mesh.vertices(); ++p) s += b[p] * mesh.points[p][axis];
  return s;
}

template <int D>
void expect_exact_body_force() {
  const Mesh<D> mesh = distorted_mesh<D>(3);
  Model<1> model;
  model.t = 2;
  model.loads.push_back({{}, {expression([](const Site& s) { return s.t * (1 + s.x[0]); })}});
  const std::vector<double> b = load_vector(mesh, model);
  EXPECT_NEAR(component_sum<1>(b, 0), 3, 1e-13);
  EXPECT_NEAR(moment<D>(mesh, b, 0), 2 * (1.0 / 2 + 1.0 / 3), 1e-13);
  EXPECT_NEAR(moment<D>(mesh, b, 1), 1.5, 1e-13);
}

TEST(Load, BodyForceIsExactForLinearFields) {
  expect_exact_body_force<2>();
  expect_exact_body_force<3>();
}

template <int D>
void expect_exact_traction() {
  const Mesh<D> mesh = unit_mesh<D>(3);
  Model<1> model;
  model.loads.push_back(
      {Selection{"right", {}, "load.0"}, {expression([](const Site& s) { return s.x[1] * s.x[1]; })}});
  const std::vector<double> b = load_vector(mesh, model);
  EXPECT_NEAR(component_sum<1>(b, 0), 1.0 / 3, 1e-14);
  EXPECT_NEAR(moment<D>(mesh, b, 1), 1.0 / 4, 1e-14);
  for (Index p = 0; p < mesh.vertices(); ++p)
    if (mesh.points[p][0] < 1 - 1e-9) {
      EXPECT_EQ(b[p], 0);
    }
}

TEST(Load, TractionIsExactForQuadraticFields) {
  expect_exact_traction<2>();
  expect_exact_traction<3>();
}

// Gauss: the integral of the pressure x n over the surface is the volume times the unit vector.
template <int D>
void expect_archimedes() {
  Mesh<D> mesh = distorted_mesh<D>(2);
  rotate_mesh(mesh);
  Model<D> model;
  Load<D> load{Selection{{}, {}, "load.0"}, {}};
  for (int i = 0; i < D; ++i) load.value[i] = expression([i](const Site& s) { return s.x[1] * s.n[i]; });
  model.loads.push_back(load);
  const std::vector<double> b = load_vector(mesh, model);
  for (int i = 0; i < D; ++i) EXPECT_NEAR(component_sum<D>(b, i), i == 1 ? 1 : 0, 1e-13);
}

TEST(Load, TractionSeesTheOuterNormal) {
  expect_archimedes<2>();
  expect_archimedes<3>();
}

TEST(Load, ConstantsAgreeWithExpressions) {
  const Mesh<3> mesh = distorted_mesh<3>(2);
  Model<3> constants, expressions;
  constants.loads = {{{}, {1.0, 2.0, 3.0}}, {Selection{"top", {}, ""}, {4.0, 5.0, 6.0}}};
  expressions.loads = constants.loads;
  for (auto& load : expressions.loads)
    for (Field& f : load.value) f = expression([v = *f.constant()](const Site&) { return v; });
  const auto a = load_vector(mesh, constants), b = load_vector(mesh, expressions);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-15);
  EXPECT_NEAR(component_sum<3>(a, 2), 9, 1e-13);
}

TEST(Select, WhereNeedsAllVerticesOfAFaceAndSeesItsNormal) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  Selection top{{}, expression([](const Site& s) { return s.n[2] > 0.9; }), "load.0"};
  EXPECT_EQ(select_faces(mesh, top, 1), select_faces(mesh, Selection{"top", {}, ""}, 1));
  Selection half{"top", expression([](const Site& s) { return s.x[0] > 0.4; }), "load.0"};
  EXPECT_EQ(select_faces(mesh, half, 1).size(), select_faces(mesh, top, 1).size() / 2);
}

TEST(Select, EmptySelectionNamesItsOrigin) {
  const Selection nowhere{{}, expression([](const Site& s) { return s.x[0] > 7; }, "x > 7"), "scene.toml:9: fix.2"};
  try {
    select_faces(unit_mesh<2>(2), nowhere, 1);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Exit::input);
    EXPECT_NE(std::string(e.what()).find("scene.toml:9: fix.2"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("x > 7"), std::string::npos);
  }
}

TEST(Select, NormalsAndAreasOfASurface) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  const Surface<3> all = surface(mesh), top = surface(mesh, select_faces(mesh, Selection{"top", {}, ""}, 1));
  for (const Point<3>& n : node_normals(Nodes(mesh), top)) EXPECT_NEAR(n[2], 1, 1e-15);
  const auto normals = node_normals(Nodes(mesh), all);
  for (std::size_t v = 0; v < all.nodes.size(); ++v) {
    const Point<3>& x = mesh.points[all.nodes[v]];
    EXPECT_NEAR(vector<3>(normals[v]).norm(), 1, 1e-14);
    for (int i = 0; i < 3; ++i) {
      const double outwards = x[i] == 0 ? -1 : x[i] == 1 ? 1 : 0;
      if (outwards != 0) {
        EXPECT_GT(normals[v][i] * outwards, 0.1);
      }
    }
  }
  double area = 0, volume = 0;
  for (const double a : node_areas(Nodes(mesh), all)) area += a;
  for (const double a : node_volumes(Nodes(mesh))) volume += a;
  EXPECT_NEAR(area, 6, 1e-13);
  EXPECT_NEAR(volume, 1, 1e-13);
}

}  // namespace
}  // namespace signorini::testing
