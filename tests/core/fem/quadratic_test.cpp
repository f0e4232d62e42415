// Quadratic elements: fields that they hold come out to rounding.
#include <gtest/gtest.h>

#include <functional>

#include "core/base/error.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/refine.hpp"
#include "core/solver/interpolate.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// Coordinates along and across random directions, so that no axis is special.
template <int D>
double quadratic(int i, const Point<D>& x) {
  double v = 0.3 - i;
  for (int j = 0; j < D; ++j)
    for (int k = 0; k < D; ++k) v += (0.4 + 0.3 * i - 0.2 * j + 0.5 * k) * x[j] * x[k] + (0.7 - i + 0.1 * k) * x[k] / D;
  return v;
}

template <int D, int B>
std::array<double, B> value(const Point<D>& x) {
  std::array<double, B> out;
  for (int i = 0; i < B; ++i) out[i] = quadratic<D>(i, x);
  return out;
}

/// By central differences, which are exact here.
template <int D, int B>
Gradient<D, B> slope(const Point<D>& x) {
  constexpr double h = 0.5;
  Gradient<D, B> out;
  for (int j = 0; j < D; ++j) {
    Point<D> before = x, behind = x;
    before[j] -= h;
    behind[j] += h;
    for (int i = 0; i < B; ++i) out[i][j] = (quadratic<D>(i, behind) - quadratic<D>(i, before)) / (2 * h);
  }
  return out;
}

template <int D>
Point<D> place(const Site& s) {
  Point<D> x;
  std::copy_n(s.x, D, x.begin());
  return x;
}

constexpr double lambda = 1.3, mu = 0.8, diffusion = 2;

/// The flux or stress of that field.
template <int D, int B>
Gradient<D, B> flux(const Point<D>& x) {
  const Gradient<D, B> g = slope<D, B>(x);
  Gradient<D, B> out{};
  double trace = 0;
  for (int i = 0; i < B; ++i) trace += g[i][i];
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < D; ++j)
      out[i][j] = B == 1 ? diffusion * g[i][j] : mu * (g[i][j] + g[j % B][i]) + (i == j ? lambda * trace : 0);
  return out;
}

template <int D, int B>
Model<B> model() {
  Model<B> out;
  out.diffusion = diffusion;
  out.poisson = lambda / (2 * (lambda + mu));
  out.young = mu * (3 * lambda + 2 * mu) / (lambda + mu);
  return out;
}

/// What holds the field: on `fixed` its values, elsewhere its tractions, and the source within.
template <int D, int B>
Model<B> held(const std::vector<std::string>& fixed, const std::vector<std::string>& loaded) {
  Model<B> out = model<D, B>();
  std::array<std::optional<Field>, B> values;
  Load<B> source;
  for (int i = 0; i < B; ++i) {
    values[i] = expression([i](const Site& s) { return quadratic<D>(i, place<D>(s)); });
    double divergence = 0;  // constant
    for (int j = 0; j < D; ++j) {
      Point<D> x{};
      x[j] = 1;
      divergence += flux<D, B>(x)[i][j] - flux<D, B>({})[i][j];
    }
    source.value[i] = -divergence;
  }
  for (const std::string& part : fixed) out.fixes.push_back(fix<B>(part, values));
  out.loads.push_back(source);
  for (const std::string& part : loaded) {
    Load<B> traction{Selection{part, {}, ""}, {}};
    for (int i = 0; i < B; ++i)
      traction.value[i] = expression([i](const Site& s) {
        double t = 0;
        for (int j = 0; j < D; ++j) t += flux<D, B>(place<D>(s))[i][j] * s.n[j];
        return t;
      });
    out.loads.push_back(traction);
  }
  return out;
}

template <int D>
Mesh<D> refined(const Mesh<D>& coarse) {
  Mesh<D> fine;
  refine_uniformly(coarse, fine);
  return fine;
}

template <int D>
Mesh<D> distorted_and_turned() {
  Mesh<D> mesh = distorted_mesh<D>(2);
  rotate_mesh(mesh);
  return refined(mesh);
}

