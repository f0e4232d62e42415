// Thermal strain against closed forms: Timoshenko and Goodier, Theory of Elasticity, chapter 13.
#include <gmock/gmock.h>

#include "core/fem/incompressible/pressure_space.hpp"
#include "core/fem/recovery/stress.hpp"
#include "support.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;

constexpr double E = 2, alpha = 1e-3, T = 40, strain = alpha * T;
const std::vector<std::string> exact = {"solver.tolerance=1e-12"};

std::string heated(double poisson, const std::string& more, const std::string& temperature = "40") {
  return fmt::format("young = 2\npoisson = {}\nexpansion = 1e-3\ntemperature = \"{}\"\n{}\n", poisson, temperature,
                     more);
}
std::string order(int p) { return fmt::format("order = {}\n", p); }

const std::string plate = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [3, 1]\ncells = [3, 1]\n";
const std::string block = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [3, 1, 1]\ncells = [3, 1, 1]\n";
const std::string cylinder =
    "shape = \"rectangle\"\nfrom = [0, 0]\nto = [3, 1]\ncells = [3, 1]\nplane = \"axisymmetric\"\n";
const std::string stress_plane = "plane = \"stress\"\n";

std::string fix(const std::string& on, const std::string& value) { return table("fix", on + "\nvalue = " + value); }
/// Each part is held along the axis across it.
const std::string on_planes_2 = fix("on = \"left\"", "[0, \"free\"]") + fix("on = \"bottom\"", "[\"free\", 0]");
const std::string on_planes_3 = fix("on = \"left\"", "[0, \"free\", \"free\"]") +
                                fix("on = \"front\"", "[\"free\", 0, \"free\"]") +
                                fix("on = \"bottom\"", "[\"free\", \"free\", 0]");

template <int D>
std::vector<Stress> stresses(const Run<D, D>& solved, bool at_nodes = false) {
  const Nodes<D> nodes = solved.nodes();
  std::optional<PressureSpace<D>> space;
  if (!solved.results.pressure.empty()) space = pressure_space<D>(nodes, solved.model);
  const OwnPressure<D> pressure{space ? &*space : nullptr, &solved.results.pressure};
  return at_nodes ? nodal_stress<D>(nodes, solved.model, solved.u(), pressure)
                  : element_stress<D>(nodes, solved.model, solved.u(), pressure);
}

template <int D>
void expect_uniform(const Run<D, D>& solved, const Stress& expected, double tolerance) {
  for (const bool at_nodes : {false, true})
    for (const Stress& s : stresses(solved, at_nodes))
      for (int k = 0; k < 6; ++k) ASSERT_NEAR(s[k], expected[k], tolerance) << k << " at nodes: " << at_nodes;
}

/// u = strain x, whose energy is -1/2 times the integral of thermal stress times thermal strain.
template <int D>
void expect_free(const std::string& shape, const std::string& fixes, double poisson, double grows, const Stress& stress,
                 const std::string& more) {
  SCOPED_TRACE(fmt::format("{}{} poisson {}", shape, more, poisson));
  const Run<D, D> solved = run<D, D>(text_of(shape + heated(poisson, more), fixes), exact);
  const std::vector<double> u = solved.nodes().at_vertices(solved.u(), D);
  for (Index v = 0; v < solved.mesh().vertices(); ++v)
    for (int i = 0; i < D; ++i) EXPECT_NEAR(u[v * D + i], grows * solved.mesh().points[v][i], 1e-9 * strain);
  expect_uniform<D>(solved, stress, (poisson > 0.45 ? 1e-6 : 1e-8) * E * strain);
  for (const auto& force : solved.results.forces.reactions)
    EXPECT_THAT(force, Each(testing::DoubleNear(0, 1e-8 * E * strain * 60)));
}

