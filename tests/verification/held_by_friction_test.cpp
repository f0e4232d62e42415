// Bodies that nothing but friction holds: solved up to 99 % of what friction bears, refused from there on where it
// bears the loads no longer, which closed forms tell.
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <numbers>

#include "core/base/error.hpp"
#include "driver/driver.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

std::string block(const char* name, const std::vector<double>& low, const std::vector<double>& high,
                  const std::vector<int>& cells, double young) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nshape = \"{}\"\nfrom = [{}]\nto = [{}]\ncells = [{}]\norder = 1\nyoung = {}\npoisson = "
      "0.3\n",
      name, low.size() == 2 ? "rectangle" : "box", fmt::join(low, ", "), fmt::join(high, ", "), fmt::join(cells, ", "),
      young);
}

std::string load(const char* body, const std::string& value) {
  return fmt::format("[[load]]\nbody = \"{}\"\nvalue = [{}]\n", body, value);
}

std::string on_plane(std::size_t dimension, double friction) {
  return fmt::format(
      "[[obstacle]]\ntype = \"coulomb\"\nbody = \"a\"\non = \"bottom\"\nfriction = {:.17g}\nshape = \"plane\"\npoint = "
      "{}\nnormal = {}\n",
      friction, dimension == 2 ? "[0, 0]" : "[0, 0, 0]", dimension == 2 ? "[0, 1]" : "[0, 0, 1]");
}

std::string on_each_other(double friction) {
  return fmt::format(
      "[[obstacle]]\ntype = \"elastic_coulomb\"\nbody = \"b\"\non = \"bottom\"\nother = \"a\"\nother_on = \"top\"\n"
      "friction = {:.17g}\n",
      friction);
}

std::string refined(int times) { return fmt::format("[refine]\nuniform = {}\n", times); }

std::string refusal(const std::string& scene) {
  try {
    Driver driver(parse_scene(scene, "test.toml", "."));
    driver.solve();
    return driver.report().converged() ? "solved" : driver.report().reason();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::no_solution) << error.what();
    return error.what();
  }
}

/// A block on a plane, or a smaller one on it, too, under loads that push `part` times as hard as friction bears.
struct Stack {
  std::string scene;
  std::vector<std::vector<double>> force;  ///< of each obstacle

  Stack(Random& random, std::size_t D, bool two, double part) : force(two ? 2 : 1, std::vector<double>(D)) {
    const double friction = random.between(0.1, 0.9), angle = random.between(0, 2 * std::numbers::pi);
    const double height = random.between(0.3, 0.5), young = std::pow(10, random.between(0, 3));
    const double weight = young * std::pow(10, random.between(-4, -2.5)), push = part * friction * weight;
    const std::vector<double> loads = D == 2 ? std::vector<double>{angle < std::numbers::pi ? push : -push, -weight}
                                             : std::vector{push * std::cos(angle), push * std::sin(angle), -weight};
    const std::string value = fmt::format("{:.17g}", fmt::join(loads, ", "));
    std::vector<double> low(D), high(D, height), above(D, height), top(D);
    std::vector<int> cells(D, 2), finer(D, 2);
    for (std::size_t k = 0; k + 1 < D; ++k) {
      high[k] = random.between(1.5, 2.5);
      above[k] = high[k] * random.between(0.15, 0.25);
      top[k] = high[k] * random.between(0.7, 0.85);
      cells[k] = 3 + random.below(3);
      finer[k] = 3 + random.below(3);
    }
    top[D - 1] = height + random.between(0.15, 0.25);
    double upper = 1, lower = 1;
    for (std::size_t k = 0; k < D; ++k) lower *= high[k], upper *= top[k] - above[k];
    for (std::size_t k = 0; k < D; ++k) {
      force[0][k] = -loads[k] * (lower + (two ? upper : 0));
      if (two) force[1][k] = -loads[k] * upper;
    }
    scene = block("a", low, high, cells, young) + load("a", value) + on_plane(D, friction);
    if (two)
      scene += block("b", above, top, finer, young * std::pow(10, random.between(-1, 1))) + load("b", value) +
               on_each_other(friction);
    scene += refined(D == 2 ? 2 : 1);
  }
};

