// Bodies of revolution against closed forms, and against the same body in space.
#include <gmock/gmock.h>

#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_file.hpp"
#include "run.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;

constexpr double E = 1, nu = 0.3, mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
constexpr const char* elastic = "plane = \"axisymmetric\"\norder = 1\nyoung = 1\npoisson = 0.3\n";

std::string fixed(const std::string& where, const std::string& value) {
  return fmt::format("[[fix]]\nbody = \"b\"\n{}\nvalue = {}\n", where, value);
}
std::string loaded(const std::string& where, const std::string& value) {
  return fmt::format("[[load]]\nbody = \"b\"\n{}\nvalue = {}\n", where, value);
}
std::string rectangle_body(const std::string& from, const std::string& to, const std::string& cells) {
  return fmt::format("[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = {}\nto = {}\ncells = {}\n{}", from, to,
                     cells, elastic);
}
std::string plane_obstacle(const std::string& on, const std::string& point, const std::string& normal) {
  return fmt::format(
      "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"{}\"\nshape = \"plane\"\npoint = {}\nnormal = {}\n", on,
      point, normal);
}

/// A tube 1 < r < 2 without axial strain under the pressure p within: G. Lame 1852; u = A r + B / r.
struct Tube {
  static constexpr double a = 1, b = 2, p = 0.01;
  double A, B;

  /// @param held whether a rigid bore holds it outside
  explicit Tube(bool held) {
    const double k = 2 * (lambda + mu);
    A = held ? -p / (k + 2 * mu * b * b / (a * a)) : p * a * a / (k * (b * b - a * a));
    B = held ? -A * b * b : p * a * a * b * b / (2 * mu * (b * b - a * a));
  }
  double displacement(double r) const { return A * r + B / r; }
  double radial(double r) const { return 2 * (lambda + mu) * A - 2 * mu * B / (r * r); }
  double hoop(double r) const { return 2 * (lambda + mu) * A + 2 * mu * B / (r * r); }
};

std::string tube(bool held) {
  return rectangle_body("[1, 0]", "[2, 1]", "[4, 4]") + fixed("where = \"y == 0 || y == 1\"", "[\"free\", 0]") +
         loaded("on = \"left\"", fmt::format("[{}, 0]", Tube::p)) +
         (held ? plane_obstacle("right", "[2, 0]", "[-1, 0]") : "");
}

/// Root of the mean square of hoop and radial stresses at the elements' centroids, relative to the pressure.
double stress_error(const Run<2, 2>& r, const Tube& exact) {
  const auto stress = element_stress(r.nodes(), r.model, r.u());
  double sum = 0;
  for (std::size_t e = 0; e < stress.size(); ++e) {
    const double at = centroid<2>(r.mesh(), r.mesh().elements[e])[0];
    sum += std::pow(stress[e][0] - exact.radial(at), 2) + std::pow(stress[e][2] - exact.hoop(at), 2);
  }
  return std::sqrt(sum / static_cast<double>(stress.size())) / Tube::p;
}

/// Root of the mean square over the body, relative to what is computed.
template <int B>
double mean_error(const Run<2, B>& r, const ExactValue<2, B>& exact) {
  const std::vector<double> volume = node_volumes(r.nodes(), Plane::axisymmetric);
  double error = 0, size = 0;
  for (Index p = 0; p < r.nodes().size(); ++p) {
    const std::array<double, B> wanted = exact(r.nodes().at(p));
    for (int i = 0; i < B; ++i) {
      error += volume[p] * std::pow(r.u()[std::size_t(p) * B + i] - wanted[i], 2);
      size += volume[p] * wanted[i] * wanted[i];
    }
  }
  return std::sqrt(error / size);
}