TEST(Thermal, what_is_free_to_expand_has_no_stress) {
  for (const int p : {1, 2}) {
    expect_free<2>(plate, on_planes_2, 0.3, strain, {}, stress_plane + order(p));
    expect_free<2>(plate, on_planes_2, 0.3, 1.3 * strain, {0, 0, -E * strain}, order(p));
    expect_free<2>(cylinder, fix("on = \"bottom\"", "[\"free\", 0]"), 0.3, strain, {}, order(p));
    expect_free<3>(block, on_planes_3, 0.3, strain, {}, order(p));
  }
  for (const char* pressure : {"linear", "constant", "none"}) {
    const std::string rubber = order(2) + "pressure = \"" + pressure + "\"\n";
    expect_free<3>(block, on_planes_3, 0.499, strain, {}, rubber);
    expect_free<2>(cylinder, fix("on = \"bottom\"", "[\"free\", 0]"), 0.499, strain, {}, rubber);
    expect_free<2>(plate, on_planes_2, 0.499, 1.499 * strain, {0, 0, -E * strain}, rubber);
  }
}

// A temperature that is linear in the place leaves no stress, either: the body bends instead.
TEST(Thermal, a_linear_temperature_bends_and_does_not_stress) {
  const auto flat =
      run<2, 2>(text_of(plate + heated(0.3, stress_plane + order(2), "40 * y"),
                        fix("at = [0, 0]", "[0, 0]") + fix("at = [3, 0]", "[\"free\", 0]") + "[refine]\nuniform = 1\n"),
                exact);
  expect_uniform<2>(flat, {}, 1e-9 * E * strain);
  const std::string points = fix("at = [0, 0, 0]", "[0, 0, 0]") + fix("at = [3, 0, 0]", "[\"free\", 0, 0]") +
                             fix("at = [0, 0, 1]", "[\"free\", 0, \"free\"]");
  for (const double poisson : {0.3, 0.499}) {
    const auto solid = run<3, 3>(text_of(block + heated(poisson, order(2), "10 * x - 20 * z"), points), exact);
    expect_uniform<3>(solid, {}, (poisson > 0.45 ? 1e-6 : 1e-8) * E * strain);
  }
}

// Held at both ends: sigma = -E alpha T, in plane strain over 1 - nu, since the thickness is held as well. Of rubber
// all is the same. Its energy is that of free expansion, less what the ends do: see docs/thermal.md.
TEST(Thermal, a_bar_between_fixes_is_pressed) {
  const std::string ends_2 = on_planes_2 + fix("on = \"right\"", "[0, \"free\"]"),
                    ends_3 = on_planes_3 + fix("on = \"right\"", "[0, \"free\", \"free\"]");
  const double s = -E * strain;
  for (const int p : {1, 2}) {
    const auto sheet = run<2, 2>(text_of(plate + heated(0.3, stress_plane + order(p)), ends_2), exact);
    expect_uniform<2>(sheet, {s}, 1e-9 * E * strain);
    EXPECT_NEAR(sheet.results.forces.reactions[0][0], -s, 1e-9 * E * strain);
    EXPECT_NEAR(sheet.results.forces.reactions[2][0], s, 1e-9 * E * strain);
    const auto wide = run<2, 2>(text_of(plate + heated(0.3, order(p)), ends_2), exact);
    expect_uniform<2>(wide, {s / 0.7, 0, s / 0.7}, 1e-9 * E * strain);
    const auto bar = run<3, 3>(text_of(block + heated(0.3, order(p)), ends_3), exact);
    expect_uniform<3>(bar, {s}, 1e-9 * E * strain);
    // 1/2 a(u, u) - b u = -1/2 b u: of thermal stress 2 mu + 3 lambda times the strains of u, 2 (1 + nu) alpha T.
    const double K3 = E / (1 - 2 * 0.3);
    EXPECT_NEAR(bar.summary().energy, -0.5 * 3 * K3 * strain * 2 * 1.3 * strain, 1e-9 * E * strain * strain);
  }
  const auto rubber = run<3, 3>(text_of(block + heated(0.499, order(2)), ends_3), exact);
  expect_uniform<3>(rubber, {s}, 1e-6 * E * strain);
  EXPECT_NEAR(rubber.summary().energy, -0.5 * 3 * E / 0.002 * strain * 2 * 1.499 * strain, 1e-5 * E * strain * strain);
  const auto held = run<3, 3>(text_of(block + heated(0.3, order(2)), fix("on = \"boundary\"", "[0, 0, 0]")),
                              {"solver.tolerance=1e-10"});
  const double all = -E * strain / 0.4;
  expect_uniform<3>(held, {all, all, all}, 1e-9);
  EXPECT_NEAR(held.summary().energy, 0, 1e-12);
}

