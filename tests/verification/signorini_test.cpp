// Signorini problems with known solutions in the half plane y > 0, contact on y = 0 for one sign of x.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <complex>

#include "core/fem/recovery/error_norm.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

using Complex = std::complex<double>;

/// u = r^(3/2) cos(3 theta / 2): free for x > 0, on the obstacle for x < 0.
const SceneText scalar{.body = R"(
shape = "rectangle"
from = [-1, 0]
to = [1, 1]
cells = [4, 2]
equation = "diffusion")",
                       .fixes = {R"(
where = "y == 1 || abs(x) == 1"
value = ['(x^2 + y^2)^0.75*cos(1.5*atan2(y, x))'])"},
                       .obstacle = "type = \"scalar\"\non = \"bottom\"\nlower = 0"};

TEST(Signorini, OrderOfTheScalarProblem) {
  // u = Re z^(3/2), whose derivative is 3/2 z^(1/2) = u_x - i u_y.
  const auto gradient = [](const Point<2>& x) {
    const Complex d = 1.5 * std::sqrt(Complex(x[0], x[1]));
    return Gradient<2, 1>{Point<2>{d.real(), -d.imag()}};
  };
  Errors energy;
  for (int k = 0; k <= 6; ++k) {
    const auto r = run<2, 1>(scalar, {uniform(k)});
    energy.add(energy_error<2, 1>(r.mesh(), r.model, r.u(), gradient));
    if (k == 6) {
      for (const auto& node : r.results.contact.nodes) {
        const double x = r.mesh().points[node.vertex][0];
        EXPECT_TRUE(node.contact == (x < 0) || std::abs(x) <= 1.0 / 128) << "x = " << x;
      }
    }
    show("scalar: {:.4e}, order {:.2f}\n", energy.value.back(), energy.last_order());
  }
  energy.expect_falling();
  EXPECT_GE(energy.mean_order(), 0.9);
  EXPECT_GE(energy.last_order(), 0.95);
}

/// Plane strain, mu = 1, nu = 0.3; z = x + iy, Z = -1.5 z^(1/2), derivative of Zb = -z^(3/2).
struct Elastic {
  static constexpr double nu = 0.3;

  static Gradient<2, 2> gradient(const Point<2>& x) {
    const Complex z(x[0], x[1]), Z = -1.5 * std::sqrt(z), dZ = -0.75 / std::sqrt(z);
    const double y = x[1];
    // d/dx Zb = Z, d/dy Zb = i Z; d/dx Z = Z', d/dy Z = i Z'.
    const double xx = (1 - 2 * nu) * Z.real() - y * dZ.imag();
    const double xy = -(1 - 2 * nu) * Z.imag() - Z.imag() - y * dZ.real();
    const double yx = 2 * (1 - nu) * Z.imag() - y * dZ.real();
    const double yy = 2 * (1 - nu) * Z.real() - Z.real() + y * dZ.imag();
    return {Point<2>{xx / 2, xy / 2}, Point<2>{yx / 2, yy / 2}};
  }
};

TEST(Signorini, OrderOfTheElasticProblem) {
  Errors energy;
  for (int k = 1; k <= 6; ++k) {
    const auto r = run_shipped<2, 2>("signorini_elastic_2d.toml", {uniform(k)});
    energy.add(energy_error<2, 2>(r.mesh(), r.model, r.u(), Elastic::gradient));
    show("elastic: {:.4e}, order {:.2f}, force {:.5f}, {} cycles\n", energy.value.back(), energy.last_order(),
         r.contact().force[1], r.summary().iterations);
  }
  energy.expect_falling();
  EXPECT_GE(energy.mean_order(), 0.9);
  EXPECT_GE(energy.last_order(), 0.95);
}

// Half an edge of the contact belongs to the corner at x = 1, whose displacement is prescribed.
TEST(Signorini, ForceOfTheElasticProblem) {
  Errors force;
  for (int k = 2; k <= 6; ++k) {
    const auto r = run_shipped<2, 2>("signorini_elastic_2d.toml", {uniform(k)});
    force.add(std::abs(r.contact().force[1] - 1));
    EXPECT_EQ(r.contact().undetermined_nodes, 1);
    show("elastic: force off by {:.2e}, order {:.2f}\n", force.value.back(), force.last_order());
  }
  force.expect_falling();
  EXPECT_GE(force.mean_order(), 1.3);
  EXPECT_LE(force.value.back(), 1e-3);
}

/// Largest relative difference of the pressure from 1.5 sqrt(x), away from the ends of the contact.
template <class Pressure>
double pressure_error(const Run<2, 2>& r, const Pressure& pressure) {
  double largest = 0;
  for (const auto& node : r.results.contact.nodes) {
    const double x = r.mesh().points[node.vertex][0];
    if (x < 0.15 || x > 0.85) continue;
    const double exact = 1.5 * std::sqrt(x);
    largest = std::max(largest, std::abs(pressure(node) - exact) / exact);
  }
  return largest;
}

TEST(Signorini, ContactPressureOfTheElasticProblem) {
  Errors nodal, recovered;
  for (int k = 4; k <= 6; ++k) {
    const auto r = run_shipped<2, 2>("signorini_elastic_2d.toml", {uniform(k)});
    nodal.add(pressure_error(r, [](const auto& node) { return node.pressure; }));
    recovered.add(pressure_error(r, [](const auto& node) { return node.recovered; }));
  }
  show("pressure: nodal {}, recovered {}\n", fmt::join(nodal.value, " "), fmt::join(recovered.value, " "));
  nodal.expect_falling();
  EXPECT_LE(nodal.value.back(), 0.01);
  EXPECT_GE(nodal.mean_order(), 0.8);
  recovered.expect_falling();
  EXPECT_LE(recovered.value.back(), nodal.value.back());
}

// Contact for x in (0, 1).
TEST(Signorini, WidthOfTheContactOfTheElasticProblem) {
  Errors width;
  for (int k = 2; k <= 6; ++k) {
    const auto r = run_shipped<2, 2>("signorini_elastic_2d.toml", {uniform(k)});
    width.add(std::abs(r.contact().area - 1));
    show("width off by {:.2e}, {:.2f} edges\n", width.value.back(), width.value.back() / (0.5 / (1 << k)));
    EXPECT_LE(width.value.back(), 0.1 * 0.5 / (1 << k));
  }
}

TEST(Signorini, ContactSetAndGapOfTheElasticProblem) {
  const auto r = run_shipped<2, 2>("signorini_elastic_2d.toml", {uniform(6)});
  const double h = 0.5 / 64;
  for (const auto& node : r.results.contact.nodes) {
    const double x = r.mesh().points[node.vertex][0];
    EXPECT_TRUE(node.contact == (x > 0) || std::abs(x) <= 2 * h) << "x = " << x;
    if (x < -0.1) {
      const double exact = 0.7 * std::pow(-x, 1.5);
      EXPECT_NEAR(node.gap, exact, 0.01 * exact) << "x = " << x;
    }
  }
}

}  // namespace
}  // namespace signorini::test