TEST(Axisymmetric, OrdersOfLamesTube) {
  for (const bool held : {false, true}) {
    const Tube exact(held);
    Errors displacement, stress, force, energy;
    for (int k = 0; k <= 4; ++k) {
      const auto r = run<2, 2>(tube(held), {uniform(k)});
      displacement.add(mean_error<2>(r, [&](const Point<2>& x) { return std::array{exact.displacement(x[0]), 0.0}; }));
      stress.add(stress_error(r, exact));
      const double of_load = -0.5 * Tube::p * exact.displacement(1) * 2 * pi;  // minus half its work, by Clapeyron
      energy.add(std::abs(r.summary().energy / of_load - 1));
      EXPECT_NEAR(r.results.forces.applied[0][0], 2 * pi * Tube::p, 1e-12);
      show("tube: displacement {:.2e} order {:.2f}, stress {:.2e} order {:.2f}, energy {:.2e} order {:.2f}\n",
           displacement.value.back(), displacement.last_order(), stress.value.back(), stress.last_order(),
           energy.value.back(), energy.last_order());
      if (!held) continue;
      force.add(std::abs(r.contact().force[0] / (4 * pi * exact.radial(2)) - 1));
      EXPECT_NEAR(r.contact().area, 4 * pi, 1e-10);
      EXPECT_NEAR(r.contact().max_pressure / -exact.radial(2), 1, 0.05 / (1 << k));
      show("  force in the bore {:.2e} order {:.2f}\n", force.value.back(), force.last_order());
    }
    EXPECT_GE(displacement.last_order(), 1.9);
    EXPECT_GE(energy.last_order(), 1.9);
    EXPECT_GE(stress.last_order(), 0.95);
    EXPECT_TRUE(!held || force.last_order() >= 1.8);
  }
}

/// A hollow sphere 1 < R < 2 under the pressure p within: A. E. H. Love, Mathematical Theory of Elasticity, sec. 98.
TEST(Axisymmetric, OrdersOfLamesHollowSphere) {
  const double a = 1, b = 2, p = 0.01;
  const auto radial = [&](double R) {
    return p * a * a * a / (E * (b * b * b - a * a * a)) * ((1 - 2 * nu) * R + (1 + nu) * b * b * b / (2 * R * R));
  };
  Errors error;
  for (const Index n : {4, 8, 16, 32}) {
    Mesh<2> mesh = rectangle({1, 0}, {2, 1}, {n, n + n / 2});
    for (Point<2>& x : mesh.points) {
      const double angle = pi / 2 * x[1];
      x = {x[0] * std::cos(angle), x[0] * std::sin(angle)};
    }
    const TemporaryFolder folder;
    const auto r = run<2, 2>(fmt::format("[[body]]\nname = \"b\"\nmesh = \"{}\"\n{}",
                                         folder.write("sphere.msh", msh(mesh, Motion<2>())), elastic) +
                             fixed("where = \"abs(y) < 1e-9\"", "[\"free\", 0]") +
                             loaded("where = \"x^2 + y^2 < 1.001\"", fmt::format("[\"-{0}*nx\", \"-{0}*ny\"]", p)));
    error.add(mean_error<2>(r, [&](const Point<2>& x) {
      const double R = std::hypot(x[0], x[1]), u = radial(R);
      return std::array{u * x[0] / R, u * x[1] / R};
    }));
    show("hollow sphere, {} cells: {:.2e}, order {:.2f}\n", n, error.value.back(), error.last_order());
  }
  EXPECT_GE(error.last_order(), 1.9);
  EXPECT_LE(error.value.back(), 2e-3);
}

/// A cylinder of radius 2 pressed on a plane: uniform stress, whose displacements are linear.
TEST(Axisymmetric, UniformStressIsExact) {
  const auto r = run<2, 2>(rectangle_body("[0, 0]", "[2, 1]", "[5, 3]") + fixed("on = \"top\"", "[\"free\", -0.01]") +
                               plane_obstacle("boundary", "[0, 0]", "[0, 1]"),
                           {uniform(1), "solver.tolerance=1e-12"});
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const Point<2>& x = r.mesh().points[v];
    ASSERT_NEAR(r.u()[2 * v], nu * 0.01 * x[0], 1e-12);
    ASSERT_NEAR(r.u()[2 * v + 1], -0.01 * x[1], 1e-12);
  }
  for (const Stress& s : element_stress(r.nodes(), r.model, r.u())) {
    ASSERT_NEAR(s[0], 0, 1e-12);
    ASSERT_NEAR(s[1], -0.01, 1e-12);
    ASSERT_NEAR(s[2], 0, 1e-12);
  }
  for (const auto& node : r.results.contact.nodes)
    if (node.contact) {
      ASSERT_NEAR(node.pressure, 0.01, 1e-11);
      ASSERT_NEAR(node.recovered, 0.01, 1e-11);
    }
  EXPECT_NEAR(r.contact().area, 4 * pi, 1e-10);
  EXPECT_NEAR(r.contact().force[1], 0.04 * pi, 1e-11);
  EXPECT_NEAR(r.results.forces.reactions[0][1], -0.04 * pi, 1e-11);
}

