#include <algorithm>
#include <numbers>

#include "tests/bodies/scenes.hpp"

// Two elastic cylinders, alike, pressed on each other and then pushed sideways: the case in which the theory of C.
// Cattaneo (1938) and R. D. Mindlin (1949) is exact, for normal and tangential displacements do not depend on each
// other's tractions.

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

// Johnson, Contact Mechanics, 1985, ch. 7.2: with the force Q across the force P it sticks within c = a sqrt(1 - Q /
// (mu P)), and the traction in the middle is mu p0 (1 - c / a).
void expect_partial_slip(const char* slave) {
  constexpr double friction = 0.4;
  Driver driver(scene_of(cylinders(4, slave)));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  const ContactReport& contact = report.last().contact[0];
  expect_opposite(contact);
  const double across = length(contact.tangential_force), pressing = length(contact.normal_force);
  const double stick = std::sqrt(1 - across / (friction * pressing));
  EXPECT_GT(stick, 0.3);
  EXPECT_LT(stick, 0.9);
  const auto [sticking, traction] = driver.visit(0, [&](const auto& run) {
    double sticks = 0, all = 0, nearest = infinity, middle = 0;
    for (const auto& node : run.results().contact.nodes) {
      if (!node.contact) continue;
      all += node.area;
      if (node.sticks) sticks += node.area;
      const double x = std::abs(run.nodes().at(node.vertex)[0]);
      if (x < nearest) nearest = x, middle = std::hypot(node.traction[0], node.traction[1]);
    }
    return std::pair(sticks / all, middle);
  });
  show("c / a {:.4g}, by theory {:.4g}; traction {:.4g}, by theory {:.4g}; {} iterations\n", sticking, stick, traction,
       friction * contact.max_pressure * (1 - stick), report.last().summary.iterations);
  EXPECT_NEAR(sticking, stick, 0.02);
  EXPECT_NEAR(traction, friction * contact.max_pressure * (1 - stick), 0.01 * friction * contact.max_pressure);
}

TEST(Cylinders, SlipPartiallyAsCattaneoAndMindlinSay) { expect_partial_slip("body"); }

TEST(Cylinders, SlipPartiallyWithTheOtherOneAsTheSlave) { expect_partial_slip("other"); }

}  // namespace
}  // namespace signorini::test
