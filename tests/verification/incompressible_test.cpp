// Nearly incompressible material: no locking, forces that balance, and the cycles that it takes.
#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/fem/incompressible/pressure_space.hpp"
#include "core/fem/recovery/error_norm.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/mesh/quadrature.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

template <int D>
std::string block(int cells, double poisson, const std::string& more = "") {
  std::string from = "0, 0", to = "1, 1", n = fmt::format("{0}, {0}", cells);
  if (D == 3) from += ", 0", to += ", 1", n += fmt::format(", {}", cells);
  return fmt::format("shape = \"{}\"\nfrom = [{}]\nto = [{}]\ncells = [{}]\nyoung = {}\npoisson = {}\n{}\n",
                     D == 2 ? "rectangle" : "box", from, to, n, 2 * (1 + poisson), poisson, more);
}

/// mu = 1. u = v + w / lambda with div v = 0, div w = p and w = (sin(x+y), 0...): the pressure is p = cos(x+y), however
/// large lambda is, and -div stress = sin(x+y) (1, 1, 0) + 5 v + (2 w + sin(x+y) (1, 1, 0)) / lambda.
template <int D>
struct Manufactured {
  double lambda;

  std::vector<std::string> v() const {
    if (D == 2) return {"2*cos(x+2*y)+sin(2*x-y)", "-cos(x+2*y)+2*sin(2*x-y)"};
    return {"sin(y+2*z)", "sin(z+2*x)", "sin(x+2*y)"};
  }
  std::string value() const {
    std::string out;
    for (std::size_t k = 0; k < D; ++k)
      out += fmt::format("{}'{}{}'", k ? ", " : "", v()[k], k == 0 ? fmt::format("+sin(x+y)/{}", lambda) : "");
    return "[" + out + "]";
  }
  std::string force() const {
    std::string out;
    for (std::size_t k = 0; k < D; ++k) {
      const double part = (k < 2 ? 1 + 1 / lambda : 0) + (k == 0 ? 2 / lambda : 0);
      out += fmt::format("{}'5*({})+{}*sin(x+y)'", k ? ", " : "", v()[k], part);
    }
    return "[" + out + "]";
  }
  std::array<double, D> at(const Point<D>& x) const {
    const double w = std::sin(x[0] + x[1]) / lambda;
    if constexpr (D == 2) {
      const double c = std::cos(x[0] + 2 * x[1]), s = std::sin(2 * x[0] - x[1]);
      return {2 * c + s + w, -c + 2 * s};
    } else {
      return {std::sin(x[1] + 2 * x[2]) + w, std::sin(x[2] + 2 * x[0]), std::sin(x[0] + 2 * x[1])};
    }
  }
  Gradient<D, D> slope(const Point<D>& x) const {
    const double w = std::cos(x[0] + x[1]) / lambda;
    if constexpr (D == 2) {
      const double s = std::sin(x[0] + 2 * x[1]), c = std::cos(2 * x[0] - x[1]);
      return {{{-2 * s + 2 * c + w, -4 * s - c + w}, {s + 4 * c, 2 * s - 2 * c}}};
    } else {
      const double a = std::cos(x[1] + 2 * x[2]), b = std::cos(x[2] + 2 * x[0]), c = std::cos(x[0] + 2 * x[1]);
      return {{{w, a + w, 2 * a}, {2 * b, 0, b}, {c, 2 * c, 0}}};
    }
  }
  double pressure(const Point<D>& x) const { return std::cos(x[0] + x[1]); }
};

double lambda_of(double poisson) { return 2 * poisson / (1 - 2 * poisson); }

/// Prescribed all around: nothing but compression resists a constant pressure.
template <int D>
std::string smooth(int cells, double poisson) {
  const Manufactured<D> exact{lambda_of(poisson)};
  return fmt::format(
      "[[body]]\nname = \"b\"\n{}[[fix]]\nbody = \"b\"\non = \"boundary\"\nvalue = {}\n[[load]]\nbody = \"b\"\n"
      "value = {}\n[solver]\ntolerance = 1e-9\n",
      block<D>(cells, poisson), exact.value(), exact.force());
}