TEST(Axisymmetric, LoadsAreThoseOfTheWholeBody) {
  const auto r = run<2, 2>(rectangle_body("[1, 0]", "[3, 2]", "[3, 4]") + fixed("on = \"bottom\"", "[0, 0]") +
                           loaded("", "[0, -0.001]") + loaded("on = \"right\"", "[0, \"0.001*y\"]"));
  EXPECT_NEAR(r.results.forces.applied[0][1], -0.001 * pi * (9 - 1) * 2, 1e-13);
  EXPECT_NEAR(r.results.forces.applied[1][1], 0.001 * 2 * 2 * pi * 3, 1e-13);
  EXPECT_NEAR(r.results.forces.applied[0][1] + r.results.forces.applied[1][1] + r.results.forces.reactions[0][1], 0,
              1e-9);
}

/// Lower half of a ball, its middle plane moved down; see hertz_test.cpp. @param delta by how much
std::string ball(double delta) {
  return fmt::format(
             "[[body]]\nname = \"b\"\nshape = \"half_disk\"\ncenter = [0, 0]\nradius = 1\n"
             "size = \"0.05 + 0.3*sqrt(x^2 + (y + 1)^2)\"\n{}",
             elastic) +
         fixed("on = \"flat\"", fmt::format("[\"free\", {}]", -delta)) + plane_obstacle("curved", "[0, -1]", "[0, 1]");
}

TEST(Axisymmetric, HertzsBall) {
  const double delta = 0.011, modulus = E / (1 - nu * nu);
  Errors radius, pressure;
  std::vector<int> cycles;
  double force = 0;
  for (int k = 0; k <= 5; ++k) {
    const auto r = run<2, 2>(ball(delta), {uniform(k)});
    force = r.contact().force[1];
    const double a = std::cbrt(3 * force / (4 * modulus)), p0 = 3 * force / (2 * pi * a * a);
    // the compliance of the finite ball, see hertz_test.cpp
    const double s = a * a + 4, f = 2 * (1 + nu) / (s * std::sqrt(s)) + (1 - nu * nu) / std::sqrt(s);
    radius.add(std::abs(std::sqrt(r.contact().area / pi) / a - 1));
    pressure.add(std::abs(r.contact().max_pressure / p0 - 1));
    cycles.push_back(r.summary().iterations);
    show("ball, {} unknowns: force {:.6e}, radius {:+.4f}, pressure {:+.4f}, approach {:+.4f}, {} cycles\n",
         r.summary().level_unknowns.back(), force, std::sqrt(r.contact().area / pi) / a - 1,
         r.contact().max_pressure / p0 - 1, (a * a - force * f / (pi * E)) / delta - 1, cycles.back());
    if (k >= 4) {
      EXPECT_NEAR((a * a - force * f / (pi * E)) / delta, 1, 0.005);
    }
  }
  EXPECT_LE(radius.value.back(), 0.003);
  EXPECT_LE(pressure.value.back(), 0.005);
  const auto [least, most] = std::minmax_element(cycles.begin() + 1, cycles.end());
  EXPECT_LE(*most - *least, 3);
}

// Three forces of the ball in space, of which each mesh is twice as fine as the one before, lead to that of this ball.
TEST(Axisymmetric, TheBallAgreesWithTheOneInSpace) {
  std::vector<double> F;
  for (int k = 0; k <= 2; ++k) F.push_back(run_shipped<3, 3>("ball_on_plane.toml", {uniform(k)}).contact().force[2]);
  const double last = F[2] - F[1], limit = F[2] - last * last / (last - (F[1] - F[0]));
  const auto r = run_shipped<2, 2>("ball_axisymmetric.toml", {uniform(5)});
  show("forces of the ball in space {}, their limit {:.6e}, axisymmetric {:.6e}\n", fmt::join(F, ", "), limit,
       r.contact().force[1]);
  EXPECT_NEAR(r.contact().force[1] / limit, 1, 0.005);
}

