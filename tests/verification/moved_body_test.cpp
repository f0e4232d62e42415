// Stiff bodies that prescribed values, obstacles and loads move far beside what they deform: their forces are small
// beside stiffness times way.
#include "core/fem/elements/element.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

// A prescribed way down pushes it aside: it touches the round where that balances the load.
TEST(MovedBody, IsPushedAsideByARoundHoweverStiffItIs) {
  const Point<2> center = {0.4, -4.1};
  for (const auto& [young, aside, down] : {std::array{2.1e5, -1e-6, -7.7e-5}, std::array{1e7, -1e-4, -0.01}}) {
    const SceneText scene{
        .body = fmt::format(
            "shape = \"half_disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.5\norder = 1\nyoung = {}\npoisson = 0.3",
            young),
        .fixes = {"on = \"flat\"\nvalue = [\"free\", -0.01]"},
        .loads = {fmt::format("value = [{}, {}]", aside, down)},
        .obstacle = "type = \"contact\"\non = \"boundary\"\nshape = \"sphere\"\ncenter = [0.4, -4.1]\nradius = 3",
        .refinements = 1};
    const auto r = run<2, 2>(scene);
    double area = 0;
    for (const auto& e : r.mesh().elements) area += linear_element(r.mesh(), e).measure;
    const auto& force = r.contact().force;
    EXPECT_NEAR(force[0], -aside * area, 1e-3 * std::abs(aside) * area) << young;
    for (const ContactNode<2>& node : r.results.contact.nodes) {
      if (!node.contact) continue;
      const Point<2> at = r.mesh().points[node.vertex];
      const double across = (at[0] - center[0]) * node.force[1] - (at[1] - center[1]) * node.force[0];
      EXPECT_LT(std::abs(across), 1e-6 * norm<2>(force)) << young;
    }
    EXPECT_LE(r.summary().iterations, 12) << young;
  }
}

// Three forces, which the balance of forces and moments determines. What is left of the way by rounding, or left out of
// it, would bend the rod.
TEST(MovedBody, StandsOnTwoRoundsHoweverFarItHasCome) {
  const auto round = [](const char* center, const char* radius) {
    return fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = {}\nradius = {}\n", center,
                       radius);
  };
  const SceneText scene{.body =
                            "shape = \"rectangle\"\nfrom = [-0.05, -1]\nto = [0.05, 1]\ncells = [1, 60]\n"
                            "order = 1\nyoung = 1e6\npoisson = 0.3",
                        .loads = {"value = [0, -0.003]"},
                        .obstacle = round("[-0.015098, -2.3173]", "1.3273") + "[[obstacle]]\nbody = \"b\"\n" +
                                    round("[0.01066, -2.78558]", "1.98558")};
  const auto r = run<2, 2>(scene);
  const double weight = 0.003 * 0.2;
  Point<2> force = {0, -weight};
  double moment = 0;
  for (const ContactNode<2>& node : r.results.contact.nodes) {
    const Point<2>& x = r.mesh().points[node.vertex];
    for (int i = 0; i < 2; ++i) force[i] += node.force[i];
    moment += x[0] * node.force[1] - x[1] * node.force[0];
  }
  const double claimed = r.summary().algebraic_error;
  EXPECT_LT(claimed, 1e-2);
  EXPECT_LT(norm<2>(force), claimed * weight);
  EXPECT_LT(std::abs(moment), claimed * weight);
}

// Nothing but rounding moves along the plane.
TEST(MovedBody, IsCompressedWithoutMovingAside) {
  for (const double young : {1e3, 9e7, 2.1e11}) {
    const SceneText scene{
        .body = fmt::format(
            "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [1, 1]\norder = 1\nyoung = {}\npoisson = 0",
            young),
        .fixes = {"on = \"top\"\nvalue = [\"free\", -0.01]"},
        .obstacle = "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]"};
    const auto r = run<2, 2>(scene);
    EXPECT_EQ(r.summary().outcome, Outcome::converged) << r.summary().reason;
    EXPECT_NEAR(r.contact().force[1], 0.01 * young, 1e-10 * young);
    EXPECT_LE(r.summary().iterations, 4);
  }
}

// A bar that touches nothing.
TEST(MovedBody, IsMovedAsAWholeAtOnce) {
  for (const int refinements : {0, 2}) {
    const SceneText scene{
        .body =
            "shape = \"rectangle\"\nfrom = [-0.05, -1]\nto = [0.05, 1]\ncells = [4, 60]\n"
            "order = 1\nyoung = 1e9\npoisson = 0.45",
        .fixes = {"on = \"top\"\nvalue = [\"free\", -0.01]"},
        .obstacle = "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, -1.3]\nnormal = [0, 1]",
        .refinements = refinements};
    const auto r = run<2, 2>(scene);
    EXPECT_EQ(r.summary().outcome, Outcome::converged) << r.summary().reason;
    EXPECT_LE(r.summary().iterations, 2);
    for (Index p = 0; p < r.mesh().vertices(); ++p) EXPECT_NEAR(r.u()[2 * p + 1], -0.01, 1e-16);
  }
}

}  // namespace
}  // namespace signorini::test