template <int D>
void expect_stress(const Point<D>& x, const Stress& stress) {
  const Gradient<D, D> expected = flux<D, D>(x);
  for (int i = 0; i < D; ++i) EXPECT_NEAR(stress[i], expected[i][i], 1e-11);
  EXPECT_NEAR(stress[3], expected[0][1], 1e-11);
  if (D == 3) {
    EXPECT_NEAR(stress[4], expected[1][D - 1], 1e-11);
    EXPECT_NEAR(stress[5], expected[0][D - 1], 1e-11);
  }
}

template <int D, int B>
void expect_quadratic_field_exact() {
  const Mesh<D> mesh = distorted_and_turned<D>();
  const Nodes<D> nodes(mesh, 2);
  const Model<B> model =
      held<D, B>({"left", "bottom"}, D == 2 ? std::vector<std::string>{"right", "top"}
                                            : std::vector<std::string>{"right", "top", "front", "back"});
  const auto discrete = discretize<D, B>(nodes, model);
  const auto u = solve_dense(discrete.problem);
  EXPECT_LT((max_nodal_error<D, B>(nodes, u, value<D, B>)), 1e-12);
  EXPECT_LT((l2_error<D, B>(nodes, u, value<D, B>)), 1e-12);
  EXPECT_LT((energy_error<D, B>(nodes, model, u, slope<D, B>)), 1e-11);
  EXPECT_GT((energy_error<D, B>(Nodes<D>(mesh), model, u, slope<D, B>)), 1e-2) << "linear elements do not hold it";
  Point<D> inside{};
  for (int i = 0; i < D; ++i) inside[i] = 0.43 + 0.1 * i;
  Eigen::Map<Eigen::Matrix<double, D, 1>>(inside.data()) = rotation<D>() * vector<D>(inside);
  const auto found = evaluate<B>(nodes, locate<D>(mesh, inside, ""), u);
  for (int i = 0; i < B; ++i) EXPECT_NEAR(found[i], quadratic<D>(i, inside), 1e-12);
  if constexpr (B == D) {
    const auto stress = nodal_stress<D>(nodes, model, u);
    for (Index v = 0; v < mesh.vertices(); ++v) expect_stress<D>(mesh.points[v], stress[v]);
    EXPECT_EQ(element_stress<D>(nodes, model, u).size(), mesh.families.size());
  }
}

TEST(Quadratic, FieldsAreExactOnDistortedMeshes) {
  expect_quadratic_field_exact<2, 1>();
  expect_quadratic_field_exact<3, 1>();
  expect_quadratic_field_exact<2, 2>();
  expect_quadratic_field_exact<3, 3>();
}

/// Linear fields, on elements that are curved everywhere.
template <int D, int B>
void expect_linear_field_exact_on_curved_elements() {
  Mesh<D> mesh = distorted_and_turned<D>();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  std::vector<char> corner(mesh.points.size());
  for (const Family<D>& family : mesh.families)
    for (int a = 0; a <= D; ++a) corner[family[a]] = 1;
  for (Index v = 0; v < mesh.vertices(); ++v)
    for (double& c : mesh.points[v]) c += corner[v] ? 0 : shift(random);
  const Nodes<D> nodes(mesh, 2);
  Model<B> model = signorini::testing::model<D, B>();
  model.diffusion = expression([](const Site&) { return 2.0; });
  const auto linear = [](int i, const Point<D>& x) { return 0.2 - i + x[0] * (1 + i) - 0.3 * x[1] + x[D - 1] / 2; };
  std::array<std::optional<Field>, B> values;
  for (int i = 0; i < B; ++i) values[i] = expression([=](const Site& s) { return linear(i, place<D>(s)); });
  model.fixes.push_back(fix<B>({}, values));
  const auto discrete = discretize<D, B>(nodes, model);
  const auto u = solve_dense(discrete.problem);
  const auto exact = [=](const Point<D>& x) {
    std::array<double, B> out;
    for (int i = 0; i < B; ++i) out[i] = linear(i, x);
    return out;
  };
  EXPECT_LT((max_nodal_error<D, B>(nodes, u, exact)), 1e-12);
  EXPECT_LT((l2_error<D, B>(nodes, u, exact)), 1e-12);
  const auto at = locate<D>(mesh, mesh.points[mesh.families[3][D + 2]], "");
  EXPECT_NEAR(evaluate<B>(nodes, at, u)[0], linear(0, mesh.points[mesh.families[3][D + 2]]), 1e-12);
}