/// The membrane of radial_test.cpp in space, over the hemisphere: A (1/R - 1/2) outside the contact.
TEST(Axisymmetric, ScalarObstacleOfABall) {
  const double free_boundary = 0.789244119040808, A = 0.800588621249054;
  Errors error;
  for (int k = 0; k <= 4; ++k) {
    const auto r = run<2, 1>(
        "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, -2]\nto = [2, 2]\ncells = [8, 16]\n"
        "equation = \"diffusion\"\nplane = \"axisymmetric\"\n" +
            fixed("on = \"boundary\"", "['0.800588621249054*(1/sqrt(x^2+y^2) - 0.5)']") +
            "[[obstacle]]\ntype = \"scalar\"\nbody = \"b\"\n"
            "lower = 'x^2+y^2 <= 0.81 ? sqrt(1 - x^2 - y^2) : sqrt(0.19) - 0.9/sqrt(0.19)*(sqrt(x^2+y^2) - 0.9)'\n",
        {uniform(k)});
    error.add(mean_error<1>(r, [&](const Point<2>& x) {
      const double R = std::hypot(x[0], x[1]);
      return std::array{R <= free_boundary ? std::sqrt(1 - R * R) : A * (1 / R - 0.5)};
    }));
    show("scalar: error {:.2e} order {:.2f}, volume in contact {:.5f}, force {:.5f}\n", error.value.back(),
         error.last_order(), r.contact().area, r.contact().force[0]);
    if (k == 4) {
      EXPECT_NEAR(std::cbrt(r.contact().area / (4 * pi / 3)), free_boundary, 0.02);
      EXPECT_NEAR(r.contact().force[0], 4 * pi * A, 0.01 * 4 * pi * A);  // the flux through any sphere outside
    }
  }
  EXPECT_GE(error.mean_order(), 1.7);
}

/// A tube pushed through a rigid bore: friction acts all around it.
void expect_friction_in_a_bore(const std::string& tube) {
  const std::string body = tube + fixed("on = \"left\"", "[0.01, -0.1]"),
                    bore = "body = \"b\"\non = \"right\"\nshape = \"plane\"\npoint = [2, 0]\nnormal = [-1, 0]\n";
  const auto tresca = run<2, 2>(body + "[[obstacle]]\ntype = \"tresca\"\nbound = 0.001\n" + bore, {uniform(1)});
  EXPECT_EQ(tresca.contact().slip_nodes, tresca.contact().nodes);
  EXPECT_NEAR(tresca.contact().tangential_force[1], 0.001 * 4 * pi, 1e-9);
  const auto coulomb = run<2, 2>(body + "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.2\n" + bore, {uniform(1)});
  EXPECT_EQ(coulomb.contact().slip_nodes, coulomb.contact().nodes);
  EXPECT_LT(coulomb.contact().force[0], -0.01);
  EXPECT_NEAR(coulomb.contact().tangential_force[1], -0.2 * coulomb.contact().force[0], 1e-8);
}

TEST(Axisymmetric, FrictionInABore) { expect_friction_in_a_bore(rectangle_body("[1, 0]", "[2, 1]", "[4, 4]")); }

/// Root of the mean square over the body of what quadratic elements are off, relative to the exact value's.
template <int B>
double quadratic_error(const Run<2, B>& r, const ExactValue<2, B>& exact) {
  double error = 0, size = 0;
  for (const Family<2>& family : r.mesh().families) {
    const ElementMap<2, 2, 2> map(r.mesh(), family);
    for (const auto& [barycentric, weight] : quadrature5<2>()) {
      const Point<2> x = map(barycentric);
      const double part = weight * linear_element(map.flat(barycentric)).measure * x[0];
      const auto value = basis<2>(barycentric);
      const std::array<double, B> wanted = exact(x);
      for (std::size_t i = 0; i < B; ++i) {
        double found = 0;
        for (std::size_t a = 0; a < family.size(); ++a) found += value[a] * r.u()[std::size_t(family[a]) * B + i];
        error += part * std::pow(found - wanted[i], 2);
        size += part * wanted[i] * wanted[i];
      }
    }
  }
  return std::sqrt(error / size);
}

