// Springs and elastic foundations against closed forms.
#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/fem/assembly/springs.hpp"
#include "support.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string exact = "solver.tolerance=1e-12";

StepReport solved(const std::string& text, std::vector<std::string> more = {}) {
  more.push_back(exact);
  Driver driver(parse_scene(text, "test.toml", ".", more));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report().last();
}

/// A bar along x without lateral contraction, pulled by the traction p at its right end.
struct Bar {
  static constexpr double E = 2, p = 0.01, length = 3, height = 0.5, width = 0.25;
  int dimension, order;

  double area() const { return dimension == 2 ? height : height * width; }
  std::string text(const std::string& springs) const {
    const std::string body =
        dimension == 2 ? "shape = \"rectangle\"\nfrom = [0, 0]\nto = [3, 0.5]\ncells = [3, 1]\nplane = \"stress\"\n"
                       : "shape = \"box\"\nfrom = [0, 0, 0]\nto = [3, 0.25, 0.5]\ncells = [3, 1, 1]\n";
    return text_of(
        body + fmt::format("young = 2\npoisson = 0\norder = {}\n", order),
        table("load", fmt::format("on = \"right\"\nforce = [{}{}]", p * area(), zeros())) + springs +
            table("probe", dimension == 2 ? "name = \"end\"\nat = [3, 0.5]" : "name = \"end\"\nat = [3, 0.25, 0.5]") +
            "[refine]\nuniform = 2\n");
  }
  std::string zeros() const { return dimension == 2 ? ", 0" : ", 0, 0"; }
};

TEST(Springs, hold_a_bar_that_nothing_else_holds) {
  const double k = 0.04;
  for (const int dimension : {2, 3})
    for (const int order : {1, 2}) {
      const Bar bar{dimension, order};
      const std::string left = "on = \"left\"\n";
      for (const std::string& keys :
           {fmt::format("{}stiffness = {}", left, k), fmt::format("{}total = {}", left, k * bar.area()),
            fmt::format("{}frame = \"normal\"\nstiffness = [{}, 0.3{}]", left, k, dimension == 2 ? "" : ", 0.3"),
            fmt::format("{}stiffness = [{}, 0.3{}]", left, k, dimension == 2 ? "" : ", 0.3")}) {
        SCOPED_TRACE(fmt::format("{}D, order {}: {}", dimension, order, keys));
        const StepReport step = solved(bar.text(table("spring", keys)));
        EXPECT_NEAR(step.probes[0].value[0], Bar::p / k + Bar::p * Bar::length / Bar::E, 1e-9);
        EXPECT_NEAR(step.springs.at(0).force[0], -Bar::p * bar.area(), 1e-11);
        EXPECT_NEAR(step.balance[0].reactions[0], -Bar::p * bar.area(), 1e-11);
        EXPECT_THAT(step.undetermined, IsEmpty());
        EXPECT_LE(step.summary.iterations, 12);
      }
    }
}

// Only along x: what the spring leaves free is told, as for fixes.
TEST(Springs, of_one_direction_leave_the_others_free) {
  const StepReport step = solved(Bar{2, 1}.text(table("spring", "on = \"left\"\nstiffness = [0.04, 0]")));
  ASSERT_EQ(step.undetermined.size(), 1u);  // no turn: the left end stays upright
  EXPECT_THAT(step.undetermined[0], HasSubstr("translation along (0, 1)"));
  EXPECT_NEAR(step.probes[0].value[0], 0.01 / 0.04 + 0.01 * 3 / 2, 1e-9);
}