StepReport solved(const std::string& text, std::vector<std::string> more = exact) {
  Driver driver(parse_scene(text, "test.toml", ".", more));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report().last();
}

// Springs of k per area at the right end take what is left: s = -E alpha T k L / (E + k L).
TEST(Thermal, springs_hold_back_a_part) {
  const double k = 0.7, s = -E * strain * k * 3 / (E + k * 3);
  for (const int p : {1, 2}) {
    const StepReport step =
        solved(text_of(plate + heated(0.3, stress_plane + order(p)),
                       on_planes_2 + table("spring", fmt::format("on = \"right\"\nstiffness = [{}, 0]", k)) +
                           table("probe", "name = \"end\"\nat = [3, 0.5]")));
    EXPECT_NEAR(step.springs[0].force[0], s, 1e-10);
    EXPECT_NEAR(step.probes[0].value[0], -s / k, 1e-10);
    for (const double left : step.balance[0].sum()) EXPECT_NEAR(left, 0, 1e-10);
  }
}

// Two strips of thickness 1/2 each, S. Timoshenko, J. Opt. Soc. Am. 11 (1925) 233: the curvature is
// 24 (a2 - a1) T / (h (14 + n + 1/n)), n the ratio of the moduli.
TEST(Thermal, a_bimetal_strip_bends) {
  const double n = 3, curvature = 24 * (2.5e-3 - 1e-3) * T / (14 + n + 1 / n);
  const std::string strip =
      "shape = \"rectangle\"\nfrom = [0, -0.5]\nto = [16, 0.5]\ncells = [32, 2]\npoisson = 0.3\n" + stress_plane;
  const std::string rest = fix("on = \"left\"", "[0, \"free\"]") + fix("at = [0, 0]", "[0, 0]") +
                           table("probe", "name = \"middle\"\nat = [8, 0]") + "[refine]\nuniform = 1\n";
  const StepReport one =
      solved(text_of(strip + "order = 2\nyoung = \"y > 0 ? 3 : 1\"\nexpansion = \"y > 0 ? 1e-3 : 2.5e-3\"\n"
                             "temperature = 40\n",
                     rest));
  show("bimetal: {} of {}\n", one.probes[0].value[1], curvature * 32);
  EXPECT_NEAR(one.probes[0].value[1] / (curvature * 32), 1, 1e-6);
  // The same of two strips that are tied to each other.
  const auto half = [](const char* name, double from, double to, int cells, double young, double expansion) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"rectangle\"\nfrom = [0, {}]\nto = [16, {}]\n"
        "cells = [{}, 2]\norder = 2\nyoung = {}\npoisson = 0.3\nplane = \"stress\"\nexpansion = {}\n"
        "temperature = 40\n[[fix]]\nbody = \"{}\"\non = \"left\"\nvalue = [0, \"free\"]\n",
        name, from, to, cells, young, expansion, name);
  };
  const StepReport tied =
      solved(half("upper", 0, 0.5, 40, 3, 1e-3) + half("lower", -0.5, 0, 33, 1, 2.5e-3) +
                 "[[fix]]\nbody = \"lower\"\nat = [0, -0.5]\nvalue = [0, 0]\n" +
                 "[[obstacle]]\ntype = \"tied\"\nbody = \"upper\"\non = \"bottom\"\nother = \"lower\"\n"
                 "other_on = \"top\"\n[[probe]]\nname = \"foot\"\nbody = \"lower\"\nat = [0, -0.5]\n"
                 "[[probe]]\nname = \"middle\"\nbody = \"lower\"\nat = [8, -0.5]\n",
             {"solver.tolerance=1e-10"});
  show("tied: {}\n", tied.probes[1].value[1]);
  EXPECT_NEAR(tied.probes[1].value[1] / (curvature * 32), 1, 1e-3);
  for (const BalanceReport& balance : tied.balance)
    for (const double left : balance.sum()) EXPECT_NEAR(left, 0, 1e-7) << balance.body;
}

