#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/scenes/tables.hpp"
#include "driver/driver.hpp"
#include "tests/verification/run.hpp"

// Elastic bodies in contact with each other, against closed forms, one-body contact and each other.

namespace signorini::test {
namespace {

std::string pair(const std::string& slave, const std::string& on, const std::string& master,
                 const std::string& other_on, const std::string& more = "") {
  return fmt::format(
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"{}\"\non = \"{}\"\nother = \"{}\"\nother_on = \"{}\"\n{}", slave, on,
      master, other_on, more);
}

/// A press of two blocks between a support and a pressure of 0.1: each may slide along x (and y) but for its left
/// (front) face, so that the stress is uniaxial everywhere.
struct Press {
  std::string upper = "[5, 3]", lower = "[4, 4]";  // cells
  bool upper_is_slave = true;
  std::string more = "";
};

std::string press_2d(const Press& press) {
  using tables::fix, tables::load;
  return tables::block("lower", "[0, 0]", "[1, 1]", press.lower) +
         tables::block("upper", "[0, 1]", "[1, 1.75]", press.upper) + fix("lower", "bottom", "[\"free\", 0]") +
         fix("lower", "left", "[0, \"free\"]") + fix("upper", "left", "[0, \"free\"]") +
         load("upper", "[0, -0.1]", "top") +
         (press.upper_is_slave ? pair("upper", "bottom", "lower", "top") : pair("lower", "top", "upper", "bottom")) +
         press.more;
}

std::string press_3d(const Press& press) {
  using tables::fix, tables::load;
  return tables::block("lower", "[0, 0, 0]", "[1, 1, 1]", press.lower) +
         tables::block("upper", "[0, 0, 1]", "[1, 1, 1.5]", press.upper) +
         fix("lower", "bottom", "[\"free\", \"free\", 0]") + fix("lower", "left", "[0, \"free\", \"free\"]") +
         fix("upper", "left", "[0, \"free\", \"free\"]") + fix("lower", "front", "[\"free\", 0, \"free\"]") +
         fix("upper", "front", "[\"free\", 0, \"free\"]") + load("upper", "[0, 0, -0.1]", "top") +
         (press.upper_is_slave ? pair("upper", "bottom", "lower", "top") : pair("lower", "top", "upper", "bottom")) +
         press.more;
}

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

/// The largest deviation of the nodal pressures from `expected`, relative to it.
double deviation(const Driver& driver, double expected) {
  return driver.visit(0, [&](const auto& run) {
    double worst = 0;
    for (const auto& node : run.results().contact.nodes)
      worst = std::max(worst, std::abs(node.pressure - expected) / expected);
    return worst;
  });
}

void expect_uniform_pressure(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged()) << report.reason();
  EXPECT_LT(deviation(driver, 0.1), 1e-9);
  const StepReport& step = report.last();
  const int up = report.dimension - 1;
  EXPECT_NEAR(std::abs(step.contact[0].force[up]), 0.1, 1e-11);
  for (const BalanceReport& balance : step.balance)
    for (const double left : balance.sum()) EXPECT_NEAR(left, 0, 1e-11) << balance.body;
  show("{} iterations, deviation {:.2e}\n", step.summary.iterations, deviation(driver, 0.1));
}

TEST(TwoBodies, PassThePatchTestIn2D) {
  for (const bool upper_is_slave : {true, false})
    for (const char* cells : {"[4, 3]", "[8, 3]", "[5, 3]", "[29, 3]", "[1, 1]"})
      for (const char* refined : {"", "[refine]\nuniform = 2\n"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", upper_is_slave, cells, refined));
        expect_uniform_pressure(press_2d({cells, "[4, 4]", upper_is_slave, refined}));
      }
}

TEST(TwoBodies, PassThePatchTestIn3D) {
  for (const bool upper_is_slave : {true, false})
    for (const char* cells : {"[2, 2, 1]", "[3, 5, 1]", "[7, 7, 2]"})
      for (const char* refined : {"", "[refine]\nuniform = 1\n"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", upper_is_slave, cells, refined));
        expect_uniform_pressure(press_3d({cells, "[2, 2, 2]", upper_is_slave, refined}));
      }
}

}  // namespace
}  // namespace signorini::test
