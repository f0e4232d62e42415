#include "tests/bodies/scenes.hpp"

// What is known at the nodes of the master.

namespace signorini::test {
namespace {

/// A block over another one, `apart` from it.
std::string blocks(const char* slave, double apart, int order) {
  const std::string material = fmt::format("order = {}\nyoung = 1\npoisson = 0\n", order);
  return tables::block("lower", "[0, 0]", "[1, 1]", "[7, 4]", material) +
         tables::block("upper", fmt::format("[0, {}]", 1 + apart), fmt::format("[1, {}]", 1.5 + apart), "[4, 2]",
                       material) +
         tables::fix("lower", "bottom", "[0, 0]") + tables::fix("upper", "top", "[0, -0.06]") +
         pair("upper", "bottom", "lower", "top", slave);
}

template <class Check>
void each(const Check& check) {
  for (const int order : {1, 2})
    for (const char* slave : {"slave = \"body\"\n", "slave = \"other\"\n"}) {
      SCOPED_TRACE(fmt::format("order {}, {}", order, slave));
      check(slave, order);
    }
}

// Without Poisson's ratio the stress is 0.06 / 1.5 everywhere.
TEST(MasterSide, IsPressedAsTheSlaveIs) {
  each([](const char* slave, int order) {
    Driver driver(scene_of(blocks(slave, 0, order)));
    ASSERT_TRUE(driver.solve().converged());
    driver.visit(0, [](const auto& run) {
      const auto& masters = run.results().masters;
      EXPECT_GT(masters.size(), 4u);
      for (const auto& node : masters) {
        EXPECT_TRUE(node.contact);
        EXPECT_NEAR(node.recovered, 0.04, 1e-9);
        EXPECT_NEAR(node.pressure, 0.04, 1e-9);
        EXPECT_NEAR(node.gap, 0, 1e-9);
      }
    });
  });
}

TEST(MasterSide, KnowsHowFarTheSlaveIs) {
  each([](const char* slave, int order) {
    Driver driver(scene_of(blocks(slave, 0.1, order)));
    ASSERT_TRUE(driver.solve().converged());
    driver.visit(0, [](const auto& run) {
      EXPECT_GT(run.results().masters.size(), 4u);
      for (const auto& node : run.results().masters) {
        EXPECT_FALSE(node.contact);
        EXPECT_EQ(node.recovered, 0);
        EXPECT_NEAR(node.gap, 0.04, 1e-9);
      }
    });
  });
}

// An offset of the scene's counts there, too.
TEST(MasterSide, KnowsWhatTheSceneAddsToTheDistance) {
  Driver driver(scene_of(blocks("slave = \"body\"\ngap = 0.01\n", 0.1, 1)));
  ASSERT_TRUE(driver.solve().converged());
  driver.visit(0, [](const auto& run) {
    ASSERT_FALSE(run.results().masters.empty());
    for (const auto& node : run.results().masters) EXPECT_NEAR(node.gap, 0.05, 1e-9);
  });
}

std::string disk_on_block(const char* moved) {
  return "[[body]]\nname = \"disk\"\nshape = \"half_disk\"\ncenter = [0, 1]\nradius = 1\nsize = \"0.03 + 0.3 * "
         "sqrt(x^2 + y^2)\"\norder = 1\nyoung = 1\npoisson = 0.3\n" +
         tables::block("block", "[-1, -1]", "[1, 0]", "[64, 32]") + tables::fix("disk", "flat", moved) +
         tables::fix("block", "bottom", "[0, 0]") + "[refine]\nuniform = 2\n";
}

// Round bodies: the largest pressure and the width of what presses are alike on both sides.
TEST(MasterSide, FeelsTheSamePressureWhereBodiesAreRound) {
  Driver driver(scene_of(disk_on_block("[0, -0.04]") + pair("disk", "curved", "block", "top")));
  const Report& report = driver.solve();
  ASSERT_TRUE(report.converged());
  const double largest = report.last().contact[0].max_pressure;
  driver.visit(0, [&](const auto& run) {
    double found = 0, force = 0;
    for (const auto& node : run.results().masters) {
      found = std::max(found, node.recovered);
      force += node.pressure * node.area;
    }
    show("largest pressure {:.4g} on the slave, {:.4g} on the master\n", largest, found);
    EXPECT_NEAR(found, largest, 0.03 * largest);
    EXPECT_NEAR(force, length(report.last().contact[0].force), 0.01 * force);
  });
}

/// How far from the middle nodes slip at most, stick at most, and slip at least.
template <int D, int B>
std::array<double, 3> zones(const Nodes<D>& nodes, const std::vector<ContactNode<B>>& contact) {
  std::array<double, 3> out{0, 0, 1};
  for (const ContactNode<B>& node : contact) {
    if (!node.contact) continue;
    EXPECT_TRUE(node.friction);
    const double x = std::fabs(nodes.at(node.vertex)[0]);
    if (node.sticks)
      out[1] = std::max(out[1], x);
    else
      out = {std::max(out[0], x), out[1], std::min(out[2], x)};
  }
  return out;
}

// A disk pressed on and then pushed aside by less than what friction holds sticks in the middle and slips at both ends,
// on either side.
TEST(MasterSide, SticksAndSlipsAsTheSlaveDoes) {
  Driver driver(scene_of(disk_on_block("[\"0.04 * max(t - 0.5, 0)\", \"-0.04 * min(2 * t, 1)\"]") +
                         "[steps]\ncount = 2\n" +
                         pair("disk", "curved", "block", "top", "friction = 0.4\n", "elastic_coulomb")));
  ASSERT_TRUE(driver.solve().converged());
  driver.visit(0, [&](const auto& run) {
    const auto slave = zones(run.nodes(), run.results().contact.nodes);
    const auto master = zones(run.nodes(), run.results().masters);
    show("slip to {:.3g}, stick to {:.3g}; on the master {:.3g}, {:.3g}\n", slave[0], slave[1], master[0], master[1]);
    constexpr double cell = 2 / 256.;
    EXPECT_GT(slave[1], 3 * cell);
    EXPECT_GT(slave[0], slave[1] + 3 * cell);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(slave[k], master[k], 2 * cell);
  });
}

}  // namespace
}  // namespace signorini::test
