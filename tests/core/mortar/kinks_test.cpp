// Edges and steps of the master within faces of the slave: what touches beside them is no farther in than it is.
#include <gtest/gtest.h>

#include "tests/core/mortar/surfaces.hpp"

namespace signorini::test {
namespace {

constexpr double edge = 0.2;

template <class N>
class Kinks : public testing::Test {
 protected:
  static constexpr int D = N::value;
  using Place = Plane<D - 1>;

  /// A flat slave on top of a master, both turned and moved. Calls check(x of the node, its distance).
  template <class Check>
  static void each_node(const Surface<D>& master_as_it_is, int cells, const Check& check) {
    Random random(cells);
    Surface<D> master = master_as_it_is, slave = flat<D>(grid<D - 1>(-1, 1, cells), random, 0);
    slave.flip();
    const std::vector<Point<D>> places = slave.points;
    const Similarity<D> motion = random_similarity<D>(random, 1e3);
    motion.apply(slave);
    motion.apply(master);
    const auto c = couple<D>(slave.side(), master.side(), within(2e3));
    EXPECT_EQ(c.nodes(), static_cast<Index>(slave.points.size()));
    for (Index p = 0; p < c.nodes(); ++p) check(places[c.node[p]][0], c.distance(p) / 1e3);
  }

  static Surface<D> chamfered(double slope, double tilt) {
    Random random(1);
    return graph<D>(grid<D - 1>(-1, 1, 10), random,
                    [&](const Place& y) { return -slope * std::max(0.0, y[0] - edge) - tilt * (y[0] + 1); });
  }
  static Surface<D> stepped(double height) {
    Random random(1);
    Surface<D> out = flat<D>(grid<D - 1>(-1, 1, 10), random, -height);
    auto top = grid<D - 1>(-1, 1, 4);
    top.to[0] = edge;
    out.add(flat<D>(top, random, 0));
    return out;
  }
};
TYPED_TEST_SUITE(Kinks, Dimensions);

TYPED_TEST(Kinks, AChamferOfTheMasterIsNotFeltBesideIt) {
  for (const double slope : {0.1, 0.7})
    for (const int cells : {7, 9, 11, 13}) {
      SCOPED_TRACE(cells);
      this->each_node(this->chamfered(slope, 0), cells, [&](double x, double distance) {
        EXPECT_NEAR(distance, slope * std::max(0.0, x - edge), x <= edge ? 1e-9 : 0.3 * slope / cells);
      });
    }
}

TYPED_TEST(Kinks, AChamferOfAnInclinedMasterIsFeltByAsMuchAsThatIsInclined) {
  const double tilt = 1e-3;
  for (const int cells : {7, 9, 11, 13})
    this->each_node(this->chamfered(0.7, tilt), cells, [&](double x, double distance) {
      if (x <= edge) {
        EXPECT_NEAR(distance, tilt * (x + 1), 2.1 * tilt / cells) << cells;
      }
    });
}

TYPED_TEST(Kinks, WhatLiesOnAStepIsNotPressedIntoItByWhatIsBehindThat) {
  for (const double height : {0.01, 0.5})
    for (const int cells : {7, 9, 11, 13}) {
      SCOPED_TRACE(cells);
      const double size = 2.0 / cells;
      this->each_node(this->stepped(height), cells, [&](double x, double distance) {
        EXPECT_GE(distance, -1e-9);
        EXPECT_LE(distance, height + 1e-9);
        if (x <= edge - size || (x <= edge && height > size)) {
          EXPECT_NEAR(distance, 0, 1e-9) << x;
        }
        if (x >= edge + size) {
          EXPECT_NEAR(distance, height, 1e-9) << x;
        }
      });
    }
}

}  // namespace
}  // namespace signorini::test
