#include <gtest/gtest.h>

#include "core/fem/recovery/error_norm.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/solver/convergence.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

// Some linear field, component i at x.
template <int D, int B>
double linear(int i, const double* x) {
  double v = 0.3 - i;
  for (int j = 0; j < D; ++j) v += (0.2 * i - 0.5 * j + 0.7) * x[j];
  return v;
}

template <int D, int B>
void expect_linear_field_exact(Plane plane) {
  Mesh<D> mesh = distorted_mesh<D>(3);
  rotate_mesh(mesh);
  Model<B> model;
  model.young = 7;
  model.poisson = 0.3;
  model.plane = plane;
  std::array<std::optional<Field>, B> value;
  for (int i = 0; i < B; ++i) value[i] = expression([i](const Site& s) { return linear<D, B>(i, s.x); });
  model.fixes.push_back(fix<B>({}, value));
  const auto discrete = discretize(mesh, model);
  EXPECT_TRUE(discrete.problem.frames.slot.empty());
  const auto x = solve_dense(discrete.problem);
  const double error = max_nodal_error<D, B>(mesh, x, [](const Point<D>& p) {
    std::array<double, B> v;
    for (int i = 0; i < B; ++i) v[i] = linear<D, B>(i, p.data());
    return v;
  });
  EXPECT_LT(error, 1e-13);
}

TEST(Patch, LinearFieldsAreExactOnDistortedMeshes) {
  expect_linear_field_exact<2, 1>(Plane::strain);
  expect_linear_field_exact<3, 1>(Plane::strain);
  expect_linear_field_exact<2, 2>(Plane::strain);
  expect_linear_field_exact<2, 2>(Plane::stress);
  expect_linear_field_exact<3, 3>(Plane::strain);
}

// A block on symmetry planes through one corner, pulled with stress s along x; turned in space when asked to.
template <int D>
void expect_uniaxial_tension(Plane plane, bool turned, const Point<D>& strain, double stress_zz) {
  const double s = 0.25, E = 2, nu = 0.3;
  Mesh<D> mesh = distorted_mesh<D>(2);
  using Matrix = Eigen::Matrix<double, D, D>;
  const Matrix R = turned ? rotation<D>() : Matrix::Identity();
  if (turned) rotate_mesh(mesh);
  Model<D> model;
  model.young = E;
  model.poisson = nu;
  model.plane = plane;
  const std::vector<std::string> planes =
      D == 2 ? std::vector<std::string>{"left", "bottom"} : std::vector<std::string>{"left", "front", "bottom"};
  for (const std::string& part : planes) {
    model.fixes.push_back(fix<D>(part, {}, Frame::normal));
    model.fixes.back().value[0] = 0;
  }
  Load<D> pull{Selection{"right", {}, ""}, {}};
  for (int i = 0; i < D; ++i) pull.value[i] = s * R(i, 0);
  model.loads.push_back(pull);
  const auto discrete = discretize(mesh, model);
  EXPECT_EQ(discrete.problem.frames.slot.empty(), !turned);
  const auto u = to_global(discrete.problem, solve_dense(discrete.problem));
  const Matrix G = R * vector<D>(strain).asDiagonal() * R.transpose();
  for (Index p = 0; p < mesh.vertices(); ++p)
    for (int i = 0; i < D; ++i) EXPECT_NEAR(u[p * D + i], (G * vector<D>(mesh.points[p]))[i], 1e-14);

  const auto stress = element_stress(mesh, model, u);
  const Eigen::Matrix<double, D, 1> axis = R.col(0);
  for (const Stress& t : stress) {
    EXPECT_NEAR(t[0], s * axis[0] * axis[0], 1e-13);
    EXPECT_NEAR(t[1], s * axis[1] * axis[1], 1e-13);
    EXPECT_NEAR(t[3], s * axis[0] * axis[1], 1e-13);
    EXPECT_NEAR(t[2], D == 3 ? s * axis[D - 1] * axis[D - 1] : stress_zz, 1e-13);
    EXPECT_NEAR(t[4], D == 3 ? s * axis[1] * axis[D - 1] : 0, 1e-13);
    EXPECT_NEAR(t[5], D == 3 ? s * axis[0] * axis[D - 1] : 0, 1e-13);
    if (stress_zz == 0) {
      EXPECT_NEAR(von_mises(t), s, 1e-13);
    }
  }
  for (const Stress& t : nodal_stress(Nodes(mesh), model, u)) EXPECT_NEAR(t[0], s * axis[0] * axis[0], 1e-13);

  double work = 0;  // the energy is minus half the work of the load
  for (int i = 0; i < D; ++i) work += s * strain[0] * R(i, 0) * R(i, 0);
  EXPECT_NEAR(energy(discrete.problem, to_local(discrete.problem, u)), -0.5 * work, 1e-14);
}