// M. Hetenyi 1946: a long beam on a Winkler foundation under q on |x| < a sinks by q / k (1 - exp(-l a) cos(l a)) in
// the middle, l^4 = k / (4 E I). Shear adds about 2 (l h)^2 of that by E / G, here a thousandth.
TEST(Springs, a_beam_sinks_into_a_winkler_foundation) {
  const double l = 0.05, k = 4 * std::pow(l, 4) / 12, q = 1e-5, a = 4;
  for (const bool half : {true, false}) {
    const StepReport step = solved(
        text_of(fmt::format("shape = \"rectangle\"\nfrom = [-128, 0]\nto = [128, 1]\ncells = [128, 1]\nyoung = 1\n"
                            "poisson = 0\nplane = \"stress\"\norder = 2\n"),
                table("load", fmt::format("where = \"y == 1 && abs(x) <= {}\"\npressure = {}", a, q)) +
                    table("spring", fmt::format("on = \"bottom\"\nstiffness = [{}, {}]", half ? 0 : 1e-9, k)) +
                    table("probe", "name = \"middle\"\nat = [0, 0.5]") + (half ? "[symmetry]\nx = 0\n" : "")));
    const double w = q / k * (1 - std::exp(-l * a) * std::cos(l * a));
    show("beam: {} of {}\n", -step.probes[0].value[1], w);
    EXPECT_NEAR(-step.probes[0].value[1] / w, 1, 1e-3);
    EXPECT_NEAR(step.springs[0].force[1], 2 * a * q, 1e-9 * q);
  }
}

constexpr double nu = 0.3, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu));

// A disk in a springy ring, and on a springy floor: u_r = c r with 2 (lambda + mu) c = -p - k c a.
TEST(Springs, hold_a_disk_of_revolution) {
  const double p = 0.01, k = 0.7, a = 2, force = 0.2, floor = 0.3;
  for (const int order : {1, 2}) {
    const StepReport step =
        solved(text_of(fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\nyoung = 1\n"
                                   "poisson = 0.3\nplane = \"axisymmetric\"\norder = {}\n",
                                   order),
                       table("fix", "where = \"y == 0 || y == 1\"\nvalue = [\"free\", 0]") +
                           table("load", fmt::format("on = \"right\"\npressure = {}", p)) +
                           table("spring", fmt::format("on = \"right\"\nframe = \"normal\"\nstiffness = [{}, 0]", k)) +
                           table("probe", "name = \"rim\"\nat = [2, 0.5]")));
    const double c = -p / (2 * (lambda + mu) + k * a);
    EXPECT_NEAR(step.probes[0].value[0], c * a, 1e-10);
    EXPECT_NEAR(step.springs[0].force[0], -k * c * a * 2 * pi * a, 1e-9);
    const StepReport sunk =
        solved(text_of(fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\nyoung = 1\n"
                                   "poisson = 0\nplane = \"axisymmetric\"\norder = {}\n",
                                   order),
                       table("load", fmt::format("on = \"top\"\nforce = [0, {}]", -force)) +
                           table("spring", fmt::format("on = \"bottom\"\ntotal = [0, {}]", floor)) +
                           table("probe", "name = \"top\"\nat = [1, 1]")));
    EXPECT_NEAR(sunk.probes[0].value[1], -force / floor - force / (pi * a * a), 1e-9);
    EXPECT_NEAR(sunk.springs[0].force[1], force, 1e-10);
  }
}

// A bar whose left end is moved by d, with a spring of k per area at its right end: u = d s / (s + k), s = E / L.
TEST(Springs, hold_against_one_common_prescribed_value) {
  const double d = 0.1, k = 50, stiff = 1000.0 / 2, u = d * stiff / (stiff + k);
  const std::string spring = table("spring", fmt::format("on = \"right\"\nstiffness = {}", k)),
                    probe = table("probe", "name = \"end\"\nat = [2, 0.5]"), refined = "[refine]\nuniform = 1\n";
  const std::string bar = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\n";
  const std::string elastic = bar + "young = 1000\npoisson = 0\n";
  const std::vector<std::string> scenes{
      text_of(elastic, table("fix", fmt::format("on = \"left\"\nvalue = [{}, 0]", d)) + spring + probe),
      text_of(elastic,
              table("rigid", fmt::format("on = \"left\"\ndisplacement = [{}, 0]\nrotation = [0]", d)) + spring + probe),
      text_of(bar + "equation = \"diffusion\"\ndiffusion = 1000\n",
              table("fix", fmt::format("on = \"left\"\nvalue = {}", d)) + spring + probe),
      text_of("shape = \"rectangle\"\nfrom = [1, 0]\nto = [2, 2]\ncells = [2, 4]\nyoung = 1000\npoisson = 0\n"
              "plane = \"axisymmetric\"\n",
              table("fix", fmt::format("on = \"bottom\"\nvalue = [0, {}]", d)) +
                  table("spring", fmt::format("on = \"top\"\nstiffness = [0, {}]", k)) +
                  table("probe", "name = \"end\"\nat = [1.5, 2]"))};
  for (const std::string& scene : scenes) {
    SCOPED_TRACE(scene);
    const bool axial = &scene == &scenes.back();
    const double area = axial ? 3 * pi : 1;
    const StepReport step = solved(scene + refined);
    EXPECT_NEAR(step.probes[0].value[axial ? 1 : 0], u, 1e-9);
    const std::size_t along = axial ? 1 : 0;
    EXPECT_NEAR(step.springs.at(0).force[along], -k * u * area, 1e-8);
    EXPECT_NEAR(step.balance[0].reactions[along] + step.balance[0].applied[along], 0, 1e-7);
    // What an independent sum of springs has: bar and spring beside each other.
    EXPECT_NEAR(step.summary.energy, area * (stiff * (d - u) * (d - u) + k * u * u) / 2, 1e-9 * area);
  }
}