/// A cylinder pressed on a cone whose tip is on its axis: the normal there is oblique to the radial displacement, which
/// is zero. Friction acts around the tip, and not at it.
TEST(Axisymmetric, FrictionAroundTheTipOfACone) {
  const std::string body = rectangle_body("[0, 0]", "[1, 0.8]", "[5, 4]") + fixed("on = \"top\"", "[0, -0.02]"),
                    cone = "body = \"b\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0.1, 1]\n";
  const auto smooth = run<2, 2>(body + "[[obstacle]]\ntype = \"contact\"\n" + cone, {uniform(2)});
  const double force = smooth.contact().force[1];
  for (const std::string law :
       {"type = \"coulomb\"\nfriction = 0", "type = \"coulomb\"\nfriction = 1e-6", "type = \"tresca\"\nbound = 1e-9"}) {
    const auto r = run<2, 2>(body + "[[obstacle]]\n" + law + "\n" + cone, {uniform(2)});
    EXPECT_NEAR(r.contact().force[1] / force, 1, 1e-4) << law;
  }
  const auto rough = run<2, 2>(body + "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.02\n" + cone, {uniform(2)});
  EXPECT_EQ(rough.contact().slip_nodes, rough.contact().nodes - 1);
  EXPECT_NEAR(rough.contact().force[1] / force, 1, 0.01);
}

std::string quadratic(std::string text) {
  const std::string before = "order = 1";
  return text.replace(text.find(before), before.size(), "order = 2");
}

/// Stresses on the axis see the body beyond it. u = (0.3 r^3 + 0.7 r z, -0.4 z^3 + 0.9 r^2 z) is held by its values and
/// what it takes.
TEST(AxisymmetricQuadratic, OrderOfStressesOnTheAxis) {
  constexpr double a = 0.3, b = 0.7, c = -0.4, d = 0.9;
  const std::string body =
      rectangle_body("[0, -0.3]", "[1.3, 0.8]", "[3, 4]") +
      fixed("on = \"boundary\"", "[\"0.3*x^3+0.7*x*y\", \"-0.4*y^3+0.9*x^2*y\"]") +
      loaded("", fmt::format("[\"-{}*x\", \"-{}-{}*y\"]", lambda * (8 * a + 2 * d) + mu * (16 * a + 2 * d),
                             2 * b * (lambda + mu), 6 * c * (lambda + 2 * mu) + 4 * d * mu)) +
      "[solver]\ntolerance = 1e-11\n";
  for (const int order : {1, 2}) {
    Errors error;
    for (int k = 2; k <= 4; ++k) {
      const auto r = run<2, 2>(order == 1 ? body : quadratic(body), {uniform(k)});
      const auto recovered = nodal_stress(r.nodes(), r.model, r.u());
      double most = 0;
      for (Index v = 0; v < r.mesh().vertices(); ++v) {
        const auto [radius, z] = r.mesh().points[v];
        if (radius > 0 || z < 0 || z > 0.5) continue;
        const double radial = b * z, along = 3 * c * z * z, trace = 2 * radial + along;
        most = std::max({most, std::abs(recovered[v][0] - (lambda * trace + 2 * mu * radial)),
                         std::abs(recovered[v][1] - (lambda * trace + 2 * mu * along)),
                         std::abs(recovered[v][2] - (lambda * trace + 2 * mu * radial)), std::abs(recovered[v][3])});
      }
      error.add(most);
      show("order {}: stress on the axis {:.2e} order {:.2f}\n", order, most, error.last_order());
    }
    EXPECT_GE(error.last_order(), order == 1 ? 0.9 : 1.95);
    EXPECT_LT(error.value.back(), order == 1 ? 1.1e-3 : 1.2e-4);
  }
}

