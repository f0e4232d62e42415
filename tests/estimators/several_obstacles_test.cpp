#include "tests/estimators/generated.hpp"

namespace signorini::test {
namespace {

std::string obstacle(const std::string& on, const std::string& point, const std::string& normal,
                     const std::string& type = "type = 'contact'\n") {
  return fmt::format("[[obstacle]]\n{}body = 'b'\non = '{}'\nshape = 'plane'\npoint = {}\nnormal = {}\n", type, on,
                     point, normal);
}

/// Displacements alone, whose energy is that of the report.
std::string material(Chance& chance, int order, const std::string& poisson) {
  return fmt::format("order = {}\npressure = 'none'\nyoung = {}\npoisson = {}\n", order, chance.number(0.5, 2),
                     poisson);
}

/// A block that is pushed down onto a floor and aside against a wall; each has faces of its own, but for the corner.
std::string in_a_corner(Chance& chance, int dimension, int order, const std::string& poisson) {
  const std::string keys = material(chance, order, poisson);
  if (dimension == 2) {
    std::string body, bottom = "bottom", right = "right", top = "top";
    if (order == 1 && chance.half()) {  // a graded mesh without structure
      body = fmt::format(
          "[[body]]\nname = 'b'\nshape = 'polygon'\npoints = [[0, 0], [1, 0], [1, 1], [0, 1]]\nsize = '{} + 0.3 * "
          "sqrt((x - 1)^2 + y^2)'\n{}",
          chance.number(0.12, 0.3), keys);
      bottom = "edge0", right = "edge1", top = "edge2";
    } else {
      body = tables::block("b", "[0, 0]", "[1, " + chance.number(0.7, 1.4) + "]", chance.cells(2, 4), keys);
    }
    body += tables::fix("b", top, "[0, -" + chance.number(0.02, 0.04) + "]") +
            tables::load("b", "[" + chance.number(0, 0.05) + ", -" + chance.number(0, 0.02) + "]");
    return body + obstacle(bottom, "[0, -" + chance.number(0, 0.015) + "]", "[0, 1]") +
           obstacle(right, "[" + chance.number(1, 1.004) + ", 0]", "[-1, " + chance.pick({"0", "0.05"}) + "]");
  }
  return tables::block("b", "[0, 0, 0]", "[1, 1, " + chance.number(0.7, 1.4) + "]", chance.cells(3, 2), keys) +
         tables::fix("b", "top", "[0, 0, -" + chance.number(0.02, 0.04) + "]") +
         tables::load("b", "[" + chance.number(0, 0.05) + ", 0, 0]") +
         obstacle("bottom", "[0, 0, -" + chance.number(0, 0.01) + "]", "[0, 0, 1]") +
         obstacle("right", "[" + chance.number(1, 1.003) + ", 0, 0]", "[-1, 0, 0]");
}

/// A block between the sides of a valley: its faces see two planes of different directions.
std::string in_a_valley(Chance& chance, int dimension, int order, const std::string& poisson) {
  const bool plane = dimension == 2;
  const std::string low = "-" + chance.number(0, 0.01), flat = chance.number(0.05, 0.4);
  const auto vector = [&](const std::string& x, const std::string& z) {
    return plane ? "[" + x + ", " + z + "]" : "[" + x + ", 0, " + z + "]";
  };
  return tables::block("b", plane ? "[-0.5, 0]" : "[-0.5, 0, 0]", plane ? "[0.5, 1]" : "[0.5, 1, 1]",
                       chance.cells(dimension, plane ? 4 : 2), material(chance, order, poisson)) +
         tables::fix("b", "top", vector(chance.number(-0.01, 0.01), "-" + chance.number(0.03, 0.06))) +
         obstacle("bottom", vector("0", low), vector(flat, "1")) +
         obstacle("bottom", vector("0", low), vector("-" + flat, "1"));
}

/// One or two floors, and a ceiling in the body or at a part of its boundary, where a flux pushes towards it.
std::string membrane(Chance& chance, int order) {
  std::string scene =
      tables::block("b", "[-1, -1]", "[1, " + chance.number(0.6, 1.4) + "]", chance.cells(2, 4),
                    fmt::format("order = {}\nequation = 'diffusion'\ndiffusion = {}\n", order, chance.number(0.5, 2))) +
      tables::fix("b", chance.pick({"top", "bottom"}), "0") + tables::load("b", "-" + chance.number(4, 9)) +
      tables::load("b", chance.number(4, 12), "right") + tables::floor("b", "-" + chance.number(0.2, 0.6));
  if (chance.half()) scene += tables::floor("b", "'-" + chance.number(0.3, 0.5) + " - 0.2 * x'");
  scene += "[[obstacle]]\ntype = 'scalar'\nbody = 'b'\n";
  if (chance.half()) scene += "on = 'right'\n";
  return scene + "upper = " + chance.number(0.1, 0.3) + "\n";
}

/// Friction with a given bound: between a floor and a ceiling that a block swells against; or at a floor, not at a
/// wall.
std::string with_friction(Chance& chance, int order) {
  const auto tresca = [&] { return "type = 'tresca'\nbound = " + chance.number(0.001, 0.004) + "\n"; };
  const std::string block =
      tables::block("b", "[0, 0]", "[1, 1]", chance.cells(2, 4), material(chance, order, chance.number(0.1, 0.45)));
  if (chance.half())
    return block + tables::fix("b", "left", "[0, 0]") +
           tables::load("b", "[-" + chance.number(0.1, 0.2) + ", 0]", "right") +
           obstacle("bottom", "[0, 0]", "[0, 1]", tresca()) + obstacle("top", "[0, 1.002]", "[0, -1]", tresca());
  return block + tables::fix("b", "top", "[" + chance.number(0.01, 0.02) + ", -" + chance.number(0.01, 0.02) + "]") +
         obstacle("bottom", "[0, 0]", "[0, 1]", tresca()) + obstacle("right", "[1.02, 0]", "[-1, 0]");
}

TEST(SeveralObstacles, HaveTheErrorWithinTheBounds) {
  std::vector<double> corner, valley, nearly_incompressible, scalar, friction;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Chance chance(seed);
    const int order = 1 + static_cast<int>(seed % 4 == 3), dimension = seed < 32 ? 2 : 3;
    const int refinements = (dimension == 2 ? 2 : 1) - (order - 1);
    corner.push_back(
        checked(in_a_corner(chance, dimension, order, chance.number(0, 0.45)), refinements, dimension == 2 ? 2 : 1));
    valley.push_back(
        checked(in_a_valley(chance, dimension, order, chance.number(0, 0.45)), refinements, dimension == 2 ? 2 : 1));
    scalar.push_back(checked(membrane(chance, 1 + static_cast<int>(seed % 4 == 3)), 2, 1));
    if (seed >= 32) continue;
    friction.push_back(checked(with_friction(chance, order), refinements, 2));
    nearly_incompressible.push_back(checked(in_a_corner(chance, 2, order, chance.pick({"0.49", "0.499"})), 2, 1));
  }
  print_ratios("corner", corner);
  print_ratios("valley", valley);
  print_ratios("corner, nearly incompressible", nearly_incompressible);
  print_ratios("scalar", scalar);
  print_ratios("friction", friction);
  EXPECT_LE(quantile(corner, 0.5), 3);
  EXPECT_LE(quantile(valley, 0.5), 3);
  EXPECT_LE(quantile(scalar, 0.5), 3);
}

}  // namespace
}  // namespace signorini::test
