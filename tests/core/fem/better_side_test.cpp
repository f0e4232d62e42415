// Of two sides that touch the coarser one's pressures hold where the finer one's scatter.
#include "core/fem/recovery/better_side.hpp"

#include <gtest/gtest.h>

#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

constexpr Index coarse_cells = 4, fine_cells = 16;

/// A line of nodes in contact; the pressure is 2 + x, and so much more or less at every other node.
std::vector<ContactNode<2>> line(Index first, Index cells, double scatter) {
  std::vector<ContactNode<2>> out;
  for (Index i = 0; i <= cells; ++i) {
    ContactNode<2>& node = out.emplace_back();
    node = {};
    node.vertex = first + i;
    node.contact = true;
    node.area = 1.0 / cells;
    node.recovered = node.pressure = (2 + double(i) / cells) * (1 + (i % 2 ? scatter : -scatter));
    node.traction = {node.recovered / 4, 0};
  }
  return out;
}

/// What each of the nodes from `first` on sees of those from `other` on: linear functions.
MasterMeans sees(Index first, Index cells, Index other, Index other_cells) {
  MasterMeans out;
  for (Index i = 0; i <= cells; ++i) {
    const double at = double(i) * other_cells / cells;
    const Index left = std::min(static_cast<Index>(at), other_cells - 1);
    out.node.push_back(first + i);
    for (const Index q : {left, left + 1}) {
      out.column.push_back(other + q);
      out.weight.push_back(1 - std::abs(at - q));
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

/// Slave nodes from 0 on, master nodes from 100 on.
struct Touching {
  Touching(Index slave_cells, double slave_scatter, Index master_cells, double master_scatter) {
    model.obstacles = {term<2>([](const SurfaceVertex&) { return LocalConstraint<2>{}; }, "")};
    model.obstacles[0].other = Selection{};
    slaves.nodes = line(0, slave_cells, slave_scatter);
    slaves.obstacles.resize(1);
    slaves.obstacles[0].max_pressure = 3 * (1 + slave_scatter);
    slaves.obstacles[0].peaks_at_edge = slave_scatter > 0;
    slaves.obstacles[0].error = slave_scatter / 4;
    masters.nodes = line(100, master_cells, master_scatter);
    masters.pressures = {{.area = 1, .resolved = true, .peaks_at_edge = false, .error = master_scatter / 4}};
    masters.seen = {sees(100, master_cells, 0, slave_cells)};
    pairs.means = std::make_shared<const MasterMeans>(sees(0, slave_cells, 100, master_cells));
  }
  void take() { take_better_side(model, pairs, masters, slaves); }
  static void expect_smooth(const std::vector<ContactNode<2>>& nodes) {
    const double last = static_cast<double>(nodes.size() - 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      EXPECT_NEAR(nodes[i].recovered, 2 + double(i) / last, 1e-12);
      EXPECT_NEAR(nodes[i].traction[0], nodes[i].recovered / 4, 1e-12);  // what friction is of it stays
    }
  }

  Model<2> model;
  PairedBodies<2> pairs;
  ContactState<2> slaves;
  MasterSide<2> masters;
};

TEST(BetterSide, PressuresOfAFineSlaveThatScatterAreThoseOfTheCoarseMaster) {
  Touching sides(fine_cells, 0.2, coarse_cells, 0);
  sides.take();
  Touching::expect_smooth(sides.slaves.nodes);
  EXPECT_NEAR(sides.slaves.obstacles[0].max_pressure, 3, 1e-12);
  EXPECT_FALSE(sides.slaves.obstacles[0].peaks_at_edge);
}

// Where the coarse master bulges between nodes that press on it others are open.
TEST(BetterSide, TheAreaHasWhatIsBetweenNodesThatPress) {
  for (const bool ends : {false, true}) {
    Touching sides(fine_cells, 0.2, coarse_cells, 0);
    for (std::size_t i = 1; i < sides.slaves.nodes.size(); i += 2) {
      sides.slaves.nodes[i].contact = false;
      sides.slaves.nodes[i].recovered = 0;
    }
    sides.slaves.obstacles[0].area = 0.5;
    if (ends) sides.masters.nodes.front().contact = false;
    sides.take();
    EXPECT_NEAR(sides.slaves.obstacles[0].area, ends ? 0.875 : 1, 1e-12);  // not before a node without contact
  }
  Touching edge(fine_cells, 0.2, coarse_cells, 0);
  edge.masters.pressures[0].area = 0.9, edge.slaves.obstacles[0].area = 0.95;
  edge.take();
  EXPECT_EQ(edge.slaves.obstacles[0].area, 0.95);  // fine nodes know better where contact ends
}

TEST(BetterSide, PressuresOfAFineMasterThatScatterAreThoseOfTheCoarseSlave) {
  Touching sides(coarse_cells, 0, fine_cells, 0.2);
  sides.take();
  Touching::expect_smooth(sides.masters.nodes);
  EXPECT_NEAR(sides.slaves.obstacles[0].max_pressure, 3, 1e-12);
}

// As on a coarse master that is far stiffer: what changes within its faces is no error.
TEST(BetterSide, PressuresOfAFineSlaveThatDoNotScatterStay) {
  Touching sides(fine_cells, 0, coarse_cells, 0.2);
  const auto before = sides.slaves.nodes;
  sides.take();
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(sides.slaves.nodes[i].recovered, before[i].recovered);
  EXPECT_TRUE(sides.slaves.obstacles[0].resolved);
}

TEST(BetterSide, OnACoarseSideWithTooFewNodesNothingIsResolved) {
  Touching sides(fine_cells, 0.2, coarse_cells, 0);
  sides.masters.pressures[0].resolved = false;
  sides.take();
  EXPECT_FALSE(sides.slaves.obstacles[0].resolved);
  EXPECT_NEAR(sides.slaves.obstacles[0].max_pressure, 3 * 1.2, 1e-12);
}

// Over a face of the other side errors of fine forces are alike: 16 cells on 4 have four times the variance.
TEST(BetterSide, ErrorsGoAlongWithEachOtherOverAFace) {
  for (const bool larger : {false, true}) {
    Touching sides(fine_cells, 0.2, coarse_cells, 0);
    const double ratio = (1.0 / coarse_cells) / (1.0 / fine_cells);
    sides.masters.pressures[0].error = sides.slaves.obstacles[0].error * std::sqrt(ratio - 1) * (larger ? 1.01 : 0.99);
    sides.take();
    EXPECT_EQ(sides.slaves.obstacles[0].max_pressure > 3.1, larger);
  }
}

TEST(BetterSide, NothingIsTakenWhereNothingTouches) {
  Touching sides(fine_cells, 0.2, coarse_cells, 0);
  for (ContactNode<2>& node : sides.masters.nodes) node.contact = false;
  sides.take();
  EXPECT_NEAR(sides.slaves.obstacles[0].max_pressure, 3 * 1.2, 1e-12);
}

}  // namespace
}  // namespace signorini::testing