TEST(AxisymmetricQuadratic, OrdersOfLamesTube) {
  for (const bool held : {false, true}) {
    const Tube exact(held);
    Errors displacement, energy, stress, force;
    for (int k = 0; k <= 3; ++k) {
      const auto r = run<2, 2>(quadratic(tube(held)), {uniform(k), "solver.tolerance=1e-12"});
      displacement.add(quadratic_error<2>(r, [&](const Point<2>& x) {
        return std::array{exact.displacement(x[0]), 0.0};
      }));
      const double of_load = -0.5 * Tube::p * exact.displacement(1) * 2 * pi;
      energy.add(std::sqrt(std::abs(r.summary().energy / of_load - 1)));  // in the energy norm
      double most = 0;
      const auto recovered = nodal_stress(r.nodes(), r.model, r.u());
      for (Index v = 0; v < r.mesh().vertices(); ++v) {
        const double at = r.mesh().points[v][0];
        most =
            std::max({most, std::abs(recovered[v][0] - exact.radial(at)), std::abs(recovered[v][2] - exact.hoop(at))});
      }
      stress.add(most / Tube::p);
      show(
          "quadratic tube: displacement {:.2e} order {:.2f}, energy {:.2e} order {:.2f}, largest stress {:.2e} order "
          "{:.2f}\n",
          displacement.value.back(), displacement.last_order(), energy.value.back(), energy.last_order(),
          stress.value.back(), stress.last_order());
      if (!held) continue;
      force.add(std::abs(r.contact().force[0] / (4 * pi * exact.radial(2)) - 1));
      EXPECT_NEAR(r.contact().area, 4 * pi, 1e-10);
      EXPECT_NEAR(r.contact().max_pressure / -exact.radial(2), 1, 1e-3);
      show("  force in the bore {:.2e} order {:.2f}\n", force.value.back(), force.last_order());
    }
    EXPECT_GE(displacement.last_order(), 2.9);
    EXPECT_GE(energy.last_order(), 1.9);
    EXPECT_GE(stress.last_order(), 1.9);
    EXPECT_TRUE(!held || force.value.back() <= 1e-6);
  }
}

/// Curved elements: circles are found in the mesh.
TEST(AxisymmetricQuadratic, OrdersOfLamesHollowSphere) {
  for (const double ratio : {0.3, 0.4999}) {
    const double a = 1, b = 2, p = 0.01;
    const auto radial = [&](double R) {
      return p * a * a * a / (E * (b * b * b - a * a * a)) *
             ((1 - 2 * ratio) * R + (1 + ratio) * b * b * b / (2 * R * R));
    };
    std::string material = elastic;
    material.replace(material.find("poisson = 0.3"), 13, fmt::format("poisson = {}", ratio));
    Errors error;
    for (const Index n : {2, 4, 8, 16}) {
      Mesh<2> mesh = rectangle({1, 0}, {2, 1}, {n, 2 * n});
      for (Point<2>& x : mesh.points) {
        const double angle = pi / 2 * x[1];
        x = {x[0] * std::cos(angle), x[0] * std::sin(angle)};
      }
      const TemporaryFolder folder;
      const auto r =
          run<2, 2>(quadratic(fmt::format("[[body]]\nname = \"b\"\nmesh = \"{}\"\n{}",
                                          folder.write("sphere.msh", msh(mesh, Motion<2>())), material)) +
                        fixed("where = \"abs(y) < 1e-9\"", "[\"free\", 0]") +
                        loaded("where = \"x^2 + y^2 < 1.001\"", fmt::format("[\"-{0}*nx\", \"-{0}*ny\"]", p)),
                    {"solver.tolerance=1e-12"});
      error.add(quadratic_error<2>(r, [&](const Point<2>& x) {
        const double R = std::hypot(x[0], x[1]), u = radial(R);
        return std::array{u * x[0] / R, u * x[1] / R};
      }));
      const std::vector<double> volume = node_volumes(r.nodes(), Plane::axisymmetric);
      EXPECT_GT(*std::min_element(volume.begin(), volume.end()), 0);
      double whole = 0;
      for (const double v : volume) whole += v;
      EXPECT_NEAR(whole / (2 * pi / 3 * 7), 1, 0.02 / std::pow(n / 2.0, 4));
      show("quadratic hollow sphere of nu = {}, {} cells: {:.2e}, order {:.2f}\n", ratio, n, error.value.back(),
           error.last_order());
    }
    EXPECT_GE(error.last_order(), 2.8);
    EXPECT_LE(error.value.back(), 5e-5);
  }
}

TEST(AxisymmetricQuadratic, UniformStressIsExact) {
  const auto r =
      run<2, 2>(quadratic(rectangle_body("[0, 0]", "[2, 1]", "[5, 3]")) + fixed("on = \"top\"", "[\"free\", -0.01]") +
                    plane_obstacle("bottom", "[0, 0]", "[0, 1]"),
                {uniform(1), "solver.tolerance=1e-13"});
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const Point<2>& x = r.mesh().points[v];
    ASSERT_NEAR(r.u()[2 * v], nu * 0.01 * x[0], 1e-12);
    ASSERT_NEAR(r.u()[2 * v + 1], -0.01 * x[1], 1e-12);
  }
  for (const Stress& stress : nodal_stress(r.nodes(), r.model, r.u()))  // those on the axis, too
    for (std::size_t i = 0; i < stress.size(); ++i) ASSERT_NEAR(stress[i], i == 1 ? -0.01 : 0, 1e-11);
  for (const auto& node : r.results.contact.nodes)
    if (node.contact) {
      ASSERT_GT(node.area, 0);
      ASSERT_NEAR(node.pressure, 0.01, 1e-9);
      ASSERT_NEAR(node.recovered, 0.01, 1e-9);
    }
  EXPECT_NEAR(r.contact().area, 4 * pi, 1e-10);
  EXPECT_NEAR(r.contact().force[1], 0.04 * pi, 1e-11);
}

