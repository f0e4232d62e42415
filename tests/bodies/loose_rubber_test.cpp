#include "tests/bodies/scenes.hpp"

namespace signorini::test {
namespace {

using tables::block;

std::string ring(int number, double low, const std::string& cells, double young, double poisson) {
  return block(fmt::format("b{}", number), fmt::format("[1, {}]", low), fmt::format("[2, {}]", low + 0.5), cells,
               material(young, poisson, 2) + "plane = \"axisymmetric\"\n");
}

// Rings of rubber, the lowest pressed up by the floor that it overlaps at the start, the highest lifted off: none is
// pressed by anything. What is left of their pressures is rounding, and changes by all that it is.
TEST(LooseRubber, IsMovedAndNotDeformed) {
  Driver driver(scene_of(ring(0, -0.006, "[1, 3]", 0.04, 0.37) + ring(1, 0.494, "[3, 1]", 5, 0.499) +
                         ring(2, 1.001, "[2, 2]", 0.5, 0.49) +
                         "[[obstacle]]\ntype = \"contact\"\nbody = \"b0\"\non = \"bottom\"\nshape = \"plane\"\n"
                         "point = [0, 0]\nnormal = [0, 1]\n" +
                         pair("b0", "top", "b1", "bottom") + pair("b1", "top", "b2", "bottom") +
                         "[[fix]]\nbody = \"b2\"\non = \"top\"\nframe = \"normal\"\nvalue = [0.01, \"free\"]\n"
                         "[refine]\nuniform = 1\n[[probe]]\nname = \"top\"\nbody = \"b1\"\nat = [1.5, 0.994]\n"));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  for (const ContactReport& contact : report.last().contact) EXPECT_LE(length(contact.force), 1e-12);
  EXPECT_NEAR(report.last().probes[0].value[1], 0.006, 1e-10);
}

}  // namespace
}  // namespace signorini::test