// Without a detour: all stages are kept. (They slid away in the first cycle, and Newton's method had to find them.)
void expect_held(std::size_t dimension, bool two, std::uint64_t seed) {
  Random random(seed);
  for (const double part : {0.5, 0.8, 0.95, 0.99}) {
    const Stack stack(random, dimension, two, part);
    SCOPED_TRACE(stack.scene);
    Driver driver(parse_scene(stack.scene, "test.toml", "."));
    const StepReport& step = driver.solve().last();
    EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
    EXPECT_LE(step.summary.iterations, 60);
    for (const Stage& stage : step.summary.stages) EXPECT_TRUE(stage.kept) << stage.method << ": " << stage.reason;
    for (std::size_t k = 0; k < stack.force.size(); ++k)
      for (std::size_t i = 0; i < dimension; ++i)
        EXPECT_NEAR(step.contact[k].force[i], stack.force[k][i], 1e-6 * std::abs(stack.force[k].back()));
  }
}

TEST(HeldByFriction, BlocksInThePlane) { expect_held(2, false, 1); }
TEST(HeldByFriction, StacksInThePlane) { expect_held(2, true, 2); }
TEST(HeldByFriction, BlocksInSpace) { expect_held(3, false, 3); }
TEST(HeldByFriction, StacksInSpace) { expect_held(3, true, 4); }

// One part in a million beyond what friction bears, on the finest mesh as on the coarsest.
TEST(HeldByFriction, NotBeyondTheCriticalCoefficient) {
  Random random(5);
  for (const std::size_t dimension : {2, 3})
    for (const bool two : {false, true}) {
      const std::string scene = Stack(random, dimension, two, 1 + 1e-6).scene, said = refusal(scene);
      EXPECT_THAT(said, testing::HasSubstr("friction does not hold the body against the loads")) << scene;
      if (dimension == 3) continue;  // there a slight turn adds to the work
      EXPECT_THAT(said, testing::HasSubstr("friction takes at most 99.9999 %: translation along")) << scene;
    }
}

// The upper one alone: friction is less there.
TEST(HeldByFriction, SaysWhichBodySlides) {
  const std::string said =
      refusal(block("a", {0, 0}, {2, 0.4}, {4, 1}, 1) + load("a", "0.0002, -0.001") + on_plane(2, 0.3) +
              block("b", {0.5, 0.4}, {1.5, 0.6}, {4, 1}, 1) + load("b", "0.0002, -0.001") + on_each_other(0.15));
  EXPECT_THAT(said, testing::HasSubstr("friction takes at most 75 %"));
  EXPECT_THAT(said, testing::HasSubstr("'b'"));
}

// A square block that its loads turn about the vertical axis. At most all of the weight is borne by its corners, at
// the distance a sqrt(2): friction bears the torque mu W a sqrt(2), loads k (-y, x) have 2/3 k a^2 V.
TEST(HeldByFriction, AgainstATorqueUpToWhatCornersBear) {
  const double a = 0.7, weight = 0.001, friction = 0.4, limit = 3 / std::numbers::sqrt2 * friction * weight / a;
  const auto said = [&](double part, int refinements) {
    const double k = part * limit;
    const std::string turn = fmt::format("\"-{:.17g} * y\", \"{:.17g} * x\", {}", k, k, -weight);
    return refusal(block("a", {-a, -a, 0}, {a, a, 0.5}, {2, 2, 1}, 1) + load("a", turn) + on_plane(3, friction) +
                   refined(refinements) + "[solver]\nmax_iterations = 1\nmethod = \"monotone\"\nstart = \"zero\"\n");
  };
  for (const int refinements : {0, 1}) {
    EXPECT_THAT(said(1.0001, refinements), testing::HasSubstr("along (0, 0, 1)"));
    EXPECT_THAT(said(0.9999, refinements), testing::HasSubstr("iteration limit"));
  }
}

// The top is pushed down, so that any force may press: friction bears what the law says, and is not refused before.
TEST(HeldByFriction, WherePrescribedValuesPress) {
  Driver driver(parse_scene(block("a", {0, 0}, {2, 1}, {4, 2}, 1) + load("a", "0.002, 0") + on_plane(2, 0.3) +
                                "[[fix]]\nbody = \"a\"\non = \"top\"\nvalue = [\"free\", -0.03]\n" + refined(1),
                            "test.toml", "."));
  const StepReport& step = driver.solve().last();
  EXPECT_TRUE(step.summary.converged()) << step.summary.reason;
  EXPECT_NEAR(step.contact[0].tangential_force[0], -0.004, 1e-9);
}

}  // namespace
}  // namespace signorini::test