// The same where bodies are glued, and where an obstacle holds the other end: the bar is moved to it, and past.
TEST(Springs, hold_against_one_common_prescribed_value_of_several_bodies) {
  const auto block = [](const std::string& name, int from, int to, int cells) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"rectangle\"\nfrom = [{}, 0]\nto = [{}, 1]\ncells = [{}, {}]\n"
        "young = 1000\npoisson = 0\n",
        name, from, to, cells, cells);
  };
  const StepReport step =
      solved(block("b", 0, 1, 4) + block("c", 1, 2, 3) + table("fix", "on = \"left\"\nvalue = [0.1, 0]") +
             "[[obstacle]]\ntype = \"tied\"\nbody = \"b\"\non = \"right\"\nother = \"c\"\nother_on = \"left\"\n"
             "[[spring]]\nbody = \"c\"\non = \"right\"\nstiffness = 50\n"
             "[[probe]]\nname = \"end\"\nbody = \"c\"\nat = [2, 0.5]\n");
  EXPECT_NEAR(step.probes[0].value[0], 0.1 * 500 / 550, 1e-9);
}

// Moved by d along x and pressed on a plane: as if the spring had been loaded by -k d, and only the rest were moved.
TEST(Springs, hold_against_one_common_prescribed_value_in_contact) {
  const std::string
      body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [8, 4]\nyoung = 1000\npoisson = 0.3\n",
      rest = table("spring", "on = \"right\"\nstiffness = [50, 0]") + table("probe", "name = \"p\"\nat = [2, 0.5]") +
             table("obstacle",
                   "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\n"
                   "point = [0, 0]\nnormal = [0, 1]");
  const StepReport moved = solved(text_of(body, table("fix", "on = \"top\"\nvalue = [0.1, -0.01]") + rest)),
                   loaded = solved(text_of(body, table("fix", "on = \"top\"\nvalue = [0, -0.01]") +
                                                     table("load", "on = \"right\"\nvalue = [-5, 0]") + rest));
  EXPECT_NEAR(moved.probes[0].value[0], loaded.probes[0].value[0] + 0.1, 1e-8);
  EXPECT_NEAR(moved.probes[0].value[1], loaded.probes[0].value[1], 1e-8);
  EXPECT_NEAR(moved.contact[0].force[1], loaded.contact[0].force[1], 1e-5);
}