TEST(AxisymmetricQuadratic, LoadsAreThoseOfTheWholeBody) {
  const auto r =
      run<2, 2>(quadratic(rectangle_body("[1, 0]", "[3, 2]", "[3, 4]")) + fixed("on = \"bottom\"", "[0, 0]") +
                loaded("", "[0, -0.001]") + loaded("on = \"right\"", "[0, \"0.001*y\"]"));
  EXPECT_NEAR(r.results.forces.applied[0][1], -0.001 * pi * (9 - 1) * 2, 1e-13);
  EXPECT_NEAR(r.results.forces.applied[1][1], 0.001 * 2 * 2 * pi * 3, 1e-13);
  EXPECT_NEAR(r.results.forces.applied[0][1] + r.results.forces.applied[1][1] + r.results.forces.reactions[0][1], 0,
              1e-9);
}

// The flux through a hollow cylinder: log r.
TEST(AxisymmetricQuadratic, OrdersOfAScalarBody) {
  Errors error;
  for (int k = 0; k <= 3; ++k) {
    const auto r = run<2, 1>(
        "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [1, 0]\nto = [2, 1]\ncells = [2, 2]\norder = 2\n"
        "equation = \"diffusion\"\nplane = \"axisymmetric\"\n" +
            fixed("on = \"left\"", "0") + loaded("on = \"right\"", "0.5"),
        {uniform(k), "solver.tolerance=1e-12"});
    error.add(quadratic_error<1>(r, [](const Point<2>& x) { return std::array{std::log(x[0])}; }));
    show("quadratic scalar: {:.2e} order {:.2f}\n", error.value.back(), error.last_order());
  }
  EXPECT_GE(error.last_order(), 2.9);
}

TEST(AxisymmetricQuadratic, ScalarObstacleOfABall) {
  const double A = 0.800588621249054;
  Errors force;
  for (int k = 0; k <= 3; ++k) {
    const auto r = run<2, 1>(
        "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, -2]\nto = [2, 2]\ncells = [8, 16]\norder = 2\n"
        "equation = \"diffusion\"\nplane = \"axisymmetric\"\n" +
            fixed("on = \"boundary\"", "['0.800588621249054*(1/sqrt(x^2+y^2) - 0.5)']") +
            "[[obstacle]]\ntype = \"scalar\"\nbody = \"b\"\n"
            "lower = 'x^2+y^2 <= 0.81 ? sqrt(1 - x^2 - y^2) : sqrt(0.19) - 0.9/sqrt(0.19)*(sqrt(x^2+y^2) - 0.9)'\n",
        {uniform(k)});
    force.add(std::abs(r.contact().force[0] / (4 * pi * A) - 1));
    show("quadratic scalar obstacle: force {:.2e} off\n", force.value.back());
  }
  EXPECT_LE(force.value.back(), 2e-3);
}