// A long tube, hot inside, its ends held: Timoshenko and Goodier, section 151. Of linear elements stresses at the ends
// are of first order, as they are in Lame's tube without heat.
TEST(Thermal, a_thick_tube_with_a_gradient) {
  const double nu = 0.3, a = 1, b = 2;
  // The integral of T r from a to r, T = 40 ln(b / r) / ln(b / a).
  const auto moment = [&](double r) {
    const auto F = [&](double x) { return x * x / 2 * std::log(b / x) + x * x / 4; };
    return T / std::log(b / a) * (F(r) - F(a));
  };
  const double factor = E * alpha / (1 - nu);
  const std::string tube =
      "shape = \"rectangle\"\nfrom = [1, 0]\nto = [2, 0.25]\ncells = [8, 2]\nplane = \"axisymmetric\"\n";
  for (const int p : {1, 2}) {
    Errors errors;
    for (const int refinements : p == 1 ? std::vector{2, 3} : std::vector{1, 2}) {
      const auto solved = run<2, 2>(text_of(tube + heated(nu, order(p), "40 * log(2 / x) / log(2)"),
                                            fix("where = \"y == 0 || y == 0.25\"", "[\"free\", 0]")),
                                    {"solver.tolerance=1e-12", uniform(refinements)});
      double worst = 0;
      const std::vector<Stress> found = stresses(solved, true);
      for (Index v = 0; v < solved.mesh().vertices(); ++v) {
        const double r = solved.mesh().points[v][0], I = moment(r), all = moment(b),
                     here = T * std::log(b / r) / std::log(b / a);
        const Stress expected{factor / (r * r) * ((r * r - a * a) / (b * b - a * a) * all - I),
                              factor * (2 * nu / (b * b - a * a) * all - here),
                              factor / (r * r) * ((r * r + a * a) / (b * b - a * a) * all + I - here * r * r)};
        for (int k = 0; k < 6; ++k) worst = std::max(worst, std::abs(found[v][k] - expected[k]));
      }
      errors.add(worst / (E * strain));
      show("tube: order {}, {} refinements: {}\n", p, refinements, errors.value.back());
    }
    EXPECT_LT(errors.value.back(), p == 1 ? 7e-3 : 2e-4);
    EXPECT_GT(errors.last_order(), p == 1 ? 0.9 : 2.3);
  }
}

// A gap d closes at half the temperature: from there on the wall presses.
TEST(Thermal, a_block_grows_against_a_wall_step_by_step) {
  const double d = 3 * strain / 2;
  for (const int p : {1, 2}) {
    Driver driver(
        parse_scene(text_of(plate + heated(0.3, stress_plane + order(p), "40 * t"),
                            on_planes_2 +
                                table("obstacle", fmt::format("type = \"contact\"\non = \"right\"\nshape = \"plane\"\n"
                                                              "point = [{}, 0]\nnormal = [-1, 0]",
                                                              3 + d)) +
                                table("probe", "name = \"end\"\nat = [3, 1]") + "[steps]\ncount = 4\n"),
                    "test.toml", ".", exact));
    EXPECT_TRUE(driver.solve().converged());
    for (std::size_t k = 0; k < 4; ++k) {
      const StepReport& step = driver.report().steps[k];
      const double t = 0.25 * static_cast<double>(k + 1), grown = 3 * strain * t,
                   pressed = std::max(0.0, grown - d) / 3;
      EXPECT_NEAR(step.probes[0].value[0], std::min(grown, d), 1e-10);
      EXPECT_NEAR(step.contact[0].force[0], -E * pressed, 1e-10);
      EXPECT_NEAR(step.probes[0].value[1], strain * t + 0.3 * pressed, 1e-10);
      for (const double left : step.balance[0].sum()) EXPECT_NEAR(left, 0, 1e-10);
    }
  }
}

