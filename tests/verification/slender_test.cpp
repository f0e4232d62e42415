// Bodies of which rounding leaves little, and bodies that move without deforming.
#include <algorithm>

#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

// A column that is lowered by 20 onto a plane 10 below, with a gap of 10: a bar, but for its two ends that cannot
// widen. Swaying costs it less energy than rounding in the matrix.
TEST(Slender, ColumnsThatCanSwayStandStraight) {
  const SceneText scene{.body =
                            "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1000]\ncells = [16, 16]\n"
                            "order = 1\nyoung = 1\npoisson = 0.3",
                        .fixes = {"on = \"top\"\nvalue = [0, -20]"},
                        .obstacle =
                            "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, -10]\n"
                            "normal = [0, 1]",
                        .refinements = 2};
  const auto r = run<2, 2>(scene);
  const double bar = 10.0 / 1000 / (1 - 0.3 * 0.3);  // plane strain: force over width
  EXPECT_NEAR(r.contact().force[1], bar, 2e-3 * bar);
  EXPECT_EQ(r.contact().nodes, 65);
  double aside = 0;
  for (std::size_t i = 0; i < r.u().size(); i += 2) aside = std::max(aside, std::abs(r.u()[i]));
  EXPECT_LT(aside, 0.1);
}

// Without contact and without an error that cycles could mend: they end, and say that rounding limits the answer.
TEST(Slender, CantileversEndWhereRoundingLetsThem) {
  const double length = 1000, load = 1e-13;
  const SceneText scene{.body = fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [{}, 1]\ncells = [2000, 4]\n"
                                            "order = 1\nyoung = 1\npoisson = 0",
                                            length),
                        .fixes = {"on = \"left\"\nvalue = [0, 0]"},
                        .loads = {fmt::format("on = \"top\"\nvalue = [0, {}]", -load)},
                        .obstacle =
                            "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, -0.5]\n"
                            "normal = [0, 1]"};
  const auto r = run<2, 2>(scene);
  EXPECT_EQ(r.summary().outcome, Outcome::rounding) << r.summary().reason;
  EXPECT_GT(r.summary().rounding_error, 1e-8);
  double lowest = 0;
  for (std::size_t i = 1; i < r.u().size(); i += 2) lowest = std::min(lowest, r.u()[i]);
  const double beam = 12 * load * std::pow(length, 4) / 8;
  EXPECT_LT(-lowest, beam);        // linear elements are too stiff
  EXPECT_GT(-lowest, 0.5 * beam);  // but not by that much
}

// In another unit of length each entry of the matrix is rounded otherwise: how far answers in units of length are apart
// is what rounding does to them.
TEST(Slender, WhatUnitsChangeIsClaimed) {
  const double length = 300;
  std::vector<double> tips;
  double claimed = 0;
  for (const double unit : {1.0, 1.0 / 3, 0.7, 1.0 / 7, 3.3, 0.123}) {
    const SceneText scene{
        .body = fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [{:.17g}, {:.17g}]\ncells = [300, 1]\n"
                            "order = 1\nyoung = 1\npoisson = 0.3",
                            length * unit, unit),
        .fixes = {"on = \"left\"\nvalue = [0, 0]"},
        .loads = {fmt::format("value = [0, {:.17g}]", -1e-3 / unit / std::pow(length, 3))},
        .obstacle = fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, {}]\n"
                                "normal = [0, 1]",
                                -1000 * unit),
        .refinements = 1};
    const auto r = run<2, 2>(scene);
    double lowest = 0;
    for (std::size_t i = 1; i < r.u().size(); i += 2) lowest = std::min(lowest, r.u()[i] / unit);
    tips.push_back(lowest);
    claimed = std::max(claimed, r.summary().algebraic_error);
  }
  const auto [low, high] = std::ranges::minmax(tips);
  show("apart by {}, claimed {}\n", (low - high) / low, claimed);
  EXPECT_LT((low - high) / low, 3 * claimed);
  EXPECT_LT(claimed, 20 * (low - high) / low);
}

