// Loads that are given in total: what acts at nodes sums to them, and bends and twists as they should.
#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "support.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* elastic = "young = 1\npoisson = 0.3\n";

std::string order(int order) { return fmt::format("order = {}\n", order); }

const std::string square = "shape = \"rectangle\"\nfrom = [1, 0]\nto = [3, 1]\ncells = [2, 3]\n";
const std::string half_disk = "shape = \"half_disk\"\ncenter = [1, 2]\nradius = 1.5\nsize = 0.7\n";
const std::string cube = "shape = \"box\"\nfrom = [1, 0, 0]\nto = [3, 1, 1]\ncells = [3, 2, 1]\n";
const std::string shaft = "shape = \"cylinder\"\ncenter = [0, 0, 1]\nradius = 1\nheight = 2\nsize = 0.8\n";

/// The load of a body that is fixed on `fixed`.
template <int D>
Run<D, D> loaded(const std::string& body, const std::string& fixed, const std::string& load,
                 const std::string& more = "") {
  const std::string zero = D == 2 ? "[0, 0]" : "[0, 0, 0]";
  return run<D, D>(text_of(body, table("fix", fixed + "\nvalue = " + zero) + table("load", load) + more),
                   {"solver.tolerance=1e-12"});
}

template <int D>
void expect_total(const std::string& body, const std::string& fixed, const std::string& on, const Vector<D>& force,
                  const Eigen::Vector3d& torque, const Vector<D>& about) {
  for (const int p : {1, 2}) {
    SCOPED_TRACE(body + on + order(p));
    std::string load = on + "\nforce = [";
    for (int i = 0; i < D; ++i) load += fmt::format("{}{}", i ? ", " : "", force[i]);
    load += "]\nabout = [";
    for (int i = 0; i < D; ++i) load += fmt::format("{}{}", i ? ", " : "", about[i]);
    load += D == 2 ? fmt::format("]\ntorque = {}", torque[2])
                   : fmt::format("]\ntorque = [{}, {}, {}]", torque[0], torque[1], torque[2]);
    const Run<D, D> solved = loaded<D>(body + elastic + order(p), fixed, load);
    const std::vector<double>& b = solved.solution.discretization.load;
    const double size = force.norm() + torque.norm();
    EXPECT_LT((sum<D>(b) - force).norm(), 1e-13 * size);
    EXPECT_LT((moment<D>(solved.nodes(), b, about) - torque).norm(), 1e-12 * size);
    // Equilibrium: what the fix exerts balances both.
    std::vector<double> reaction = internal_forces(solved);
    for (std::size_t k = 0; k < b.size(); ++k) reaction[k] -= b[k];
    EXPECT_LT((moment<D>(solved.nodes(), reaction, about) + torque).norm(), 1e-9 * size);
    for (int i = 0; i < D; ++i) {
      EXPECT_NEAR(solved.results.forces.applied[0][i], force[i], 1e-13 * size);
      EXPECT_NEAR(solved.results.forces.reactions[0][i], -force[i], 1e-9 * size);
    }
  }
}

TEST(Totals, forces_and_moments_at_nodes_sum_to_them_and_reactions_balance_them) {
  const Eigen::Vector3d turn(0, 0, 0.7);
  expect_total<2>(square, "on = \"left\"", "on = \"right\"", {0.3, -0.2}, turn, {2.5, 1.5});
  expect_total<2>(square, "on = \"left\"", "", {0.3, -0.2}, turn, {2.5, 1.5});
  expect_total<2>(half_disk, "on = \"flat\"", "on = \"curved\"", {0.3, -0.2}, turn, {0, 0});
  const Eigen::Vector3d twist(0.4, -0.3, 0.7);
  expect_total<3>(cube, "on = \"left\"", "on = \"right\"", {0.3, -0.2, 0.1}, twist, {2.5, 1.5, 0});
  expect_total<3>(cube, "on = \"left\"", "", {0.3, -0.2, 0.1}, twist, {2.5, 1.5, 0});
  expect_total<3>(cube, "on = \"left\"", "where = \"x > 1.5\"", {0.3, -0.2, 0.1}, twist, {2.5, 1.5, 0});
  expect_total<3>(shaft, "on = \"bottom\"", "on = \"side\"", {0.3, -0.2, 0.1}, twist, {0.5, 0, 1});
}

