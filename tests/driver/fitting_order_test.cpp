// Quadratic elements that would not fit into memory are linear instead, and that is said.
#include "driver/scene/fitting_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "apps/scenes/tables.hpp"
#include "core/base/proc.hpp"
#include "driver/driver.hpp"
#include "driver/scene/problem.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Of the address space.
class Limit {
 public:
  explicit Limit(double more) {
    getrlimit(RLIMIT_AS, &before_);
    const rlimit limit{static_cast<rlim_t>(*proc_bytes("/proc/self/status", "VmSize") + more), before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  ~Limit() { lift(); }
  void lift() const { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

/// 62 MB with linear elements, 776 with quadratic ones.
Scene block(const std::string& order) {
  return parse_scene(
      tables::block("b", "[0, 0, 0]", "[1, 1, 1]", "[30, 30, 30]", order + "young = 1\npoisson = 0.4\n") +
          tables::fix("b", "top", "[0, 0, -0.01]") + tables::plane("b", "bottom", "[0, 0, 0]", "[0, 0, 1]") +
          "[solver]\nmax_iterations = 1\n",
      "block.toml", ".");
}
constexpr double between = 2e8;

TEST(FittingOrder, IsOneWhereTwoDoesNotFit) {
  Scene scene = block("");
  Warnings warnings;
  const auto build = [&] { return build_hierarchy<3>(scene, 3, &warnings); };
  {
    const Limit limit(between);
    EXPECT_EQ(with_fitting_order(scene, 0, warnings, build).finest().points.size(), 31u * 31 * 31);
  }
  EXPECT_EQ(scene.bodies[0].order, 1);
  EXPECT_TRUE(scene.bodies[0].order_chosen);
  EXPECT_EQ(scene.bodies[0].pressure, Pressure::none);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("block.toml:1: body.0: elements are linear"),
                                          HasSubstr("6.809e+05 unknowns need about"), HasSubstr("are available"))));
}

TEST(FittingOrder, IsTwoWhereItFits) {
  Scene scene = block("");
  Warnings warnings;
  const auto meshes = with_fitting_order(scene, 0, warnings, [&] { return build_hierarchy<3>(scene, 3, &warnings); });
  EXPECT_EQ(meshes.finest().points.size(), 61u * 61 * 61);
  EXPECT_EQ(scene.bodies[0].order, 2);
  EXPECT_TRUE(warnings.empty());
}

TEST(FittingOrder, IsThatOfTheSceneWhereItSaysOne) {
  Scene scene = block("order = 2\n");
  Warnings warnings;
  const Limit limit(between);
  EXPECT_THROW(with_fitting_order(scene, 0, warnings, [&] { return build_hierarchy<3>(scene, 3, &warnings); }),
               TooLarge);
  EXPECT_EQ(scene.bodies[0].order, 2);
}

/// Lifts the limit when there are meshes.
class Meshing : public Progress {
 public:
  explicit Meshing(const Limit& limit) : limit_(limit) {}
  void phase(const std::string& what) const override {
    if (what != "meshing") limit_.lift();
  }

 private:
  const Limit& limit_;
};

TEST(FittingOrder, IsKeptAndReportedByTheDriver) {
  const Limit limit(between);
  const Meshing progress(limit);
  Driver driver(block(""), progress);
  for (int k = 0; k < 2; ++k) {
    const Report& report = driver.solve();
    EXPECT_EQ(report.last().bodies[0].order, 1);
    EXPECT_TRUE(report.last().bodies[0].order_chosen);
    EXPECT_EQ(driver.points().size(), 3u * 31 * 31 * 31);
    EXPECT_THAT(report.warnings, testing::Contains(HasSubstr("elements are linear")));
  }
}

/// Scenes of programs leave it open, too.
TEST(FittingOrder, OfBodiesWithoutOneIsChosenByTheDriver) {
  Scene scene =
      parse_scene(tables::block("b", "[0, 0]", "[1, 1]", "[2, 2]", "young = 1\npoisson = 0.3\n") +
                      tables::fix("b", "top", "[0, -0.01]") + tables::plane("b", "bottom", "[0, 0]", "[0, 1]"),
                  "block.toml", ".");
  scene.bodies[0].order = Scene::Body().order;
  scene.bodies[0].pressure.reset();
  Driver driver(scene);
  EXPECT_EQ(driver.solve().last().bodies[0].order, 2);
  EXPECT_EQ(driver.points().size(), 2u * 25);
}

}  // namespace
}  // namespace signorini::test
