// Energies of obstacle problems whose discrete minima are published.
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

/// A membrane held along the boundary of a rectangle.
SceneText membrane(const std::string& body, const std::string& source, const std::string& bound) {
  return {.body = "shape = \"rectangle\"\nfrom = [0, 0]\nequation = \"diffusion\"\n" + body,
          .fixes = {"on = \"boundary\"\nvalue = [0]"},
          .loads = {fmt::format("value = ['{}']", source)},
          .obstacle = "type = \"scalar\"\n" + bound};
}

SceneText square_torsion(int cells) {
  SceneText scene = membrane(fmt::format("to = [1, 1]\ncells = [{0}, {0}]", cells), "5",
                             "upper = 'min(min(x, 1 - x), min(y, 1 - y))'");
  scene.refinements = 3;
  return scene;
}

TEST(Minima, SquareTorsion) {
  EXPECT_NEAR((run<2, 1>(square_torsion(8)).summary().energy), -0.41823633, 5e-9);
  EXPECT_NEAR((run<2, 1>(square_torsion(16)).summary().energy), -0.41843021, 5e-9);
  EXPECT_NEAR((run<2, 1>(square_torsion(32)).summary().energy), -0.41847872, 5e-9);
}

/// MINPACK-2's journal bearing: min int w |grad v|^2 / 2 - epsilon sin(x) v over v >= 0, w = (1 + epsilon cos x)^3,
/// epsilon = 0.1, 8 x 12 interior points. It takes the mean of w at the vertices of a triangle and sums the load over
/// the vertices. With linear interpolation f |-> If along the cells of width h, the first is Iw at the centroid, and
/// the second is what exact integration makes of I sin times 3 / (2 + cos h).
TEST(Minima, JournalBearing) {
  const double h = 2 * pi / 9;
  const auto interpolated = [&](const char* f) {
    const std::string cell = fmt::format("floor(x/{:.17g})", h), part = fmt::format("(x/{:.17g} - {})", h, cell);
    const auto at = [&](const std::string& x) {
      return fmt::format(fmt::runtime(f), fmt::format("({:.17g}*{})", h, x));
    };
    return fmt::format("((1 - {0})*{1} + {0}*{2})", part, at(cell), at("(" + cell + " + 1)"));
  };
  const SceneText scene =
      membrane(fmt::format("to = [{:.17g}, 20]\ncells = [9, 13]\ndiffusion = '{}'", 2 * pi,
                           interpolated("(1 + 0.1*cos({0}))^3")),
               fmt::format("0.1*{}*3/(2 + cos({:.17g}))", interpolated("sin({0})"), h), "lower = 0");
  EXPECT_NEAR((run<2, 1>(scene).summary().energy), -0.183437, 5e-7);
}

}  // namespace
}  // namespace signorini::test
