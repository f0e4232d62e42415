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

  /// A flat slave on top of a master, both turned and moved. Calls check(coupling, number of a node in it, x of the
  /// node, its distance).
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
    for (Index p = 0; p < c.nodes(); ++p) check(c, p, places[c.node[p]][0], c.distance(p) / 1e3);
  }

  /// Nodes of faces in front of which the master goes on up to its edge touch that part of it alone, with as much area
  /// as it has.
  static void expect_partners_before_edge(const Surface<D>& master, int cells) {
    double area = 0;
    const double size = 2.0 / cells;
    each_node(master, cells, [&](const MortarCoupling<D>& c, Index p, double x, double distance) {
      if (x > edge + size) return;
      EXPECT_NEAR(distance, 0, 1e-9) << x;
      EXPECT_NEAR(row_value(c, p, [&](Index q) { return master.points[q][0] > edge + 1e-9 ? 1.0 : 0.0; }), 0, 1e-9);
      area += c.weight[p];
    });
    EXPECT_NEAR(area, (1 + edge) * std::pow(2e3, D - 1) / 2, 1e-9 * std::pow(2e3, D - 1));
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

TYPED_TEST(Kinks, WhatLiesBesideAChamferOfTheMasterTouchesUpToItsEdge) {
  for (const double slope : {0.03, 0.1, 0.7})
    for (const int cells : {7, 9, 11, 13}) {
      SCOPED_TRACE(cells);
      this->expect_partners_before_edge(this->chamfered(slope, 0), cells);
      this->each_node(this->chamfered(slope, 0), cells, [&](const auto&, Index, double x, double distance) {
        if (x > edge + 2.0 / cells) {
          EXPECT_NEAR(distance, slope * (x - edge), 1e-9);
        }
      });
    }
}

TYPED_TEST(Kinks, AChamferOfAnInclinedMasterIsFeltByAsMuchAsThatIsInclined) {
  const double tilt = 1e-3;
  for (const int cells : {7, 9, 11, 13})
    this->each_node(this->chamfered(0.7, tilt), cells, [&](const auto&, Index, double x, double distance) {
      if (x <= edge + 2.0 / cells) {
        EXPECT_NEAR(distance, tilt * (x + 1), 2.1 * tilt / cells) << cells;
      }
    });
}

// What is round turns at each edge alike: none of them ends what is touched.
TYPED_TEST(Kinks, FacetsOfARoundMasterHaveNoEdges) {
  constexpr int D = TypeParam::value;
  Random random(1);
  const auto wheel = graph<D>(grid<D - 1>(-1, 1, 10), random, [&](const Plane<D - 1>& y) { return -y[0] * y[0] / 4; });
  for (const int cells : {4, 7, 13}) {
    double area = 0;
    this->each_node(wheel, cells, [&](const auto& c, Index p, double, double) { area += c.weight[p]; });
    EXPECT_NEAR(area, std::pow(2e3, D - 1), 1e-9 * std::pow(2e3, D - 1)) << cells;
  }
}

// A ridge of the master in a groove of the slave: the node in its depth touches both sides.
TYPED_TEST(Kinks, BothSidesOfAnEdgeAreTouchedByWhatLiesAlongThem) {
  constexpr int D = TypeParam::value;
  Random random(1);
  const auto roof = [](const Plane<D - 1>& y) { return -0.3 * std::abs(y[0]); };
  const auto ridge = graph<D>(grid<D - 1>(-1, 1, 10), random, roof);
  auto groove = graph<D>(grid<D - 1>(-1, 1, 8), random, roof);
  groove.flip();
  const auto c = couple<D>(groove.side(), ridge.side(), within(2));
  EXPECT_EQ(c.nodes(), static_cast<Index>(groove.points.size()));
  EXPECT_NEAR(total_weight(c), std::pow(2, D - 1) * std::hypot(1, 0.3), 1e-9);
  for (Index p = 0; p < c.nodes(); ++p) {
    EXPECT_NEAR(c.distance(p), 0, 1e-9);
    if (std::abs(groove.points[c.node[p]][0]) < 1e-9) {
      EXPECT_NEAR(c.normal[p][0], 0, 0.1);  // corners have more of one side
    }
  }
}

TYPED_TEST(Kinks, WhatLiesOnAStepIsNotPressedIntoItByWhatIsBehindThat) {
  for (const double height : {0.01, 0.03, 0.5})
    for (const int cells : {7, 9, 11, 13}) {
      SCOPED_TRACE(cells);
      this->expect_partners_before_edge(this->stepped(height), cells);
      this->each_node(this->stepped(height), cells, [&](const auto&, Index, double x, double distance) {
        if (x >= edge + 2.0 / cells) {
          EXPECT_NEAR(distance, height, 1e-9) << x;
        }
      });
    }
}

// Nor is what comes down inclined onto the end of the master, by what would be beyond that.
TYPED_TEST(Kinks, WhatComesDownOnTheEndOfTheMasterIsNotPressedInBeyondIt) {
  constexpr int D = TypeParam::value;
  Random random(1);
  auto end = grid<D - 1>(-1, 1, 6);
  end.to[0] = edge;
  const auto master = graph<D>(end, random, [&](const Plane<D - 1>& y) { return 0.3 * (y[0] - edge); });
  for (const int cells : {7, 9, 11, 13}) {
    Surface<D> slave = flat<D>(grid<D - 1>(-1, 1, cells), random, 0);
    slave.flip();
    const auto of_slave = slave.faces.size();
    slave.add(master);
    const std::span<const std::array<Index, D>> all = slave.faces;
    const auto c = couple<D>({slave.points, all.first(of_slave)}, {slave.points, all.subspan(of_slave)}, within(2));
    EXPECT_GT(c.nodes(), 0);
    for (Index p = 0; p < c.nodes(); ++p)
      EXPECT_NEAR(c.distance(p), 0.3 * std::max(0.0, edge - slave.points[c.node[p]][0]), 1e-9) << cells;
  }
}

}  // namespace
}  // namespace signorini::test
