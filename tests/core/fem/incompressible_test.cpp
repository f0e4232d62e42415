// The load of a pressure with unknowns of its own, and stresses that know it, for linear displacements.
#include <gtest/gtest.h>

#include "core/fem/incompressible/pressure_load.hpp"
#include "core/fem/recovery/stress_reader.hpp"
#include "core/mesh/refine.hpp"
#include "core/solver/local_coordinates.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

constexpr double young = 2, poisson = 0.49;

template <int D>
Material<D> rubber() {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

/// Nearly incompressible material on quadratic elements.
template <int D>
class Rubber {
 public:
  explicit Rubber(Pressure kind, std::vector<Fix<D>> fixes = {})
      : meshes_(hierarchy(unit_mesh<D>(2), 1)), nodes_(meshes_.finest(), 2) {
    model.young = young;
    model.poisson = poisson;
    model.pressure = kind;
    model.fixes = std::move(fixes);
    space = pressure_space(nodes_, model);
    discretization = discretize<D, D>(nodes_, model);
  }
  const Nodes<D>& nodes() const { return nodes_; }
  /// Coefficients of x -> G x, which are values for linear functions.
  std::vector<double> linear(const Eigen::Matrix<double, D, D>& G) const {
    std::vector<double> u;
    for (Index p = 0; p < nodes_.size(); ++p) {
      const Eigen::Matrix<double, D, 1> v = G * vector<D>(nodes_.at(p));
      u.insert(u.end(), v.begin(), v.end());
    }
    return u;
  }

  Model<D> model;
  PressureSpace<D> space;
  Discretization<D> discretization;

 private:
  MeshHierarchy<D> meshes_;
  Nodes<D> nodes_;
};

/// Gradients with a known trace.
template <int D>
Eigen::Matrix<double, D, D> some_gradient() {
  Eigen::Matrix<double, D, D> G;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) G(i, j) = 0.1 * (i + 1) - 0.07 * j * j + 0.03;
  return G;
}

// A uniform pressure p does the work p tr(G) V along x -> G x; what is left of the energy is p^2 V / (lambda -
// lambda0).
template <int D>
void expect_work(Pressure kind) {
  Rubber<D> body(kind);
  const double p = 1.7, left = lambda_of_pressure(rubber<D>());
  PressureLoad<D> load(body.space, body.discretization, std::vector<double>(body.space.size, p));
  DiscreteProblem<D>& problem = body.discretization.problem;
  const std::vector<double> before = problem.b, u = body.linear(some_gradient<D>());
  load.apply();
  double work = 0;
  for (std::size_t i = 0; i < u.size(); ++i) work -= (problem.b[i] - before[i]) * u[i];
  EXPECT_NEAR(work, p * some_gradient<D>().trace(), 1e-12);
  EXPECT_NEAR(load.squared(), p * p / left, 1e-12);
  const std::vector<double> applied = problem.b;
  load.apply();  // once is enough
  EXPECT_EQ(problem.b, applied);
  load.withdraw();
  EXPECT_EQ(problem.b, before);
  load.withdraw();
  EXPECT_EQ(problem.b, before);
  load.set(std::vector<double>(body.space.size, 2 * p));
  EXPECT_EQ(problem.b, before);  // no part of it yet
  EXPECT_EQ(load.values().front(), 2 * p);
}

TEST(PressureLoad, DoesTheWorkOfAPressure) {
  for (const Pressure kind : {Pressure::linear, Pressure::constant}) {
    expect_work<2>(kind);
    expect_work<3>(kind);
  }
}

// p = (lambda - lambda0) div u is the pressure of u: nothing is to be corrected. From zero the way there is right.
template <int D>
void expect_correction(Pressure kind) {
  Rubber<D> body(kind);
  const Eigen::Matrix<double, D, D> G = some_gradient<D>();
  const double p = lambda_of_pressure(rubber<D>()) * G.trace();
  const std::vector<double> u = body.linear(G);
  PressureLoad<D> load(body.space, body.discretization, std::vector<double>(body.space.size, p));
  std::vector<double> change, residual;
  load.correct(u, change, residual);
  for (const double r : residual) EXPECT_NEAR(r, 0, 1e-13);
  for (const double c : change) EXPECT_NEAR(c, 0, 1e-11);
  load.set(std::vector<double>(body.space.size, 0));
  load.correct(u, change, residual);
  for (const double c : change) {
    EXPECT_GT(c / p, 0);
    EXPECT_LT(c / p, 1);  // what the displacements answer is left out
  }
  // Added, it is in b and in the residual alike.
  DiscreteProblem<D>& problem = body.discretization.problem;
  load.apply();
  std::vector<double> r = problem.b;
  load.add(change, r);
  for (std::size_t i = 0; i < r.size(); ++i) EXPECT_NEAR(r[i], problem.b[i], 1e-15);
  EXPECT_EQ(load.values(), change);
}