template <int D>
double pressure_error(const Run<D, D>& r, const Manufactured<D>& exact, double part) {
  const Nodes<D> nodes = r.nodes();
  const PressureSpace<D> space = pressure_space<D>(nodes, r.model);
  double sum = 0;
  for (std::size_t e = 0; e < r.mesh().families.size(); ++e) {
    const ElementMap<D, D, 2> map(r.mesh(), r.mesh().families[e]);
    for (const auto& [barycentric, weight] : quadrature5<D>()) {
      const double error = space.at(r.results.pressure, e, barycentric) - part * exact.pressure(map(barycentric));
      sum += weight * linear_element(map.flat(barycentric)).measure * error * error;
    }
  }
  return std::sqrt(sum);
}

template <int D>
void expect_orders(int cells, int refinements, double poisson) {
  const Manufactured<D> exact{lambda_of(poisson)};
  const double part = (exact.lambda - lambda_of_displacements) / exact.lambda;
  Errors energy, l2, pressure;
  for (int k = 0; k <= refinements; ++k) {
    const auto r = run<D, D>(smooth<D>(cells, poisson), {uniform(k)});
    Model<D> shear = r.model;
    shear.poisson = 0;
    const auto slope = [&](const Point<D>& x) { return exact.slope(x); };
    energy.add(energy_error<D, D>(r.nodes(), shear, r.u(), slope));
    l2.add(l2_error<D, D>(r.nodes(), r.u(), [&](const Point<D>& x) { return exact.at(x); }));
    pressure.add(pressure_error<D>(r, exact, part));
    show(
        "{}D, poisson {}: {} nodes, shear {:.3e} order {:.2f}, L2 {:.3e} order {:.2f}, pressure {:.3e} order {:.2f}, "
        "{} "
        "cycles\n",
        D, poisson, r.nodes().size(), energy.value.back(), energy.last_order(), l2.value.back(), l2.last_order(),
        pressure.value.back(), pressure.last_order(), r.summary().iterations);
  }
  EXPECT_NEAR(energy.last_order(), 2, 0.15);
  EXPECT_NEAR(l2.last_order(), 3, 0.2);
  EXPECT_GT(pressure.last_order(), 1.8);
}

TEST(Incompressible, OrdersOnSmoothProblems) {
  expect_orders<2>(4, 3, 0.4999);
  expect_orders<3>(2, 2, 0.4999);
}

/// A block between smooth walls, pressed on a parabola by its top: no edge of what is held is a singularity, which
/// would depend on Poisson's ratio.
template <int D>
SceneText pressed(int cells, double poisson, const std::string& more = "order = 2") {
  std::vector<std::string> fixes{
      D == 2 ? "on = \"top\"\nvalue = [\"free\", -0.05]" : "on = \"top\"\nvalue = [\"free\", \"free\", -0.05]",
      D == 2 ? "on = \"left\"\nvalue = [0, \"free\"]" : "on = \"left\"\nvalue = [0, \"free\", \"free\"]"};
  if (D == 3) fixes.push_back("on = \"front\"\nvalue = [\"free\", 0, \"free\"]");
  return {.body = block<D>(cells, poisson, more),
          .fixes = fixes,
          .obstacle = fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"expression\"\ndistance = '{}'\n"
                                  "normal = [0, {}1]",
                                  D == 2 ? "y + 0.2*x^2" : "z + 0.2*(x^2 + y^2)", D == 2 ? "" : "0, ")};
}

template <int D>
void expect_no_locking(int cells, int finest) {
  const auto errors = [&](double poisson) {
    std::vector<double> force;
    std::vector<int> cycles;
    for (int k = 0; k <= finest; ++k) {
      const auto r = run<D, D>(pressed<D>(cells, poisson), {uniform(k)});
      force.push_back(r.contact().force[D - 1]);
      cycles.push_back(r.summary().iterations);
      show("{}D, poisson {}: {} nodes, force {:.6f}, largest pressure {:.5f}, {} cycles, rate {:.2f}\n", D, poisson,
           r.nodes().size(), force.back(), r.contact().max_pressure, cycles.back(), r.summary().rate);
    }
    return std::pair(std::abs(force[0] / force.back() - 1), cycles);
  };
  const auto [usual, few] = errors(0.3);
  const auto [rubber, cycles] = errors(0.4999);
  EXPECT_LE(rubber, 1.5 * usual);
  for (std::size_t k = 0; k < cycles.size(); ++k) EXPECT_LE(cycles[k], 2 * few[k]) << k << " refinements";
}