TEST(Quadratic, LinearFieldsAreExactOnCurvedElements) {
  expect_linear_field_exact_on_curved_elements<2, 1>();
  expect_linear_field_exact_on_curved_elements<3, 1>();
  expect_linear_field_exact_on_curved_elements<2, 2>();
  expect_linear_field_exact_on_curved_elements<3, 3>();
}

/// A bar of two materials between its ends: what is exact is linear in each.
TEST(Quadratic, ElementsKnowTheirMaterial) {
  Mesh<2> coarse = unit_mesh<2>(4);
  for (const Simplex<2>& e : coarse.elements) coarse.region.push_back(centroid<2>(coarse, e)[0] < 0.5 ? -1 : 0);
  const Mesh<2> mesh = refined(coarse);
  const Nodes<2> nodes(mesh, 2);
  Model<1> model;
  model.diffusion = expression([](const Site& s) { return s.region < 0 ? 1.0 : 3.0; });
  model.fixes = {fix<1>("left", {Field(0.0)}), fix<1>("right", {Field(1.0)})};
  const auto u = solve_dense(discretize<2, 1>(nodes, model).problem);
  const auto exact = [](const Point<2>& x) { return std::array{x[0] < 0.5 ? 1.5 * x[0] : 0.75 + 0.5 * (x[0] - 0.5)}; };
  EXPECT_LT((max_nodal_error<2, 1>(nodes, u, exact)), 1e-13);
}

template <int K>
void expect_positive_means() {
  constexpr std::size_t nodes = element_nodes<K, 2>;
  std::array<double, nodes> mean{};
  for (const auto& [barycentric, weight] : quadrature2<K>()) {
    double sum = 0;
    for (std::size_t a = 0; a < nodes; ++a) {
      sum += basis<2>(barycentric)[a];
      mean[a] += weight * basis<2>(barycentric)[a];
    }
    EXPECT_NEAR(sum, 1, 1e-15);
  }
  for (std::size_t a = 0; a < nodes; ++a) {
    EXPECT_GT(mean[a], 0);
    EXPECT_NEAR(mean[a], (basis_mean<2, K>(a)), 1e-15);
  }
}

TEST(Quadratic, BasisFunctionsHavePositiveMeansAndSumToOne) {
  expect_positive_means<1>();
  expect_positive_means<2>();
  expect_positive_means<3>();
}

TEST(Quadratic, CoefficientsAreNotValues) {
  const Mesh<2> mesh = refined(unit_mesh<2>(3));
  const Nodes<2> nodes(mesh, 2);
  std::vector<double> values;
  for (const Point<2>& x : mesh.points) values.insert(values.end(), {quadratic<2>(0, x), quadratic<2>(1, x)});
  const std::vector<double> coefficients = nodes.at_nodes(values, 2), back = nodes.at_vertices(coefficients, 2);
  double most = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(back[k], values[k], 1e-14);
    most = std::max(most, std::abs(coefficients[k] - values[k]));
  }
  EXPECT_GT(most, 1e-3);
  for (Index p = 0; p < nodes.size(); ++p)
    EXPECT_NEAR(nodes.coefficient(p, [&](Index q) { return quadratic<2>(0, nodes.at(q)); }), coefficients[2 * p],
                1e-14);
  // As the basis functions have them: at a point inside.
  const Point<2> x{0.41, 0.56};
  EXPECT_NEAR(evaluate<2>(nodes, locate<2>(mesh, x, ""), coefficients)[1], quadratic<2>(1, x), 1e-14);
}