TEST(PressureLoad, IsCorrectedTowardsThePressureOfTheDisplacements) {
  for (const Pressure kind : {Pressure::linear, Pressure::constant}) {
    expect_correction<2>(kind);
    expect_correction<3>(kind);
  }
}

// What C and M say one by one is what the load does.
template <int D>
void expect_matrices() {
  Rubber<D> body(Pressure::linear, {fix<D>("left", [] {
                   std::array<std::optional<Field>, D> all;
                   all.fill(0);
                   return all;
                 }())});
  std::vector<double> p(body.space.size);
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = std::sin(static_cast<double>(k));
  PressureLoad<D> load(body.space, body.discretization, p);
  const auto m = load.matrices();
  const DiscreteProblem<D>& problem = body.discretization.problem;
  std::vector<double> wanted = problem.b;
  double squared = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    EXPECT_TRUE(std::is_sorted(m.column.begin() + m.row[k], m.column.begin() + m.row[k + 1]));
    for (Offset at = m.row[k]; at < m.row[k + 1]; ++at)
      for (int i = 0; i < D; ++i) wanted[Offset{m.column[at]} * D + i] -= p[k] * m.value[at * D + i];
    for (Offset at = m.mass_row[k]; at < m.mass_row[k + 1]; ++at) squared += p[k] * m.mass[at] * p[m.mass_column[at]];
  }
  load.apply();
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(problem.b[i], wanted[i], 1e-14);
  EXPECT_NEAR(load.squared(), squared, 1e-13 * squared);
  // Reactions know what presses on what is held: all of it together is in balance.
  const std::vector<double> before = body.discretization.prescribed.load;
  load.press_on_prescribed();
  Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
  const std::vector<double>& held = body.discretization.prescribed.load;
  for (std::size_t i = 0; i < held.size(); ++i) sum[i % D] += held[i] - before[i];
  for (std::size_t q = 0; q < problem.fixed.size(); ++q)
    for (int k = 0; k < D; ++k)
      if (!(problem.fixed[q] >> k & 1u)) sum[k] += problem.b[q * D + k];  // without any other load
  EXPECT_LT(sum.norm(), 1e-13);
}

TEST(PressureLoad, HasTheMatricesItActsBy) {
  expect_matrices<2>();
  expect_matrices<3>();
}

/// What one correction leaves of the constant part of the residual of a body that swells and is held at some part.
template <int D>
double left_by_one_correction(const std::optional<std::string>& held) {
  std::array<std::optional<Field>, D> swelling;
  for (int i = 0; i < D; ++i) swelling[i] = expression([i](const Site& s) { return 0.01 * s.x[i]; });
  Rubber<D> body(Pressure::linear, {fix<D>(held, swelling)});
  PressureLoad<D> load(body.space, body.discretization, {});
  std::vector<double> change, residual, none;
  const std::vector<double> u =
      to_local(body.discretization.problem, body.linear(0.01 * Eigen::Matrix<double, D, D>::Identity()));
  const auto constant = [&] {
    load.correct(u, change, residual);
    double sum = 0;
    for (const double r : residual) sum += r;
    return sum;
  };
  const double before = constant();
  EXPECT_NEAR(before, 0.01 * D, 1e-13);  // the divergence over the body, for p = 0
  load.apply();
  load.add(change, none);
  return constant() / before;
}

// Where all is held nothing but compression resists a constant pressure: it is found at once. Else the displacements
// answer for most of it.
template <int D>
void expect_shut_in() {
  EXPECT_LT(std::abs(left_by_one_correction<D>({})), 0.15);
  EXPECT_GT(left_by_one_correction<D>("left"), 0.5);
}