template <int D>
int cycles_held_all_around(int cells, int refinements, double poisson) {
  const auto r =
      run<D, D>(smooth<D>(cells, poisson), {uniform(refinements), "body.0.order=2", "solver.tolerance=1e-8"});
  show("{}D held all around, poisson {}: {} nodes, {} cycles\n", D, poisson, r.nodes().size(), r.summary().iterations);
  return r.summary().iterations;
}

/// In corners nothing moves, and hardly anything resists a pressure there: it took 28 to 56 cycles.
TEST(Incompressible, BodiesHeldAllAroundTakeFewCycles) {
  for (const int refinements : {1, 3}) EXPECT_LE(cycles_held_all_around<2>(4, refinements, 0.4999), 24);
  EXPECT_LE(cycles_held_all_around<3>(3, 1, 0.4999), 24);
}

/// Layers that are shortened between smooth walls: the stress is the same in all of them, and uniform pressures are
/// exact whatever the mesh. Contact shuts the rubber in.
/// A pad between plates that its faces are bonded to, or the lower one rough: pressed by a twentieth of its height.
SceneText pad(int length, double poisson, const std::string& below) {
  return {.body = fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [{0}, 1]\ncells = [{0}, 2]\norder = 2\n"
                              "young = 1\npoisson = {1}",
                              length, poisson),
          .fixes = below.empty()
                       ? std::vector<std::string>{"on = \"top\"\nvalue = [0, -0.05]", "on = \"bottom\"\nvalue = [0, 0]"}
                       : std::vector<std::string>{"on = \"top\"\nvalue = [0, -0.05]"},
          .obstacle = below.empty() ? fmt::format("type = \"contact\"\non = \"right\"\nshape = \"plane\"\n"
                                                  "point = [{}, 0]\nnormal = [-1, 0]",
                                                  length + 0.05)
                                    : below + "\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]",
          .refinements = 2};
}

// A pressure that varies along a thin layer moves little out of it: many such pressures are slow.
TEST(Incompressible, ThinLayersTakeMoreCycles) {
  for (const auto& [length, most] : {std::pair{10, 35}, {20, 50}, {40, 75}}) {
    const auto rubber = run<2, 2>(pad(length, 0.4999, "")), other = run<2, 2>(pad(length, 0.3, ""));
    const auto rough = run<2, 2>(pad(length, 0.4999, "type = \"coulomb\"\nfriction = 0.3"));
    show("{} : 1: {} cycles, with poisson = 0.3 {}, with friction below {}\n", length, rubber.summary().iterations,
         other.summary().iterations, rough.summary().iterations);
    EXPECT_LE(rubber.summary().iterations, most);
    EXPECT_LE(rough.summary().iterations, 1.3 * most);
  }
}

// A disk under its weight fills a ring all but the top, or nearly so: what compression alone would resist opens
// contact.
TEST(Incompressible, ContactThatShutsRubberInMayOpen) {
  for (const double ring : {1.0, 1.0001, 1.001})
    for (const int refinements : {1, 2}) {
      const auto r = run<2, 2>(SceneText{
          .body = "shape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.25\norder = 2\nyoung = 1\npoisson = 0.4999",
          .loads = {"value = [0, -0.01]"},
          .obstacle =
              fmt::format("type = \"contact\"\non = \"boundary\"\nshape = \"sphere\"\ncenter = [0, 0]\nradius = "
                          "{}\ninside = true",
                          ring),
          .refinements = refinements});
      show("ring {}: {} cycles\n", ring, r.summary().iterations);
      EXPECT_LE(r.summary().iterations, 60) << ring;
      EXPECT_NEAR(r.contact().force[1], 0.01 * pi, 1e-3 * 0.01 * pi) << ring;
    }
}

// The stages of a solve are about one problem, wherever they begin.
TEST(Incompressible, WhateverTheStartTheSolutionIsTheSame) {
  const SceneText scene = pad(40, 0.4999, "type = \"coulomb\"\nfriction = 0.1");
  const auto nested = run<2, 2>(scene), zero = run<2, 2>(scene, {"solver.start=zero"});
  EXPECT_GT(zero.summary().stages.size(), 1u) << "else this tests nothing";
  EXPECT_NEAR(zero.contact().force[1], nested.contact().force[1], 1e-5 * nested.contact().force[1]);
}