// A steel ball under pressure on springs so soft that turning it costs next to nothing, which cycles do not see: it
// shrinks evenly, u = -p (1 - 2 nu) / E x, and does not turn. The middle of the mesh is off that of the ball by 3e-5.
TEST(Springs, that_are_soft_keep_a_stiff_body_from_turning) {
  for (const auto& [stiffness, poisson] : {std::pair{1e-3, 0.3}, {1e-4, 0.3}, {1e-3, 0.4999}}) {
    const Report report = [&] {
      Driver driver(parse_scene(
          text_of("shape = \"ball\"\ncenter = [0, 0, 0]\nradius = 10\nsize = 5\nyoung = 210000\norder = 2\n" +
                      fmt::format("poisson = {}\n", poisson),
                  table("spring", fmt::format("on = \"boundary\"\nstiffness = {}", stiffness)) +
                      table("load", "on = \"boundary\"\npressure = 100") +
                      table("probe", "name = \"x\"\nat = [9, 0, 0]") + table("probe", "name = \"y\"\nat = [0, 9, 0]") +
                      table("probe", "name = \"z\"\nat = [0, 0, 9]")),
          "test.toml", "."));
      return driver.solve();
    }();
    ASSERT_TRUE(report.converged()) << report.reason();
    const double shrunk = 9 * 100 * (1 - 2 * poisson) / 210000;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(report.last().probes[k].value[i], i == k ? -shrunk : 0, (poisson > 0.4 ? 1e-4 : 5e-6) * shrunk)
            << stiffness;
  }
}

// Two blocks in contact, the upper one loaded and held by a spring: springs beside each other bear F = (K + E A / L) d.
TEST(Springs, hold_bodies_that_touch) {
  const std::string material = "young = 2\npoisson = 0\n";
  const StepReport step = solved(
      "[[body]]\nname = \"low\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\n" + material +
      "[[body]]\nname = \"high\"\nshape = \"rectangle\"\nfrom = [0, 1]\nto = [1, 2]\ncells = [3, 3]\n" + material +
      "[[fix]]\nbody = \"low\"\non = \"bottom\"\nvalue = [0, 0]\n"
      "[[load]]\nbody = \"high\"\non = \"top\"\nforce = [0, -0.03]\n"
      "[[spring]]\nbody = \"high\"\non = \"top\"\ntotal = [0.1, 0.5]\n"
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"high\"\non = \"bottom\"\nother = \"low\"\nother_on = \"top\"\n"
      "[[probe]]\nname = \"top\"\nbody = \"high\"\nat = [0.3, 2]\n");
  const double d = 0.03 / (0.5 + 2.0 / 2);
  EXPECT_NEAR(step.probes[0].value[1], -d, 1e-8);
  EXPECT_NEAR(step.springs[0].force[1], 0.5 * d, 1e-8);
  EXPECT_NEAR(step.contact[0].force[1], 0.03 - 0.5 * d, 1e-8);
}

// The matrix is made anew where a stiffness depends on t, and only there.
TEST(Springs, may_depend_on_the_step) {
  Driver driver(parse_scene(
      Bar{2, 2}.text(table("spring", "on = \"left\"\nstiffness = [\"0.04 * t\", 0.3]")) + "[steps]\ncount = 2\n",
      "test.toml", ".", std::vector<std::string>{exact}));
  ASSERT_TRUE(driver.solve().converged());
  for (const StepReport& step : driver.report().steps)
    EXPECT_NEAR(step.probes[0].value[0], 0.01 / (0.04 * step.t) + 0.01 * 3 / 2, 1e-9);
}

// A thing of its own for scalars: what flows out in proportion to the value there.
TEST(Springs, of_a_scalar_body_let_out_in_proportion_to_the_value) {
  for (const int order : {1, 2}) {
    const StepReport step = solved(text_of(
        fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\norder = {}\n"
                    "equation = \"diffusion\"\n",
                    order),
        table("fix", "on = \"left\"\nvalue = 0") + table("load", "on = \"right\"\nvalue = 3") +
            table("spring", "on = \"right\"\nstiffness = 0.25") + table("probe", "name = \"end\"\nat = [2, 0]")));
    EXPECT_NEAR(step.probes[0].value[0], 3 / (0.5 + 0.25), 1e-9);
    EXPECT_NEAR(step.springs[0].force[0], -0.25 * 4, 1e-9);
    EXPECT_NEAR(step.reactions[0].force[0], -0.5 * 4, 1e-9);
  }
}

