#include "tests/estimators/generated.hpp"

namespace signorini::test {
namespace {

std::string material(Chance& chance, int order, const std::string& poisson) {
  return fmt::format("order = {}\npressure = 'none'\nyoung = {}\npoisson = {}\n", order, chance.number(0.5, 2),
                     poisson);
}

std::string touching(const std::string& on, const std::string& other_on, const std::string& more = "") {
  return fmt::format("[[obstacle]]\ntype = 'elastic'\nbody = 'a'\non = '{}'\nother = 'b'\nother_on = '{}'\n{}", on,
                     other_on, more);
}

/// A block pressed on another one, whose meshes do not match; it may overhang, be off the other one at first, or be
/// meshed without structure.
std::string blocks(Chance& chance, int dimension, int order, const std::string& poisson) {
  const bool plane = dimension == 2;
  const auto vector = [&](const std::string& x, const std::string& z) {
    return plane ? "[" + x + ", " + z + "]" : "[" + x + ", 0, " + z + "]";
  };
  const std::string gap = chance.half() ? "0" : chance.number(0.002, 0.02);
  const std::string left = chance.number(-0.4, 0.3), right = chance.number(0.7, 1.4);
  const std::string of_a = material(chance, order, poisson), of_b = material(chance, order, poisson);
  std::string scene, bottom = "bottom", top = "top";
  if (plane && order == 1 && chance.half()) {
    scene = fmt::format(
        "[[body]]\nname = 'a'\nshape = 'polygon'\npoints = [[{0}, {2}], [{1}, {2}], [{1}, 1], [{0}, 1]]\nsize = '{3} "
        "+ 0.3 * sqrt(x^2 + y^2)'\n{4}",
        left, right, gap, chance.number(0.15, 0.3), of_a);
    bottom = "edge0", top = "edge2";
  } else {
    const std::string to = plane ? "[" + right + ", 1]" : "[" + right + ", 0.9, 1]";
    scene = tables::block("a", plane ? "[" + left + ", " + gap + "]" : "[" + left + ", 0.1, " + gap + "]", to,
                          chance.cells(dimension, plane ? 5 : 3), of_a);
  }
  scene += tables::block("b", plane ? "[0, -1]" : "[0, 0, -1]", plane ? "[1, 0]" : "[1, 1, 0]",
                         chance.cells(dimension, plane ? 5 : 3), of_b) +
           tables::fix("a", top, vector(chance.number(-0.01, 0.01), "-" + chance.number(0.03, 0.05))) +
           tables::fix("b", "bottom", vector("0", "0"));
  if (chance.half()) scene += tables::load("b", vector(chance.number(-0.02, 0.02), chance.number(-0.02, 0.02)));
  return scene + touching(bottom, "top", "slave = '" + chance.pick({"auto", "body", "other"}) + "'\n");
}

TEST(TwoBodies, HaveTheErrorWithinTheBounds) {
  const std::string why =
      "pressures between bodies whose meshes do not match are bounded by a computed constant, which is not proven";
  std::vector<double> plane, quadratic, space, nearly_incompressible;
  for (unsigned seed = 0; seed < 30; ++seed) {
    Chance chance(seed);
    plane.push_back(checked(blocks(chance, 2, 1, chance.number(0, 0.45)), 1 + chance.half(), 2, why));
    quadratic.push_back(checked(blocks(chance, 2, 2, chance.number(0, 0.45)), 1, 2, why));
    nearly_incompressible.push_back(checked(blocks(chance, 2, 1, chance.pick({"0.49", "0.499"})), 1, 2, why));
    space.push_back(checked(blocks(chance, 3, 1 + static_cast<int>(seed % 4 == 3), chance.number(0, 0.45)), 0, 1, why));
  }
  print_ratios("two bodies, linear", plane);
  print_ratios("two bodies, quadratic", quadratic);
  print_ratios("two bodies, nearly incompressible", nearly_incompressible);
  print_ratios("two bodies in space", space);
  EXPECT_LE(quantile(plane, 0.5), 8);
  EXPECT_LE(quantile(space, 0.5), 80);  // the coarsest meshes, where one body ends within a face of the other
}

}  // namespace
}  // namespace signorini::test