TEST(Incompressible, LayersInSeriesAreExact) {
  const auto modulus = [](double poisson) { return (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)); };
  const double stress = 0.003 / (1 / modulus(0.4999) + 1 / modulus(0.3) + 1 / modulus(0.49));
  for (const char* start : {"nested", "zero"})
    for (const char* pressure : {"linear", "constant"}) {
      const auto r = run<2, 2>(
          SceneText{.body = fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [3, 1]\ncells = [6, 2]\nyoung = 1\n"
                                        "poisson = 'x < 1 ? 0.4999 : x < 2 ? 0.3 : 0.49'\npressure = \"{}\"",
                                        pressure),
                    .fixes = {"on = \"left\"\nvalue = [0, \"free\"]", "on = \"bottom\"\nvalue = [\"free\", 0]",
                              "on = \"top\"\nvalue = [\"free\", 0]"},
                    .obstacle = "type = \"contact\"\non = \"right\"\nshape = \"plane\"\npoint = [2.997, 0]\n"
                                "normal = [-1, 0]",
                    .refinements = 1},
          {"solver.tolerance=1e-10", fmt::format("solver.start={}", start)});
      EXPECT_NEAR(r.contact().force[0], -stress, 1e-8 * stress) << start << ", " << pressure;
      EXPECT_LE(r.summary().iterations, 40);
      const PressureSpace<2> space = pressure_space<2>(r.nodes(), r.model);
      for (const Stress& s : element_stress<2>(r.nodes(), r.model, r.u(), {&space, &r.results.pressure}))
        ASSERT_NEAR(s[0], -stress, 1e-7 * stress);
    }
}

template <int D>
void expect_balance(const std::string& obstacle) {
  SceneText scene = pressed<D>(D == 2 ? 4 : 3, 0.4999);
  scene.obstacle = obstacle + scene.obstacle.substr(scene.obstacle.find('\n'));
  scene.refinements = 1;
  const auto r = run<D, D>(scene, {"solver.tolerance=1e-10"});
  std::array<double, D> sum = r.results.forces.contact[0];
  for (const auto& reaction : r.results.forces.reactions)
    for (int i = 0; i < D; ++i) sum[i] += reaction[i];
  for (int i = 0; i < D; ++i) EXPECT_NEAR(sum[i], 0, 1e-8 * r.contact().force[D - 1]) << obstacle;
  EXPECT_LE(r.summary().iterations, 30) << obstacle;
}

TEST(Incompressible, ForcesBalance) {
  expect_balance<2>("type = \"contact\"");
  expect_balance<3>("type = \"contact\"");
  expect_balance<2>("type = \"coulomb\"\nfriction = 0.3");
  expect_balance<3>("type = \"coulomb\"\nfriction = 0.3");
  expect_balance<2>("type = \"tresca\"\nbound = 0.01");
}

template <int D>
double energy_norm(const BlockMatrix<D>& A, const std::vector<double>& x) {
  std::vector<double> r(x.size());
  const std::vector<double> zero(x.size());
  residual<D>(A, x.data(), zero.data(), r.data());
  return std::sqrt(std::abs(dot(x, r)));
}

TEST(Incompressible, ErrorsAreNotFarFromTheirEstimate) {
  for (const double tolerance : {1e-3, 1e-5}) {
    SceneText scene = pressed<2>(4, 0.4999);
    scene.refinements = 2;
    const auto r = run<2, 2>(scene, {fmt::format("solver.tolerance={}", tolerance)});
    const auto exact = run<2, 2>(scene, {"solver.tolerance=1e-12"});
    std::vector<double> error = r.solution.x;
    for (std::size_t k = 0; k < error.size(); ++k) error[k] -= exact.solution.x[k];
    const double found = energy_norm(r.problem().A, error) / energy_norm(r.problem().A, r.solution.x);
    show("tolerance {}: error {:.2e}, estimate {:.2e}\n", tolerance, found, r.summary().algebraic_error);
    EXPECT_LE(found, 2 * r.summary().algebraic_error);
    EXPECT_GE(found, 0.01 * r.summary().algebraic_error);
  }
}

TEST(Incompressible, ActiveSetsAreRefused) {
  try {
    run<2, 2>(pressed<2>(2, 0.4999), {"solver.method=pdas"});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("pressures of its own"), std::string::npos) << error.what();
  }
}

TEST(Incompressible, NoLockingInContact) {
  expect_no_locking<2>(4, 3);
  expect_no_locking<3>(3, 1);
}

}  // namespace
}  // namespace signorini::test
