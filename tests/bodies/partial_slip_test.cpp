#include <algorithm>
#include <numbers>

#include "tests/bodies/scenes.hpp"

// Two elastic cylinders, alike, or two balls, pressed on each other and then pushed sideways: the case in which the
// theory of C. Cattaneo (1938) and R. D. Mindlin (1949) is exact, for normal and tangential displacements do not depend
// on each other's tractions. (For balls but for the slip across the force, which it neglects.)

namespace signorini::test {
namespace {

std::string cylinders(int refinements, const char* slave) {
  return "[[body]]\nname = \"upper\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\nsize = \"0.01 + 0.3 * "
         "sqrt(x^2 + y^2)\"\n" +
         material(1) +
         "[[body]]\nname = \"lower\"\nshape = \"disk\"\ncenter = [0, -1]\nradius = 1\nsize = \"0.01 + 0.3 * sqrt(x^2 + "
         "y^2)\"\n" +
         material(1) + tables::fix("upper", "flat", "[\"0.0015 * max(0, 2 * t - 1)\", \"-0.003 * min(1, 2 * t)\"]") +
         "[[fix]]\nbody = \"lower\"\nwhere = \"y < -1\"\nvalue = [0, 0]\n"
         "[[obstacle]]\ntype = \"elastic_coulomb\"\nbody = \"upper\"\non = \"curved\"\nother = \"lower\"\n"
         "other_where = \"y > -0.5\"\nfriction = 0.4\n" +
         fmt::format("slave = \"{}\"\n[refine]\nuniform = {}\n[steps]\ncount = 4\n", slave, refinements);
}

std::string spheres(int refinements) {
  const auto ball = [](const char* name, const char* shape, int middle) {
    return fmt::format(
               "[[body]]\nname = \"{}\"\nshape = \"{}\"\ncenter = [0, 0, {}]\nradius = 1\nsize = \"0.05 + 0.5 * "
               "sqrt(x^2 + "
               "y^2 + z^2)\"\n",
               name, shape, middle) +
           material(1);
  };
  return ball("upper", "half_ball", 1) + ball("lower", "ball", -1) +
         tables::fix("upper", "flat", "[\"0.008 * max(0, 2 * t - 1)\", 0, \"-0.02 * min(1, 2 * t)\"]") +
         "[[fix]]\nbody = \"lower\"\nwhere = \"z < -1\"\nvalue = [0, 0, 0]\n"
         "[[obstacle]]\ntype = \"elastic_coulomb\"\nbody = \"upper\"\non = \"curved\"\nother = \"lower\"\n"
         "other_where = \"z > -0.5\"\nfriction = 0.4\n" +
         fmt::format("[refine]\nuniform = {}\n[steps]\ncount = 2\n", refinements);
}

// Johnson, Contact Mechanics, 1985, ch. 7.2: with the force Q across the force P it sticks within c = a (1 - Q / (mu
// P))^(1/D), and the traction in the middle is mu p0 (1 - c / a).
template <int D>
void expect_partial_slip(const std::string& scene, double tolerance) {
  constexpr double friction = 0.4;
  Driver driver(scene_of(scene));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  expect_opposite(contact);
  const double across = length(contact.tangential_force), pressing = length(contact.normal_force);
  const double stick = std::pow(1 - across / (friction * pressing), 1.0 / D);
  EXPECT_GT(stick, 0.3);
  EXPECT_LT(stick, 0.9);
  const auto [sticking, traction] = driver.visit(0, [&](const auto& run) {
    double sticks = 0, slips = infinity, nearest = infinity, middle = 0;  // radii of the last and the first one
    for (const auto& node : run.results().contact.nodes) {
      if (!node.contact) continue;
      const auto& x = run.nodes().at(node.vertex);
      const double away = D == 2 ? std::abs(x[0]) : std::hypot(x[0], x[1]);
      if (node.sticks) sticks = std::max(sticks, away);
      if (!node.sticks) slips = std::min(slips, away);
      if (away < nearest) nearest = away, middle = length({node.traction.begin(), node.traction.end()});
    }
    return std::pair((sticks + slips) / (2 * contact.radius), middle);
  });
  const double expected = friction * contact.max_pressure * (1 - stick);
  show("c / a {:.4g}, by theory {:.4g}; traction {:.4g}, by theory {:.4g}; {} iterations\n", sticking, stick, traction,
       expected, report.last().summary.iterations);
  EXPECT_NEAR(sticking, stick, tolerance);
  EXPECT_NEAR(traction, expected, 0.5 * tolerance * friction * contact.max_pressure);
}

TEST(Cylinders, SlipPartiallyAsCattaneoAndMindlinSay) { expect_partial_slip<2>(cylinders(4, "body"), 0.02); }

TEST(Cylinders, SlipPartiallyWithTheOtherOneAsTheSlave) { expect_partial_slip<2>(cylinders(4, "other"), 0.02); }

TEST(Spheres, SlipPartiallyAsCattaneoAndMindlinSay) { expect_partial_slip<3>(spheres(3), 0.03); }

}  // namespace
}  // namespace signorini::test