TEST(Patch, UniaxialTensionBetweenSymmetryPlanes) {
  const double s = 0.25, E = 2, nu = 0.3;
  for (const bool turned : {false, true}) {
    expect_uniaxial_tension<2>(Plane::stress, turned, {s / E, -nu * s / E}, 0);
    expect_uniaxial_tension<2>(Plane::strain, turned, {(1 - nu * nu) * s / E, -nu * (1 + nu) * s / E}, nu * s);
    expect_uniaxial_tension<3>(Plane::strain, turned, {s / E, -nu * s / E, -nu * s / E}, 0);
  }
}

TEST(ErrorNorm, MatchesTheIntegralOfAKnownField) {
  const Mesh<2> mesh = distorted_mesh<2>(3);
  Model<1> model;
  model.diffusion = 4;
  const std::vector<double> zero(mesh.points.size());
  // u = x^2 y: |grad u|^2 = 4 x^2 y^2 + x^4.
  const double norm = energy_error<2, 1>(mesh, model, zero, [](const Point<2>& x) {
    return Gradient<2, 1>{{{2 * x[0] * x[1], x[0] * x[0]}}};
  });
  EXPECT_NEAR(norm, std::sqrt(4 * (4.0 / 9 + 1.0 / 5)), 1e-13);
}

TEST(ErrorNorm, ElasticEnergyIsThatOfTheMatrix) {
  const Mesh<3> mesh = distorted_mesh<3>(2);
  Model<3> model;
  model.young = 5;
  model.poisson = 0.2;
  std::vector<double> u(mesh.points.size() * 3);
  std::mt19937 random(3);
  for (double& v : u) v = std::uniform_real_distribution<double>(-1, 1)(random);
  const auto discrete = discretize(mesh, model);
  const double norm = energy_error<3, 3>(mesh, model, u, [](const Point<3>&) { return Gradient<3, 3>{}; });
  EXPECT_NEAR(norm * norm, 2 * energy(discrete.problem, u), 1e-12 * norm * norm);
}

TEST(Energy, IncludesPrescribedValues) {
  const Mesh<2> mesh = distorted_mesh<2>(3);
  Model<1> model;
  model.fixes = {fix<1>("left", {expression([](const Site& s) { return 1 + s.x[1]; })}),
                 fix<1>("right", {Field(-2.0)})};
  model.loads = {{{}, {3.0}}};
  const auto discrete = discretize(mesh, model);
  const auto x = solve_dense(discrete.problem);
  const double norm = energy_error<2, 1>(mesh, model, x, [](const Point<2>&) { return Gradient<2, 1>{}; });
  Model<1> load_only;
  load_only.loads = model.loads;
  const auto b = discretize(mesh, load_only).problem.b;
  double work = 0;
  for (std::size_t p = 0; p < x.size(); ++p) work += b[p] * x[p];
  EXPECT_NEAR(energy(discrete.problem, x), 0.5 * norm * norm - work, 1e-12);
}

}  // namespace
}  // namespace signorini::testing