/// A constant traction on part of the boundary: what its nodes get is what their areas say, so that pressures are
/// right.
template <int D>
void expect_constant_traction() {
  const Mesh<D> mesh = distorted_and_turned<D>();
  const Nodes<D> nodes(mesh, 2);
  const Surface<D> top = surface(nodes, select_faces(mesh, {"top", {}, ""}, 1));
  const std::vector<double> areas = node_areas(nodes, top);
  Model<1> model;
  model.loads.push_back({Selection{"top", {}, ""}, {Field(1.0)}});
  const auto b = load_vector<D, 1>(nodes, model);
  double sum = 0;
  for (std::size_t k = 0; k < top.nodes.size(); ++k) {
    EXPECT_NEAR(areas[k], b[top.nodes[k]], 1e-15);
    EXPECT_GT(areas[k], 0);
    sum += areas[k];
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  double volume = 0;
  for (const double part : node_volumes(nodes)) {
    EXPECT_GT(part, 0);
    volume += part;
  }
  EXPECT_NEAR(volume, 1, 1e-14);
}

TEST(Quadratic, ConstantTractions) {
  expect_constant_traction<2>();
  expect_constant_traction<3>();
}

/// Bounds through a quadratic function: what coefficients are bounded by are those of that function.
TEST(Quadratic, BoundsAreThoseOfCoefficients) {
  const Mesh<2> mesh = refined(unit_mesh<2>(3));
  const Nodes<2> nodes(mesh, 2);
  const auto rule = [](const SurfaceVertex& v) {
    const double psi = quadratic<2>(0, {v.position[0], v.position[1]});
    return bound<1>({1}, psi, psi + 0.001);
  };
  Model<1> model;
  model.obstacles.push_back(term<1>(rule, {}));
  const auto problem = discretize<2, 1>(nodes, model).problem;
  for (Index slot = 0; slot < problem.constraints.size(); ++slot) {
    const Index p = problem.constraints.vector[slot];
    const double expected = nodes.coefficient(p, [&](Index q) { return quadratic<2>(0, nodes.at(q)); });
    EXPECT_NEAR(problem.constraints.lower[slot], expected, 1e-14);
    EXPECT_NEAR(problem.constraints.upper[slot], expected + 0.001, 1e-14);
  }
}

/// Bounds of a scalar unknown on the unit square or cube, as functions of x.
template <int D>
DiscreteProblem<1> bounded(int cells, const std::function<double(double)>& lower,
                           const std::function<double(double)>& upper) {
  const Mesh<D> mesh = refined(unit_mesh<D>(cells));
  Model<1> model;
  const auto rule = [=](const SurfaceVertex& v) { return bound<1>({1}, lower(v.position[0]), upper(v.position[0])); };
  model.obstacles.push_back(term<1>(rule, {}));
  return discretize<D, 1>(Nodes<D>(mesh, 2), model).problem;
}

/// No quadratic function jumps: where bounds do, within an edge or twice in it, those of coefficients are the
/// obstacle's own, and none is off by a part of the jump.
template <int D>
void expect_jumps_stay_where_they_are() {
  for (const double at : {0.3, 0.4, 0.5, 0.55, 0.65}) {
    const auto step = [=](double x) { return x < at ? 0.0 : -1.0; };
    const auto bump = [=](double x) { return std::abs(x - at) < 0.11 ? 0.0 : -1e30; };
    const auto gone = [=](double x) { return x < at ? 0.0 : -infinity; };
    for (const std::function<double(double)>& lower : {std::function<double(double)>(step), {bump}, {gone}}) {
      const auto upper = [&](double x) { return 1 - lower(1 - x); };
      const auto problem = bounded<D>(3, lower, upper);
      for (Index slot = 0; slot < problem.constraints.size(); ++slot) {
        const double low = problem.constraints.lower[slot], high = problem.constraints.upper[slot];
        EXPECT_TRUE(low == lower(0) || low == lower(1) || low == lower(at)) << low;
        EXPECT_TRUE(high == upper(0) || high == upper(1) || high == upper(1 - at)) << high;
      }
    }
  }
}

TEST(Quadratic, BoundsThatJumpAreNotExtrapolated) {
  expect_jumps_stay_where_they_are<2>();
  expect_jumps_stay_where_they_are<3>();
}

/// What limits jumps leaves smooth bounds alone, up to third order: also where they turn and where their curvature
/// changes its sign.
TEST(Quadratic, SmoothBoundsKeepTheirCoefficients) {
  const auto psi = [](double x) { return std::sin(7 * x); };
  double last = 0;
  for (const int cells : {4, 8, 16}) {
    const Mesh<2> mesh = refined(unit_mesh<2>(cells));
    const Nodes<2> nodes(mesh, 2);
    const auto problem = bounded<2>(cells, psi, [](double) { return infinity; });
    double worst = 0;
    for (Index slot = 0; slot < problem.constraints.size(); ++slot) {
      const Index p = problem.constraints.vector[slot];
      const double expected = nodes.coefficient(p, [&](Index q) { return psi(nodes.at(q)[0]); });
      const double off = std::abs(problem.constraints.lower[slot] - expected);
      if (std::abs(psi(nodes.at(p)[0])) > 4.0 / cells) EXPECT_LT(off, 1e-14);
      worst = std::max(worst, off);
    }
    if (last > 0) EXPECT_LT(worst, last / 6);
    last = worst;
  }
}

/// Prescribed values touch an obstacle at midpoints of edges, where their coefficients are beyond its own.
TEST(Quadratic, PrescribedValuesThatTouchAnObstacleAreNoContradiction) {
  const Mesh<2> mesh = refined(unit_mesh<2>(1));
  const auto touching = [](double x) { return (x - 0.5) * (x - 0.5); };
  Model<1> model;
  model.fixes = {fix<1>("bottom", {expression([=](const Site& s) { return touching(s.x[0]); })})};
  model.obstacles.push_back(term<1>([](const SurfaceVertex&) { return bound<1>({1}, 0, infinity); }, {}));
  EXPECT_NO_THROW((discretize<2, 1>(Nodes<2>(mesh, 2), model)));
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({1}, 1e-3, infinity); }, {})};
  EXPECT_THROW((discretize<2, 1>(Nodes<2>(mesh, 2), model)), Error);
}