TEST(AxisymmetricQuadratic, HertzsBall) {
  const double delta = 0.011, modulus = E / (1 - nu * nu);
  std::vector<double> forces;
  for (int k = 0; k <= 3; ++k) {
    const auto r = run<2, 2>(quadratic(ball(delta)), {uniform(k)});
    const double force = r.contact().force[1], a = std::cbrt(3 * force / (4 * modulus)),
                 p0 = 3 * force / (2 * pi * a * a);
    forces.push_back(force);
    show("quadratic ball, {} unknowns: force {:.6e}, radius {:+.4f}, pressure {:+.4f}, {} cycles\n",
         r.summary().level_unknowns.back(), force, std::sqrt(r.contact().area / pi) / a - 1,
         r.contact().max_pressure / p0 - 1, r.summary().iterations);
    for (Index v = 0; v < r.mesh().vertices(); ++v)
      if (r.mesh().points[v][0] == 0) {
        ASSERT_EQ(r.u()[2 * v], 0);
      }
    if (k < 3) continue;
    EXPECT_NEAR(std::sqrt(r.contact().area / pi) / a, 1, 0.005);
    EXPECT_NEAR(r.contact().max_pressure / p0, 1, 0.005);
  }
  std::vector<double> linear;
  for (const int k : {4, 6}) linear.push_back(run<2, 2>(ball(delta), {uniform(k)}).contact().force[1]);
  show("linear ball: forces {:.6e}, {:.6e}\n", linear[0], linear[1]);
  EXPECT_NEAR(forces[3] / linear[1], 1, 3e-4);
  // Linear elements with as many unknowns are further off.
  EXPECT_LE(2 * std::abs(forces[3] - linear[1]), std::abs(linear[0] - linear[1]));
}

TEST(AxisymmetricQuadratic, FrictionInABore) {
  expect_friction_in_a_bore(quadratic(rectangle_body("[1, 0]", "[2, 1]", "[4, 4]")));
}

// Of rubber a tube in a bore is hardly deformed, and its pressure is that which acts within.
TEST(AxisymmetricQuadratic, RubberDoesNotLock) {
  for (const double ratio : {0.3, 0.499, 0.4999}) {
    const double m = E / (2 * (1 + ratio)), l = E * ratio / ((1 + ratio) * (1 - 2 * ratio));
    // u = A r + B / r between the pressure 0.01 at r = 1 and none at r = 2, no axial strain
    const double A = 0.01 / (2 * (l + m) * 3), B = 0.04 / (2 * m * 3);
    std::string text = quadratic(tube(false));
    text.replace(text.find("poisson = 0.3"), 13, fmt::format("poisson = {}", ratio));
    Errors error;
    int cycles = 0;
    for (int k = 0; k <= 2; ++k) {
      const auto r = run<2, 2>(text, {uniform(k), "solver.tolerance=1e-11"});
      cycles = r.summary().iterations;
      error.add(quadratic_error<2>(r, [&](const Point<2>& x) { return std::array{A * x[0] + B / x[0], 0.0}; }));
    }
    show("tube of nu = {}: {:.2e} order {:.2f}, {} cycles\n", ratio, error.value.back(), error.last_order(), cycles);
    EXPECT_GE(error.last_order(), 2.7);
    EXPECT_LE(error.value.back(), 1e-4);
  }
}

std::string refusal(const std::string& text) {
  try {
    run<2, 2>(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Axisymmetric, RefusesWhatHasNoMeaning) {
  const std::string held = fixed("on = \"top\"", "[0, 0]");
  EXPECT_THAT(refusal(rectangle_body("[-0.5, 0]", "[2, 1]", "[5, 3]") + held),
              testing::AllOf(HasSubstr("body.0.plane"), HasSubstr("(-0.5, "), HasSubstr("r >= 0")));
  EXPECT_THAT(refusal(rectangle_body("[0, 0]", "[2, 1]", "[5, 3]") + fixed("on = \"top\"", "[0.1, 0]")),
              testing::AllOf(HasSubstr("fix.0"), HasSubstr("(0, 1)"), HasSubstr("axis")));
  EXPECT_THAT(refusal(rectangle_body("[0, 0]", "[2, 1]", "[5, 3]") + fixed("on = \"left\"", "[0, 0]")),
              testing::AllOf(HasSubstr("fix.0"), HasSubstr("axis")));
}

// A ring is free to move along the axis alone.
TEST(Axisymmetric, OnlyTheMotionAlongTheAxisIsRigid) {
  const std::string ring = rectangle_body("[1, 0]", "[2, 1]", "[3, 3]");
  EXPECT_THAT(refusal(ring + loaded("on = \"top\"", "[0, 0.1]") + plane_obstacle("bottom", "[0, 0]", "[0, 1]")),
              HasSubstr("translation along (0, 1)"));
  EXPECT_EQ(refusal(ring + loaded("on = \"left\"", "[0.01, 0]") + loaded("on = \"top\"", "[0, -0.1]") +
                    plane_obstacle("bottom", "[0, 0]", "[0, 1]")),
            "");
}

}  // namespace
}  // namespace signorini::test
