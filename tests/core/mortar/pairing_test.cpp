// Who pairs with whom, and how far they are apart: reach, overlap, layers, parts of one body, both pairings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/mesh/simplex.hpp"
#include "tests/core/mortar/surfaces.hpp"

namespace signorini::test {
namespace {

template <class N>
class Pairs : public testing::Test {
 protected:
  static constexpr int dimension = N::value;
  Random random{17};

  /// Facing down.
  Surface<dimension> above(double height, double from = 0, double to = 1, int cells = 5) {
    Surface<dimension> out = flat<dimension>(grid<dimension - 1>(from, to, cells, 0.2), random, height);
    out.flip();
    return out;
  }
  Surface<dimension> below(double height, double from = 0, double to = 1, int cells = 4) {
    return flat<dimension>(grid<dimension - 1>(from, to, cells, 0.2), random, height);
  }
};
TYPED_TEST_SUITE(Pairs, Dimensions);

TYPED_TEST(Pairs, FacesBeyondTheReachDoNotSeeEachOther) {
  constexpr int D = TypeParam::value;
  const auto slave = this->above(1), master = this->below(0);
  const auto all = static_cast<Index>(slave.points.size());
  for (const double reach : {1.01, 3.0, infinity})
    EXPECT_EQ(couple<D>(slave.side(), master.side(), within(reach)).nodes(), all) << reach;
  const auto c = couple<D>(slave.side(), master.side(), within(0.99));
  EXPECT_EQ(c.nodes(), 0);
  EXPECT_EQ(static_cast<Index>(c.alone.size()), all);
  EXPECT_EQ(c.row, std::vector<Offset>{0});
}

TYPED_TEST(Pairs, NormalsMustOppose) {
  constexpr int D = TypeParam::value;
  auto slave = this->above(0.1), master = this->below(0);
  master.flip();
  EXPECT_EQ(couple<D>(slave.side(), master.side(), within(1)).nodes(), 0);
  slave.flip();
  // Both turned round: the slave has gone through the master.
  EXPECT_NEAR(couple<D>(slave.side(), master.side(), within(1)).gap.front(), -0.1, 1e-15);
}

TYPED_TEST(Pairs, TheDeepestOverlapIsFoundWithItsPlace) {
  constexpr int D = TypeParam::value;
  Surface<D> slave = graph<D>(grid<D - 1>(0, 1, 8), this->random,
                              [](const Plane<D - 1>& y) { return 0.2 * std::abs(y[0] - 0.625) - 0.05; });
  slave.flip();
  CoupleOptions options = within(1);
  const auto master = this->below(0);
  auto c = couple<D>(slave.side(), master.side(), options);
  // Along the slave's normal, whose slope is 1 to 5.
  EXPECT_NEAR(c.deepest.depth, 0.05 * std::sqrt(1 + 0.04), 1e-14);
  EXPECT_NEAR(c.deepest.place[0], 0.625, 1e-14);
  EXPECT_NEAR(c.deepest.place[D - 1], -0.05, 1e-14);
  ASSERT_GE(c.deepest.slave_face, 0);
  ASSERT_GE(c.deepest.master_face, 0);
  options.pairing = Pairing::closest;
  c = couple<D>(slave.side(), master.side(), options);
  EXPECT_NEAR(c.deepest.depth, 0.05, 1e-14);
  // Deeper than is looked for: not seen.
  const auto through = this->above(-0.3);
  EXPECT_NEAR((couple<D>(through.side(), master.side(), options).deepest.depth), 0.3, 1e-14);
  options.depth = 0.2;
  EXPECT_EQ((couple<D>(through.side(), master.side(), options).nodes()), 0);
}

// The upper side of a body that lies on another one does not overlap the lower side of that.
TYPED_TEST(Pairs, TheFarSideIsNotSeenThroughBodies) {
  constexpr int D = TypeParam::value;
  const auto upper_side = this->below(0.3);
  auto master = this->above(-0.5, -0.2, 1.2, 3);
  EXPECT_NEAR((couple<D>(upper_side.side(), master.side(), within(1)).deepest.depth), 0.8, 1e-14);
  master.add(this->below(0, -0.2, 1.2, 3));
  const auto c = couple<D>(upper_side.side(), master.side(), within(1));
  EXPECT_EQ(c.nodes(), 0);
  EXPECT_EQ(c.deepest.depth, 0);
  // An overlap remains one.
  const auto deep = couple<D>(this->above(-0.1).side(), master.side(), within(1));
  EXPECT_GT(deep.nodes(), 0);
  EXPECT_NEAR(deep.deepest.depth, 0.1, 1e-14);
}

// Nor past a steep slope of the master, which no face of the slave faces: the way back leaves the master there.
TEST(PlanePairs, TheFarSideIsNotSeenThroughASlope) {
  const Surface<2> slave{{{0.25, 0}, {0.35, 0}}, {{0, 1}}};
  Surface<2> master{{{1, 1}, {0, 1}}, {{0, 1}}};
  EXPECT_GT(couple<2>(slave.side(), master.side(), within(2)).nodes(), 0);
  master.add({{{0.4, 0.9}, {0.2, 0.1}}, {{0, 1}}});
  EXPECT_EQ(couple<2>(slave.side(), master.side(), within(2)).nodes(), 0);
}

// A sheet without thickness between two surfaces: there is no direction for its nodes.
TYPED_TEST(Pairs, NodesWithoutADirectionAreLeftAlone) {
  constexpr int D = TypeParam::value;
  auto sheet = this->below(0.5);
  auto turned = sheet;
  turned.flip();
  sheet.faces.insert(sheet.faces.end(), turned.faces.begin(), turned.faces.end());
  auto master = this->below(0);
  master.add(this->above(1));
  const auto c = couple<D>(sheet.side(), master.side(), within(1));
  EXPECT_EQ(c.nodes(), 0);
  EXPECT_EQ(c.alone.size(), sheet.points.size());
}

TEST(Faces, PairUpToSixtyDegrees) {
  for (const double angle : {0.0, 59.0, -59.0, 61.0, -61.0, 85.0}) {
    SCOPED_TRACE(angle);
    const double rise = std::tan(angle / 180 * std::numbers::pi);
    const Surface<2> slave{{{0, 20}, {1, 20}}, {{0, 1}}}, master{{{-90, -90 * rise}, {90, 90 * rise}}, {{1, 0}}};
    for (const Pairing pairing : {Pairing::normal, Pairing::closest})
      EXPECT_EQ((couple<2>(slave.side(), master.side(), within(100, pairing)).nodes() > 0), std::abs(angle) < 60);
  }
}

// The walls of a wedge cut into one body face each other, and meet at its tip.
TEST(Faces, OfOneBodyThatMeetDoNotPair) {
  const std::vector<Point<2>> points{{0, 0}, {1, 0.1}, {1, -0.1}, {2, 0.2}, {2, -0.2}};
  const std::vector<std::array<Index, 2>> upper{{0, 1}, {1, 3}}, lower{{2, 0}, {4, 2}};
  const auto c = couple<2>({points, upper, "upper"}, {points, lower, "lower"}, within(1));
  EXPECT_THAT(c.node, testing::ElementsAre(1, 3));
  for (Index p = 0; p < c.nodes(); ++p)
    for (Offset k = c.row[p]; k < c.row[p + 1]; ++k) EXPECT_NE(c.column[k], 0) << "the tip";
}

// A tip in a groove whose walls are parallel to its sides, at a distance of 0.1: up to an angle of 120 degrees between
// the normals the tip's distance is that along the mean direction, at sharper tips no more than twice 0.1.
TEST(Tips, AreNoFartherOffThanTwiceTheirSides) {
  for (const double angle : {30.0, 59.0, 61.0, 80.0}) {
    SCOPED_TRACE(angle);
    const double s = std::sin(angle / 180 * std::numbers::pi), c = std::cos(angle / 180 * std::numbers::pi);
    const Surface<2> tip{{{-c, s}, {0, 0}, {c, s}}, {{0, 1}, {1, 2}}};
    const Point<2> left{-0.1 * s, -0.1 * c}, right{0.1 * s, -0.1 * c};
    Surface<2> groove{{{left[0] - 2 * c, left[1] + 2 * s}, {left[0] + c, left[1] - s}}, {{1, 0}}};
    groove.add({{{right[0] - c, right[1] - s}, {right[0] + 2 * c, right[1] + 2 * s}}, {{1, 0}}});
    const auto found = couple<2>(tip.side(), groove.side(), within(1));
    ASSERT_EQ(found.nodes(), 3);
    EXPECT_NEAR(found.gap[1], 0.1 / std::max(c, 0.5), 1e-12);
    EXPECT_NEAR(found.normal[1][1], -1, 1e-12);
  }
}

// Of masters a little behind each other the nearest counts, and the farther one where it shows.
TYPED_TEST(Pairs, TheNearestOfSeveralLayersCounts) {
  constexpr int D = TypeParam::value;
  const auto slave = this->above(0);
  auto master = this->below(-0.4, -0.2, 1.2, 3);
  const Index near = master.add(this->below(-0.399, 0, 0.5));
  const auto c = couple<D>(slave.side(), master.side(), within(1));
  EXPECT_GT(c.layered, 0);
  EXPECT_NEAR(total_weight(c), 1, 1e-12);
  double on_near = 0;
  for (Index p = 0; p < c.nodes(); ++p) {
    on_near += c.weight[p] * row_value(c, p, [&](Index q) { return q >= near ? 1.0 : 0.0; });
    const Point<D>& x = slave.points[c.node[p]];
    if (std::ranges::max_element(x) != x.end() && *std::ranges::max_element(x) < 0.25) {
      EXPECT_NEAR(c.gap[p], 0.399, 1e-13);
    }
    if (x[0] > 0.75) {
      EXPECT_NEAR(c.gap[p], 0.4, 1e-13);
    }
  }
  EXPECT_NEAR(on_near, std::pow(0.5, D - 1), 1e-12);
}

// A sheet that ends above another one, within a slave face that neither of them covers.
TYPED_TEST(Pairs, LayersOfAPartlyCoveredFaceAreParted) {
  constexpr int D = TypeParam::value;
  auto slave = this->above(0, 0, 1, 1);
  auto master = this->below(-0.2, 0, 0.5, 2);
  master.add(this->below(-0.195, 0.25, 0.75, 3));
  const auto c = couple<D>(slave.side(), master.side(), within(1));
  const double side = 0.5, shared = 0.25;
  EXPECT_NEAR(total_weight(c), 2 * std::pow(side, D - 1) - std::pow(shared, D - 1), 1e-12);
}

TYPED_TEST(Pairs, FacesOfOneBodyThatShareNodesDoNotPair) {
  constexpr int D = TypeParam::value;
  // A wedge between two flanks that meet at an edge: its two sides are opposite, but for 20 degrees.
  const double slope = std::tan(10 * std::numbers::pi / 180);
  Surface<D> body = graph<D>(grid<D - 1>(0, 1, 4), this->random, [&](const Plane<D - 1>& y) { return -slope * y[0]; });
  const std::size_t lower = body.faces.size();
  Surface<D> top = graph<D>(grid<D - 1>(0, 1, 4), this->random, [&](const Plane<D - 1>& y) { return slope * y[0]; });
  top.flip();
  body.add(top);
  // Join both at the edge.
  const auto half = static_cast<Index>(body.points.size() / 2);
  for (auto& face : body.faces)
    for (Index& v : face)
      if (v >= half && body.points[v][0] == 0) v -= half;
  const std::span<const std::array<Index, D>> faces(body.faces);
  const auto pair = [&](const std::vector<Point<D>>& on) {
    return couple<D>({body.points, faces.subspan(lower), "upper flank"}, {on, faces.first(lower), "lower flank"},
                     within(1));
  };
  const auto c = pair(body.points);
  EXPECT_GT(c.nodes(), 0);
  for (const Index p : c.node) EXPECT_GT(body.points[p][0], 0);
  std::size_t at_edge = 0;
  for (const Index p : c.alone) at_edge += body.points[p][0] == 0;
  EXPECT_EQ(at_edge, D == 2 ? 1 : 5);
  // With numberings of their own they do.
  const std::vector<Point<D>> copy = body.points;
  EXPECT_GT(pair(copy).node.size(), c.node.size());
  EXPECT_EQ((couple<D>(body.side(), body.side(), within(1)).nodes()), 0);
}

// A ball in a larger one, off its middle: gaps along the slave's normal and to the closest points in closed form.
TYPED_TEST(Pairs, GapsOfRoundSurfacesAreThoseOfTheirShapes) {
  constexpr int D = TypeParam::value, K = D - 1;
  const double r = 1, R = 1.5, e = 0.2;  // radii, and how far the middles are apart
  const auto cap = [&](double radius, double half, int cells, double middle) {
    return graph<D>(grid<K>(-half, half, cells), this->random,
                    [=](const Plane<K>& y) { return middle - std::sqrt(radius * radius - dot(y, y)); });
  };
  for (const Pairing pairing : {Pairing::normal, Pairing::closest}) {
    double last = 0;
    for (const int cells : {16, 32, 64}) {
      if (D == 3 && cells == 64) break;
      Surface<D> slave = cap(r, 0.4, cells, e);
      slave.flip();
      const auto master = cap(R, 0.8, cells + cells / 4 + 1, 0);
      const auto c = couple<D>(slave.side(), master.side(), within(1, pairing));
      ASSERT_EQ(c.nodes(), static_cast<Index>(slave.points.size()));
      double worst = 0;
      for (Index p = 0; p < c.nodes(); ++p) {
        const Point<D>& x = slave.points[c.node[p]];
        // At the border nodes have faces on one side only, and the mean normal is of first order.
        bool border = false;
        for (int k = 0; k < K; ++k) border |= std::abs(x[k]) > 0.399;
        if (border) continue;
        Point<D> n = x;
        n[K] -= e;
        const double b = dot(n, x);
        const double along = -b + std::sqrt(b * b + R * R - dot(x, x));
        const double closest = R - std::sqrt(dot(x, x));
        worst = std::max(worst, std::abs(c.gap[p] - (pairing == Pairing::normal ? along : closest)));
      }
      if (last > 0) {
        EXPECT_GT(last / worst, 3.3) << cells;
      } else {
        EXPECT_LT(worst, 2e-3);
      }
      last = worst;
    }
  }
}

template <int D>
std::string message(const Surface<D>& slave, const Surface<D>& master, const CoupleOptions& options) {
  try {
    couple<D>(slave.side("slave of 'press'"), master.side("master of 'press'"), options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TYPED_TEST(Pairs, WrongInputIsRefusedWithItsPlace) {
  constexpr int D = TypeParam::value;
  const auto slave = this->above(0), master = this->below(0);
  auto wrong = master;
  const Index v = wrong.faces[1][0];
  wrong.points[v][0] = std::nan("");
  EXPECT_THAT(message<D>(slave, wrong, within(1)),
              testing::AllOf(testing::HasSubstr("master of 'press': face "), testing::HasSubstr("nan")));
  wrong = master;
  wrong.faces[2][0] = 1000;
  EXPECT_THAT(message<D>(slave, wrong, within(1)), testing::HasSubstr("names node 1000, expected 0 to"));
  wrong = slave;
  wrong.points[wrong.faces[3][1]] = wrong.points[wrong.faces[3][0]];
  EXPECT_THAT(message<D>(wrong, master, within(1)),
              testing::AllOf(testing::HasSubstr("slave of 'press': face "), testing::HasSubstr("has no area")));
  for (const double reach : {0.0, -1.0, std::nan("")})
    EXPECT_THAT(message<D>(slave, master, within(reach)), testing::HasSubstr("reach of the pairing larger than 0"));
  CoupleOptions options = within(1);
  options.depth = std::nan("");
  EXPECT_THAT(message<D>(slave, master, options), testing::HasSubstr("depth"));
}

TYPED_TEST(Pairs, NoFacesAreNoCoupling) {
  constexpr int D = TypeParam::value;
  const auto some = this->above(0);
  EXPECT_EQ(couple<D>(Surface<D>{}.side(), some.side(), within(1)).nodes(), 0);
  EXPECT_EQ(couple<D>(some.side(), Surface<D>{}.side(), within(1)).alone.size(), some.points.size());
}

}  // namespace
}  // namespace signorini::test