// A load that would bend the beam by its thickness presses its tip onto a plane half as far below. Of the prop's force
// by beam theory, 3/8 pL (1 - gap over free deflection), elements that are too stiff leave less.
TEST(Slender, CantileversRestOnTheirTipsInFewCycles) {
  constexpr double length = 1000;
  const double load = 1 / (1.5 * std::pow(length, 4)), prop = 3.0 / 8 * load * length * (1 - 0.5);
  for (const auto& [cells, refinements] : {std::pair{"[1000, 1]", 2}, std::pair{"[4000, 4]", 0}}) {
    const SceneText scene{.body = fmt::format("shape = \"rectangle\"\nfrom = [0, 0]\nto = [{}, 1]\ncells = {}\n"
                                              "order = 1\nyoung = 1\npoisson = 0",
                                              length, cells),
                          .fixes = {"on = \"left\"\nvalue = [0, 0]"},
                          .loads = {fmt::format("on = \"top\"\nvalue = [0, {}]", -load)},
                          .obstacle =
                              "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, -0.5]\n"
                              "normal = [0, 1]",
                          .refinements = refinements};
    const auto r = run<2, 2>(scene);
    EXPECT_EQ(r.summary().stages.size(), 1u) << cells;
    EXPECT_LE(r.summary().iterations, 30) << cells;
    EXPECT_GE(r.contact().nodes, 1) << cells;
    EXPECT_LT(r.contact().force[1], 1.01 * prop) << cells;
    EXPECT_GT(r.contact().force[1], 0.7 * prop) << cells;
  }
}

// Bounds of the coarse levels allow the tip parts of the way only, and a step without them is cut off at a few vertices
// of the tip. By beam theory, with the stiffness that the mesh has, the prop takes 3/8 pL (1 - gap over free
// deflection).
TEST(Slender, BeamsInSpaceComeToARoundWithTheirTips) {
  const double length = 300, gap = 0.5, pressure = 1e-5;
  SceneText scene{.body =
                      "shape = \"box\"\nfrom = [0, 0, 0]\nto = [300, 1, 1]\ncells = [150, 1, 1]\norder = 1\nyoung = "
                      "1e5\npoisson = 0.3",
                  .fixes = {"on = \"left\"\nvalue = [0, 0, 0]"},
                  .loads = {fmt::format("value = [0, 0, {}]", -pressure)},
                  .refinements = 2};
  const auto round = [](double below) {
    return fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = [299, 0.6, {}]\nradius = 300",
                       -300 - below);
  };
  scene.obstacle = round(1000);
  const auto free = run<3, 3>(scene);
  double deflection = 0;
  for (std::size_t i = 2; i < free.u().size(); i += 3) deflection = std::max(deflection, -free.u()[i]);
  ASSERT_GT(deflection, 1.1 * gap);
  scene.obstacle = round(gap);
  const auto r = run<3, 3>(scene);
  EXPECT_EQ(r.summary().stages.size(), 1u);
  EXPECT_LE(r.summary().iterations, 45);
  const double prop = 3.0 / 8 * pressure * length * (1 - gap / deflection);
  EXPECT_NEAR(r.contact().force[2], prop, 0.03 * prop);
}

// The plane lifts the body by 0.01: exactly, at once, and on every mesh.
TEST(Slender, BodiesThatOnlyMoveAreNotLimitedByRounding) {
  for (const int refinements : {0, 3, 5}) {
    const SceneText scene{.body =
                              "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [4, 4]\n"
                              "order = 1\nyoung = 1\npoisson = 0.3",
                          .obstacle =
                              "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0.01]\n"
                              "normal = [0, 1]",
                          .refinements = refinements};
    const auto r = run<2, 2>(scene);
    EXPECT_EQ(r.summary().outcome, Outcome::converged) << r.summary().reason;
    EXPECT_LE(r.summary().iterations, 4);
    for (std::size_t i = 1; i < r.u().size(); i += 2) EXPECT_NEAR(r.u()[i], 0.01, 1e-13);
  }
}

}  // namespace
}  // namespace signorini::test