// A shaft that is heated in a cold hub: (1 + nu) alpha T r is an interference, which Lame's solution divides.
TEST(Thermal, a_heated_shaft_presses_its_hub) {
  const auto ring = [](const char* name, double from, double to, int cells, double young, double nu, const char* more) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"rectangle\"\nfrom = [{}, 0]\nto = [{}, 0.25]\n"
        "cells = [{}, 2]\norder = 2\nyoung = {}\npoisson = {}\nplane = \"axisymmetric\"\n{}\n"
        "[[fix]]\nbody = \"{}\"\nwhere = \"y == 0 || y == 0.25\"\nvalue = [\"free\", 0]\n",
        name, from, to, cells, young, nu, more, name);
  };
  const auto compliance = [](double young, double nu, double a, double b, double sign) {
    const double modulus = young / (1 - nu * nu), ratio = nu / (1 - nu);
    return ((b * b + a * a) / (b * b - a * a) + sign * ratio) / modulus;
  };
  const double nu = 0.3, pressure = (1 + nu) * strain / (compliance(1, nu, 0.5, 1, -1) + compliance(3, 0.25, 1, 2, 1));
  const StepReport step = solved(ring("shaft", 0.5, 1, 8, 1, nu, "expansion = 1e-3\ntemperature = 40") +
                                     ring("hub", 1, 2, 12, 3, 0.25, "") +
                                     "[[obstacle]]\ntype = \"elastic\"\nbody = \"shaft\"\non = \"right\"\n"
                                     "other = \"hub\"\nother_on = \"left\"\n",
                                 {"solver.tolerance=1e-10", uniform(1)});
  show("shaft: {} of {}\n", step.contact[0].max_pressure, pressure);
  EXPECT_NEAR(std::abs(step.contact[0].force[0]) / (2 * pi * 0.25 * pressure), 1, 1e-3);
}

TEST(Thermal, planes_of_symmetry_see_the_temperature) {
  const std::string whole = "shape = \"rectangle\"\nfrom = [-3, 0]\nto = [3, 1]\ncells = [6, 1]\n";
  const auto half = [&](const char* temperature) {
    return solved(text_of(whole + heated(0.3, stress_plane, temperature),
                          fix("on = \"bottom\"", "[\"free\", 0]") + table("probe", "name = \"end\"\nat = [3, 1]") +
                              "[symmetry]\nx = 0\n"));
  };
  EXPECT_NEAR(half("40").probes[0].value[0], 3 * strain, 1e-10);
  EXPECT_THAT(refusal([&] { half("40 * x"); }), AllOf(HasSubstr("temperature"), HasSubstr("not symmetric")));
}

TEST(Thermal, has_no_bounds_of_the_error_where_it_changes_and_says_so) {
  const StepReport step =
      solved(text_of(plate + heated(0.3, order(1), "40 + x"), on_planes_2), {"solver.estimate=true"});
  ASSERT_TRUE(step.estimate);
  EXPECT_FALSE(step.estimate->guaranteed);
  EXPECT_THAT(step.estimate->reasons, testing::Contains(HasSubstr("thermal")));
}

}  // namespace
}  // namespace signorini::test