// Linear functions on the mesh that has been cut are among the quadratic ones.
template <int D, int B>
void expect_galerkin() {
  const MeshHierarchy<D> meshes = hierarchy(distorted_mesh<D>(3), 1);
  const auto nodes = nodes_of(meshes, 2);
  const Model<B> model = signorini::testing::model<D, B>();
  const auto coarse = discretize<D, B>(nodes[0], model), fine = discretize<D, B>(nodes[1], model);
  const Prolongation P = prolongations(meshes, nodes)[0];
  EXPECT_TRUE(is_galerkin<B>(coarse.problem, P, fine.problem));
  const auto cut = discretize<D, B>(Nodes<D>(meshes.finest()), model);
  EXPECT_GT((dense(fine.problem.A) - dense(cut.problem.A)).norm(), dense(cut.problem.A).norm() / 10);
}

TEST(Quadratic, LinearElementsAreTheFirstCoarsening) {
  expect_galerkin<2, 1>();
  expect_galerkin<3, 1>();
  expect_galerkin<2, 2>();
  expect_galerkin<3, 3>();
}

TEST(Quadratic, RefusesElementsThatAreTurnedInsideOut) {
  Mesh<2> mesh = refined(unit_mesh<2>(2));
  const Family<2>& family = mesh.families[0];
  for (int i = 0; i < 2; ++i)  // a midpoint beyond the corner opposite to it
    mesh.points[family[3]][i] = 2 * mesh.points[family[2]][i] - mesh.points[family[3]][i];
  Model<2> model = signorini::testing::model<2, 2>();
  EXPECT_THROW((stiffness<2, 2>(Nodes<2>(mesh, 2), model)), Error);
}

}  // namespace
}  // namespace signorini::testing
