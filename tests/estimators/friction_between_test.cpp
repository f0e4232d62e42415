#include <gmock/gmock.h>

#include "driver/components.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "driver/scene/touching_bodies.hpp"
#include "estimators/certificate/certificate.hpp"
#include "tests/core/fem/support.hpp"
#include "tests/estimators/generated.hpp"

namespace signorini::test {
namespace {

std::string touching(const std::string& keys) {
  return "[[obstacle]]\nbody = 'a'\non = 'bottom'\nother = 'b'\nother_on = 'top'\nslave = 'body'\n" + keys;
}
std::string tresca(const std::string& bound) { return touching("type = 'elastic_tresca'\nbound = " + bound + "\n"); }

/// Two blocks, one on the other.
std::string blocks(int dimension, const std::string& cells_a, const std::string& cells_b, const std::string& keys) {
  const bool plane = dimension == 2;
  return tables::block("a", plane ? "[0, 0]" : "[0, 0, 0]", plane ? "[1, 1]" : "[1, 1, 1]", cells_a, keys) +
         tables::block("b", plane ? "[0, -1]" : "[0, 0, -1]", plane ? "[1, 0]" : "[1, 1, 0]", cells_b, keys);
}

/// What the certificate says of any displacement of a scene's bodies.
Estimate of_displacement(const std::string& scene, const std::function<Point<2>(const Point<2>&, bool upper)>& u) {
  Registry registry = all_components();
  Driver driver(parse_scene(scene, "test.toml", "."));
  load_plugins(driver.scene(), registry);
  driver.solve();
  const Scene merged = with_touching_bodies(driver.scene());
  Estimate out;
  driver.visit(0, [&]<int D, int B>(const BodyRun<D, B>& run) {
    if constexpr (D == 2 && B == 2) {
      const Model<2> model = build_model<2>(merged, 2, registry, 1.0);
      std::vector<double> values(run.numbers());
      for (Index e = 0; e < static_cast<Index>(run.mesh().elements.size()); ++e)
        for (const Index p : run.mesh().elements[e]) {
          const Point<2> v = u(run.mesh().points[p], centroid<2>(run.mesh(), run.mesh().elements[e])[1] > 0);
          for (int i = 0; i < 2; ++i) values[Offset{p} * 2 + i] = v[i];
        }
      EstimateOptions<2> options;
      options.solve = [](const DiscreteProblem<2>& problem, std::vector<double>& x) {
        x = signorini::testing::solve_dense(problem);
        return true;
      };
      out = certificate<2, 2>(run.nodes(), model, values, options);
    }
  });
  return out;
}

const std::string unit = "order = 1\nyoung = 1\npoisson = 0\n";

/// Both blocks bear the pressure p evenly, though they are still apart by 2 p - d: their stress is in equilibrium, and
/// all of the bound is what the pressure does on this way. The energy is p^2, that of the solution d^2 / 4.
TEST(TwoBodies, PayForPressureAcrossAGap) {
  const double d = 0.1, p = 0.051;
  const std::string sides =
      "[[fix]]\nbody = 'a'\non = 'left'\nvalue = [0, 'free']\n"
      "[[fix]]\nbody = 'b'\non = 'left'\nvalue = [0, 'free']\n";
  for (const std::string cells : {"[3, 2]", "[2, 3]"}) {
    const Estimate found =
        of_displacement(blocks(2, "[3, 2]", cells, unit) + tables::fix("a", "top", "[0, -0.1]") +
                            tables::fix("b", "bottom", "[0, 0]") + sides + touching("type = 'elastic'\n"),
                        [&](const Point<2>& x, bool upper) -> Point<2> {
                          return {0, upper ? -d + p * (1 - x[1]) : -p * (x[1] + 1)};
                        });
    EXPECT_TRUE(found.guaranteed);
    EXPECT_NEAR(found.total, p * p, 1e-15);
    EXPECT_NEAR(found.parts.contact, p * (2 * p - d), 1e-12);
    EXPECT_NEAR(found.upper, p * (2 * p - d), 1e-6);
    EXPECT_GE(found.upper, p * p - d * d / 4);
  }
}

/// Sheared by t less than the bound s, and slipping by e - 4 t: the energy is 2 t^2 + s (e - 4 t), the least for t = s.
TEST(TwoBodies, PayForFrictionThatIsNotUsed) {
  const double s = 0.01, e = 0.1;
  const std::string sides =
      "[[fix]]\nbody = 'a'\non = 'left'\nvalue = ['free', 0]\n"
      "[[fix]]\nbody = 'a'\non = 'right'\nvalue = ['free', 0]\n"
      "[[fix]]\nbody = 'b'\non = 'left'\nvalue = ['free', 0]\n"
      "[[fix]]\nbody = 'b'\non = 'right'\nvalue = ['free', 0]\n";
  for (const std::string cells : {"[3, 2]", "[4, 4]"})
    for (const double t : {0.009, 0.01, 0.0105}) {
      const Estimate found = of_displacement(blocks(2, cells, cells, unit) + tables::fix("a", "top", "[0.1, 0]") +
                                                 tables::fix("b", "bottom", "[0, 0]") + sides + tresca("0.01"),
                                             [&](const Point<2>& x, bool upper) -> Point<2> {
                                               return {upper ? e - 2 * t * (1 - x[1]) : 2 * t * (x[1] + 1), 0};
                                             });
      const double gap = 2 * (t - s) * (t - s);
      EXPECT_TRUE(found.guaranteed) << ::testing::PrintToString(found.reasons);
      EXPECT_NEAR(found.total, 2 * t * t + s * (e - 4 * t), 1e-15);
      EXPECT_GE(found.upper, gap - 1e-15);
      EXPECT_LE(found.upper, 3 * gap + 1e-15) << "the traction is the one that slip asks for";
      EXPECT_LE(found.lower, gap + 1e-15);
      EXPECT_LT(found.imbalance, 1e-12);
    }
}

/// Upper over lower bound. Where the energy of the true solution is, two meshes must agree.
double agreeing(const std::string& scene, int refinements, int finer, const std::string& only_reason = "") {
  const Estimate found = estimated(scene, refinements, "1e-9").estimate,
                 fine = estimated(scene, refinements + finer, "1e-9").estimate;
  for (const std::string& reason : found.reasons) EXPECT_EQ(reason, only_reason) << scene;
  EXPECT_EQ(found.guaranteed, found.reasons.empty()) << scene;
  EXPECT_LT(found.imbalance, 1e-12) << scene;
  EXPECT_LE(found.total - found.upper, fine.total - fine.lower) << scene;
  EXPECT_GE(found.total - found.lower, fine.total - fine.upper) << scene;
  return found.upper / found.lower;
}

/// Pressed and drawn: some of the interface slips, some sticks.
std::string drawn(Chance& chance, int dimension, int order, bool matching) {
  const bool plane = dimension == 2;
  const auto vector = [&](const std::string& x, const std::string& z) {
    return plane ? "[" + x + ", " + z + "]" : "[" + x + ", 0, " + z + "]";
  };
  const auto keys = [&] {
    return fmt::format("order = {}\npressure = 'none'\nyoung = {}\npoisson = {}\n", order, chance.number(0.5, 2),
                       chance.number(0, 0.45));
  };
  const std::string cells = chance.cells(dimension, plane ? 4 : 2);
  return blocks(dimension, cells, matching ? cells : chance.cells(dimension, plane ? 4 : 3), keys()) +
         tables::fix("a", "top", vector(chance.number(-0.03, 0.03), "-" + chance.number(0.02, 0.04))) +
         tables::fix("b", "bottom", vector("0", "0")) + tresca(chance.number(0.001, 0.01));
}

TEST(FrictionBetween, HasTheErrorWithinTheBounds) {
  const std::string why =
      "pressures between bodies whose meshes do not match are bounded by a computed constant, which is not proven";
  std::vector<double> plane, quadratic, space, not_matching;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Chance chance(seed);
    plane.push_back(agreeing(drawn(chance, 2, 1, true), 1 + chance.half(), 2));
    quadratic.push_back(agreeing(drawn(chance, 2, 2, true), 1, 1));
    not_matching.push_back(agreeing(drawn(chance, 2, 1 + chance.half(), false), 1, 2, why));
    if (seed < 8) space.push_back(agreeing(drawn(chance, 3, 1 + static_cast<int>(seed % 4 == 3), true), 0, 1));
    if (seed < 4) agreeing(drawn(chance, 3, 1, false), 0, 1, why);
  }
  print_ratios("friction between bodies, linear", plane);
  print_ratios("friction between bodies, quadratic", quadratic);
  print_ratios("friction between bodies, not matching", not_matching);
  print_ratios("friction between bodies in space", space);
  EXPECT_LE(quantile(plane, 0.5), 6);
}

/// A block on one that hardly yields is as on a rigid plane.
TEST(FrictionBetween, IsThatOnARigidPlaneWhereTheOtherBodyIsHard) {
  for (const int order : {1, 2}) {
    const auto keys = [&](const char* young) {
      return fmt::format("order = {}\nyoung = {}\npoisson = 0.3\n", order, young);
    };
    const std::string block =
        tables::block("a", "[0, 0]", "[1, 1]", "[4, 4]", keys("1")) + tables::fix("a", "top", "[0.02, -0.03]");
    const Estimate pair = estimated(block + tables::block("b", "[0, -1]", "[1, 0]", "[4, 4]", keys("1e4")) +
                                        tables::fix("b", "bottom", "[0, 0]") + tresca("0.004"),
                                    1)
                              .estimate,
                   rigid = estimated(block +
                                         "[[obstacle]]\ntype = 'tresca'\nbody = 'a'\non = 'bottom'\nshape = 'plane'\n"
                                         "point = [0, 0]\nnormal = [0, 1]\nbound = 0.004\n",
                                     1)
                               .estimate;
    EXPECT_TRUE(pair.guaranteed && rigid.guaranteed);
    EXPECT_GT(pair.parts.friction, 0);
    const double yields = 1e-3 * rigid.total;
    EXPECT_NEAR(pair.total, rigid.total, yields);
    EXPECT_NEAR(pair.parts.friction, rigid.parts.friction, 0.05 * rigid.parts.friction);
    EXPECT_LE(pair.total - pair.upper, rigid.total - rigid.lower + yields);
    EXPECT_GE(pair.total - pair.lower, rigid.total - rigid.upper - yields);
  }
}

TEST(FrictionBetween, SaysThatCoulombsBoundIsTheOneFound) {
  const Estimate found =
      estimated(blocks(2, "[3, 3]", "[3, 3]", unit) + tables::fix("a", "top", "[0.02, -0.03]") +
                    tables::fix("b", "bottom", "[0, 0]") + touching("type = 'elastic_coulomb'\nfriction = 0.2\n"),
                1)
          .estimate;
  EXPECT_FALSE(found.guaranteed);
  ASSERT_EQ(found.reasons.size(), 1u);
  EXPECT_THAT(found.reasons[0], ::testing::HasSubstr("follows the pressure"));
  EXPECT_GT(found.parts.friction, 0);
  EXPECT_GT(found.lower, 0);
  EXPECT_LT(found.relative_upper(), 1);
}

}  // namespace
}  // namespace signorini::test