// A total is that of the faces on both sides of the plane, and is not that of each side where they lie on one.
TEST(Springs, of_a_symmetric_body_are_those_of_the_whole) {
  for (const bool half : {false, true}) {
    const StepReport step = solved(text_of(
        "shape = \"rectangle\"\nfrom = [-1, 0]\nto = [1, 1]\ncells = [4, 2]\nyoung = 1\npoisson = 0\n",
        table("load", "on = \"top\"\nforce = [0, -0.1]") + table("spring", "on = \"bottom\"\ntotal = [0.5, 2]") +
            table("probe", "name = \"top\"\nat = [0, 1]") + (half ? "[symmetry]\nx = 0\n" : "")));
    EXPECT_NEAR(step.probes[0].value[1], -0.1 / 2 - 0.1 / 2, 1e-9);
    EXPECT_NEAR(step.springs[0].force[1], 0.1, 1e-10);
    EXPECT_NEAR(step.balance[0].sum()[1], 0, 1e-10);
  }
}

// What a shift of the whole body feels: K in all directions, and of springs against the normal of a half ball a third
// of it. The matrix stays symmetric to the last bit.
TEST(Springs, of_curved_faces_bear_a_shift_with_their_total_stiffness) {
  for (const int order : {1, 2})
    for (const bool normal : {false, true}) {
      const auto solved =
          run<3, 3>(text_of(fmt::format("shape = \"half_ball\"\ncenter = [0, 0, 0]\nradius = 1\nsize = 0.5\nyoung = "
                                        "1\npoisson = 0.3\norder = {}\n",
                                        order),
                            table("spring", normal ? "on = \"curved\"\nframe = \"normal\"\ntotal = [3, 0, 0]"
                                                   : "on = \"curved\"\ntotal = 3") +
                                table("fix", "on = \"flat\"\nvalue = [0, 0, 0]")));
      const Nodes<3> nodes = solved.nodes();
      BlockMatrix<3> A = stiffness<3, 3>(nodes, solved.model);
      std::ranges::fill(A.value, 0);
      add_springs(nodes, solved.model, A);
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (Index p = 0; p < A.size(); ++p)
        for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
          const Index q = A.column[k];
          const auto back =
              std::find(A.column.begin() + A.row[q], A.column.begin() + A.row[q + 1], p) - A.column.begin();
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
              sum(i, j) += A.at(k)[i * 3 + j];
              EXPECT_EQ(A.at(k)[i * 3 + j], A.at(back)[j * 3 + i]);
            }
        }
      if (normal) EXPECT_NEAR(sum.trace(), 3, 1e-12);
      const double third = order == 2 ? 2e-3 : 0.05;
      EXPECT_LT((sum - (normal ? 1 : 3) * Eigen::Matrix3d::Identity()).norm(), normal ? third : 1e-12);
    }
}

TEST(Springs, errors_say_what_a_spring_may_be) {
  const std::string body =
      "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\nyoung = 1\npoisson = 0\n";
  const auto refused = [&](const std::string& keys) {
    return refusal([&] { parse_scene(text_of(body, table("spring", keys)), "s.toml", "."); });
  };
  EXPECT_THAT(refused("on = \"left\""), AllOf(HasSubstr("spring.0"), HasSubstr("neither 'stiffness' nor 'total'")));
  EXPECT_THAT(refused("on = \"left\"\nstiffness = 1\ntotal = 1"), HasSubstr("both 'stiffness' and 'total'"));
  EXPECT_THAT(refused("stiffness = 1"), HasSubstr("neither 'on' nor 'where'"));
  EXPECT_THAT(refused("on = \"left\"\nstiffness = -1"), AllOf(HasSubstr("spring.0.stiffness"), HasSubstr("-1")));
  EXPECT_THAT(refused("on = \"left\"\nstiffness = 0"), HasSubstr("nothing is held"));
  EXPECT_THAT(refused("on = \"left\"\nstiffness = [1, 2, 3]"), HasSubstr("expected 2 components, found 3"));
  EXPECT_THAT(refused("on = \"left\"\ntotal = \"x\""), HasSubstr("t alone"));
  EXPECT_THAT(refusal([&] { parse_scene(text_of(body, ""), "s.toml", "."); }), HasSubstr("[[spring]]"));
}

}  // namespace
}  // namespace signorini::test