// Without `about` a torque is that of a couple, and a force one through the centroid.
TEST(Totals, are_about_the_centroid_by_default) {
  const auto both = loaded<3>(cube + elastic, "on = \"left\"", "on = \"right\"\nforce = [0, 0, 1]\ntorque = [0, 2, 0]");
  const auto explicitly = loaded<3>(cube + elastic, "on = \"left\"",
                                    "on = \"right\"\nforce = [0, 0, 1]\ntorque = [0, 2, 0]\nabout = [3, 0.5, 0.5]");
  const auto &a = both.solution.discretization.load, &b = explicitly.solution.discretization.load;
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

// The whole body of revolution: a force along the axis, spread over rings, and the integral of radial forces.
TEST(Totals, of_a_body_of_revolution_are_those_of_all_of_it) {
  for (const int p : {1, 2})
    for (const std::string on : {"on = \"top\"", ""})
      for (const std::string& body : {square, half_disk}) {
        SCOPED_TRACE(body + on + order(p));
        const bool round = body == half_disk;
        std::string moved = body;
        if (round) moved.replace(moved.find("[1, 2]"), 6, "[2, 2]");
        const auto solved = loaded<2>(moved + elastic + order(p) + "plane = \"axisymmetric\"\n",
                                      round ? "on = \"flat\"" : "on = \"bottom\"",
                                      (round && !on.empty() ? "on = \"curved\"" : on) + "\nforce = [0.5, -3]");
        const Vector<2> total = sum<2>(solved.solution.discretization.load);
        EXPECT_LT((total - Vector<2>(0.5, -3)).norm(), 1e-13);
        EXPECT_NEAR(solved.results.forces.reactions[0][1], 3, 1e-9);
      }
}

TEST(Totals, of_a_scalar_body_are_fluxes_and_sources) {
  for (const std::string on : {"on = \"right\"", ""}) {
    const auto solved =
        run<2, 1>(text_of(square + "equation = \"diffusion\"",
                          table("fix", "on = \"left\"\nvalue = 0") + table("load", on + "\nforce = 2.5")));
    EXPECT_NEAR(solved.results.forces.applied[0][0], 2.5, 1e-14);
    EXPECT_NEAR(solved.results.forces.reactions[0][0], -2.5, 1e-6);
  }
}

// Saint-Venant: without lateral contraction a clamped bar under a couple bends to a parabola, which quadratic elements
// have: u_x = -k x y, u_y = k x^2 / 2 with k = M / (E I).
TEST(Totals, a_couple_bends_a_bar_to_a_parabola) {
  const auto plane = loaded<2>(
      "shape = \"rectangle\"\nfrom = [0, -0.5]\nto = [4, 0.5]\ncells = [4, 1]\nyoung = 2\n"
      "poisson = 0\norder = 2\n",
      "on = \"left\"", "on = \"right\"\ntorque = \"0.01 * t\"");
  const double k = 0.01 / (2 * 1.0 / 12);
  const std::vector<double> u = plane.nodes().at_vertices(plane.u(), 2);
  for (Index v = 0; v < plane.mesh().vertices(); ++v) {
    const auto [x, y] = plane.mesh().points[v];
    EXPECT_LT((displacement<2>(u, v) - Vector<2>(-k * x * y, k * x * x / 2)).norm(), 1e-9);
  }
}

/// The same in space about x, and with the part on one side of x = 0: a torque is that of both sides.
TEST(Totals, of_a_symmetric_body_are_those_of_the_whole) {
  for (const bool half : {false, true}) {
    const auto bar = loaded<3>(
        "shape = \"box\"\nfrom = [-1, -0.5, 0]\nto = [1, 0.5, 4]\ncells = [2, 1, 4]\nyoung = 2\n"
        "poisson = 0\norder = 2\n",
        "on = \"bottom\"", "on = \"top\"\ntorque = [0.01, 0, 0]\nforce = [0, 0, 0.3]",
        half ? "[symmetry]\nx = 0\n" : "");
    const double k = 0.01 / (2 * 2.0 / 12), strain = 0.3 / 2 / 2;
    const std::vector<double> u = bar.nodes().at_vertices(bar.u(), 3);
    for (Index v = 0; v < bar.mesh().vertices(); ++v) {
      const auto [x, y, z] = bar.mesh().points[v];
      EXPECT_LT((displacement<3>(u, v) - Vector<3>(0, -k * z * z / 2, k * y * z + strain * z)).norm(), 1e-8);
    }
    const Whole whole(bar.mesh().mirrors, bar.results.across.loads[0]);
    EXPECT_NEAR(whole.total(bar.results.forces.applied[0])[2], 0.3, 1e-13);
    EXPECT_EQ(whole.copies(), half ? 2 : 1);
  }
}

// Faces on one side of the plane have an image on the other one: each bears the total.
TEST(Totals, on_one_side_of_a_plane_of_symmetry_are_those_of_that_side) {
  Driver driver(parse_scene(text_of("shape = \"rectangle\"\nfrom = [-2, 0]\nto = [2, 1]\ncells = [4, 1]\nyoung = 1\n"
                                    "poisson = 0\nplane = \"stress\"\n",
                                    table("fix", "on = \"bottom\"\nvalue = [\"free\", 0]") +
                                        table("load", "on = \"right\"\nforce = [0.25, 0]") +
                                        "[[probe]]\nname = \"p\"\nbody = \"b\"\nat = [-2, 1]\n[symmetry]\nx = 0\n"),
                            "test.toml", "."));
  ASSERT_TRUE(driver.solve().converged());
  const StepReport& step = driver.report().last();
  EXPECT_NEAR(step.applied[0].force[0], 0.25, 1e-14);
  EXPECT_NEAR(step.probes[0].value[0], -0.5, 1e-7);
}

TEST(Totals, that_are_not_symmetric_are_refused) {
  const auto refused = [](const std::string& load) {
    return refusal([&] {
      loaded<3>("shape = \"box\"\nfrom = [-1, -0.5, 0]\nto = [1, 0.5, 4]\ncells = [2, 1, 4]\nyoung = 2\npoisson = 0\n",
                "on = \"bottom\"", "on = \"top\"\n" + load, "[symmetry]\nx = 0\n");
    });
  };
  EXPECT_THAT(refused("force = [1, 0, 0]"), AllOf(HasSubstr("load.0.force"), HasSubstr("force of 1 along x"),
                                                  HasSubstr("x = 0"), HasSubstr("expected 0")));
  EXPECT_THAT(refused("torque = [0, 0, 2]"), AllOf(HasSubstr("load.0.torque"), HasSubstr("moment of 2 about z")));
}

// Gauss: the resultant of a uniform pressure on the curved part is that on the flat one, on the mesh as it is.
template <int D>
void expect_archimedes(const std::string& body, const std::string& curved, const std::string& flat) {
  for (const int p : {1, 2}) {
    SCOPED_TRACE(body + order(p));
    const auto solved = loaded<D>(body + elastic + order(p), flat, curved + "\npressure = 0.02");
    const Nodes<D> nodes = solved.nodes();
    const Surface<D> picked = surface(nodes, select_faces(nodes.mesh(), solved.model.fixes[0].on, 1));
    double area = 0;
    for (const double a : node_areas(nodes, picked)) area += a;
    Vector<D> expected = Vector<D>::Zero();
    expected[D - 1] = 0.02 * area;
    EXPECT_LT((sum<D>(solved.solution.discretization.load) - expected).norm(), 1e-14);
  }
}

TEST(Totals, a_pressure_is_against_the_normal_of_curved_faces) {
  expect_archimedes<2>(half_disk, "on = \"curved\"", "on = \"flat\"");
  expect_archimedes<3>("shape = \"half_ball\"\ncenter = [0, 0, 0]\nradius = 1\nsize = 0.6\n", "on = \"curved\"",
                       "on = \"flat\"");
  const auto a = loaded<2>(square + elastic, "on = \"left\"", "on = \"right\"\npressure = \"y * t\""),
             b = loaded<2>(square + elastic, "on = \"left\"", "on = \"right\"\nvalue = [\"-y\", 0]");
  for (std::size_t k = 0; k < a.u().size(); ++k) EXPECT_NEAR(a.u()[k], b.u()[k], 1e-12);
}

TEST(Totals, of_bodies_that_touch_are_those_of_the_one_they_are_given_for) {
  Driver driver(parse_scene(R"(
[[body]]
name = "low"
shape = "box"
from = [0, 0, 0]
to = [1, 1, 1]
cells = [2, 2, 2]
young = 1
poisson = 0.2
[[body]]
name = "high"
shape = "box"
from = [0, 0, 1]
to = [1, 1, 2]
cells = [3, 3, 3]
young = 1
poisson = 0.2
[[fix]]
body = "low"
on = "bottom"
value = [0, 0, 0]
[[fix]]
body = "high"
where = "x == 0"
value = [0, 0, "free"]
[[load]]
body = "high"
on = "top"
force = [0, 0, -0.02]
[[load]]
body = "high"
force = [0, 0, -0.01]
[[obstacle]]
type = "elastic"
body = "high"
on = "bottom"
other = "low"
other_on = "top"
)",
                            "test.toml", "."));
  ASSERT_TRUE(driver.solve().converged());
  const StepReport& step = driver.report().last();
  EXPECT_NEAR(step.applied[0].force[2], -0.02, 1e-15);
  EXPECT_NEAR(step.applied[1].force[2], -0.01, 1e-15);
  EXPECT_NEAR(step.contact[0].force[2], 0.03, 1e-8);
  EXPECT_NEAR(step.reactions[0].force[2], 0.03, 1e-8);
}