TEST(PressureLoad, OfABodyThatIsHeldAllAroundIsFoundAtOnce) {
  expect_shut_in<2>();
  expect_shut_in<3>();
}

/// lambda tr(strain) I + 2 mu strain, zz of plane strain included.
template <int D>
Stress hooke(const Material<D>& m, const Eigen::Matrix<double, D, D>& G) {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  g.topLeftCorner<D, D>() = G;
  const Eigen::Matrix3d s = m.lambda * g.trace() * Eigen::Matrix3d::Identity() + m.mu * (g + g.transpose());
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

template <int D, int P>
void expect_read(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                 const OwnPressure<D>& pressure, const Stress& wanted, double measure) {
  const StressReader<D, P> reader(nodes, model, u, pressure);
  double sum = 0;
  for (std::size_t e = 0; e < nodes.template elements<P>().size(); ++e) {
    const ElementMap<D, D, P> map(nodes.mesh(), nodes.template elements<P>()[e]);
    for (const auto& [barycentric, weight] : quadrature2<D>()) {
      const auto read = reader.at(e, map, barycentric);
      for (int i = 0; i < 6; ++i) ASSERT_NEAR(read.stress[i], wanted[i], 1e-11);
      sum += weight * read.measure;
    }
  }
  EXPECT_NEAR(sum, measure, 1e-12);
}

template <int D>
void expect_stress() {
  const Eigen::Matrix<double, D, D> G = some_gradient<D>();
  for (const Pressure kind : {Pressure::none, Pressure::linear, Pressure::constant}) {
    const Rubber<D> body(kind);
    const std::vector<double> u = body.linear(G);
    // With the pressure that belongs to it the stress is that of Hooke's law, whoever has which part.
    const std::vector<double> p(body.space.size, lambda_of_pressure(rubber<D>()) * G.trace());
    const OwnPressure<D> own = kind == Pressure::none ? OwnPressure<D>{} : OwnPressure<D>{&body.space, &p};
    expect_read<D, 2>(body.nodes(), body.model, u, own, hooke<D>(rubber<D>(), G), 1);
    expect_read<D, 1>(Nodes<D>(body.nodes().mesh()), body.model, u, {}, hooke<D>(rubber<D>(), G), 1);
  }
}

TEST(StressReader, ReadsHookesLawForLinearDisplacements) {
  expect_stress<2>();
  expect_stress<3>();
}

TEST(StressReader, KnowsPlaneStress) {
  Rubber<2> body(Pressure::none);
  body.model.plane = Plane::stress;
  const Eigen::Matrix2d G = some_gradient<2>();
  const Material<2> sheet = MaterialLaw<2>(body.model).at({});
  Stress wanted = hooke<2>(sheet, G);
  wanted[2] = 0;
  expect_read<2, 2>(body.nodes(), body.model, body.linear(G), {}, wanted, 1);
  // Pulled along x alone the sheet thins: E times the strain.
  const Eigen::Matrix2d pulled{{1, 0}, {0, -poisson}};
  EXPECT_NEAR(hooke<2>(sheet, pulled)[0], young, 1e-12);
  EXPECT_NEAR((stress<2>(sheet, Gradient<2, 2>{{{1, 0}, {0, -poisson}}}, 0, true)[1]), 0, 1e-12);
}

// u_r = c r, u_z = d z: the hoop strain is the radial one.
TEST(StressReader, KnowsHoops) {
  Rubber<2> body(Pressure::none);
  body.model.plane = Plane::axisymmetric;
  const double c = 0.02, d = -0.01;
  const Material<2> m = rubber<2>();
  const double trace = 2 * c + d;
  const Stress wanted{
      m.lambda * trace + 2 * m.mu * c, m.lambda * trace + 2 * m.mu * d, m.lambda * trace + 2 * m.mu * c, 0, 0, 0};
  const auto u = body.linear(Eigen::Matrix2d{{c, 0}, {0, d}});
  expect_read<2, 2>(body.nodes(), body.model, u, {}, wanted, 1);
  expect_read<2, 1>(Nodes<2>(body.nodes().mesh()), body.model, u, {}, wanted, 1);
}

}  // namespace
}  // namespace signorini::testing