std::string refused_load(const std::string& body, const std::string& load) {
  const std::string held = body.find("diffusion") == std::string::npos ? "[0, 0]" : "0";
  return refusal(
      [&] { parse_scene(text_of(body, table("fix", "on = \"left\"\nvalue = " + held) + load), "s.toml", "."); });
}

TEST(Totals, errors_say_what_a_load_may_be) {
  const std::string body = square + elastic, scalar = square + "equation = \"diffusion\"\n";
  const auto refused = [&](const std::string& keys, const std::string& of) {
    return refused_load(of, table("load", keys));
  };
  EXPECT_THAT(refused("on = \"right\"", body), AllOf(HasSubstr("load.0"), HasSubstr("none of 'value'")));
  EXPECT_THAT(refused("value = [0, 0]\nforce = [0, 0]", body),
              AllOf(HasSubstr("load.0.force"), HasSubstr("both 'value' and 'force'")));
  EXPECT_THAT(refused("on = \"right\"\nforce = [0, \"x\"]", body),
              AllOf(HasSubstr("load.0.force[1]"), HasSubstr("t alone"), HasSubstr("'x'")));
  EXPECT_THAT(refused("on = \"right\"\nforce = [0, 0, 1]", body), HasSubstr("expected 2 components, found 3"));
  EXPECT_THAT(refused("on = \"right\"\ntorque = [0, 0, 1]", body), HasSubstr("expected 1 component, found 3"));
  EXPECT_THAT(refused("pressure = 1", body), HasSubstr("a pressure acts on faces"));
  EXPECT_THAT(refused("on = \"right\"\npressure = 1\nabout = [0, 0]", body), HasSubstr("'about' has no meaning"));
  EXPECT_THAT(refused("on = \"right\"\npressure = 1", scalar), HasSubstr("for equation = 'diffusion'"));
  EXPECT_THAT(refused("on = \"right\"\ntorque = 1", body + "plane = \"axisymmetric\"\n"),
              HasSubstr("'torque' has no meaning for an axisymmetric body"));
}

}  // namespace
}  // namespace signorini::test
