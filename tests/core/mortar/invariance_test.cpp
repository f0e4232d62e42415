// What the result must not depend on, what it tends to on curved surfaces, and strips next to nothing wide.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/base/dot.hpp"
#include "tests/core/mortar/surfaces.hpp"

namespace signorini::test {
namespace {

template <class N>
class Invariance : public testing::Test {};
TYPED_TEST_SUITE(Invariance, Dimensions);

template <int D>
Surface<D> wavy(Random& random, double from, double to, int cells, double height) {
  const double phase = random.between(0, 6);
  return graph<D>(grid<D - 1>(from, to, cells, 0.2), random, [=](const Plane<D - 1>& y) {
    double z = height;
    for (const double c : y) z += 0.02 * std::sin(5 * c + phase);
    return z;
  });
}

std::vector<Index> permutation(Random& random, std::size_t n) {
  std::vector<Index> out(n);
  std::iota(out.begin(), out.end(), Index{0});
  for (std::size_t i = n; i > 1; --i) std::swap(out[i - 1], out[random.below(static_cast<int>(i))]);
  return out;
}

/// Other numbers of nodes and faces, and another first node of each face.
/// @return the new number of each node
template <int D>
std::vector<Index> renumber(Random& random, Surface<D>& surface) {
  const auto node = permutation(random, surface.points.size()), face = permutation(random, surface.faces.size());
  Surface<D> out = surface;
  for (std::size_t v = 0; v < node.size(); ++v) out.points[node[v]] = surface.points[v];
  for (std::size_t f = 0; f < face.size(); ++f) {
    auto nodes = surface.faces[f];
    if (D == 3) std::rotate(nodes.begin(), nodes.begin() + random.below(D), nodes.end());
    for (Index& v : nodes) v = node[v];
    out.faces[face[f]] = nodes;
  }
  surface = out;
  return node;
}

TYPED_TEST(Invariance, NumberingPlaceAndUnitsDoNotMatter) {
  constexpr int D = TypeParam::value;
  Random random(23);
  for (int trial = 0; trial < 30; ++trial) {
    const CoupleOptions options = within(1, trial % 2 ? Pairing::normal : Pairing::closest);
    Surface<D> slave = wavy<D>(random, 0, 1, 6, 0.05), master = wavy<D>(random, -0.2, 0.9, 9, 0);
    slave.flip();
    const auto c = couple<D>(slave.side(), master.side(), options);
    Surface<D> other_slave = slave, other_master = master;
    const auto slave_number = renumber<D>(random, other_slave), master_number = renumber<D>(random, other_master);
    const Similarity<D> motion = random_similarity<D>(random, std::pow(10, random.between(-6, 6)));
    motion.apply(other_slave);
    motion.apply(other_master);
    CoupleOptions moved = options;
    moved.reach *= motion.scale;
    const auto other = couple<D>(other_slave.side(), other_master.side(), moved);
    ASSERT_EQ(c.nodes(), other.nodes());
    ASSERT_EQ(c.alone.size(), other.alone.size());
    EXPECT_NEAR(c.deepest.depth, other.deepest.depth / motion.scale, 1e-14);
    const std::vector<double> whole = lumped_areas(slave);
    for (Index i = 0; i < c.nodes(); ++i) {
      const auto at = std::ranges::lower_bound(other.node, slave_number[c.node[i]]);
      ASSERT_TRUE(at != other.node.end() && *at == slave_number[c.node[i]]);
      const auto j = static_cast<Index>(at - other.node.begin());
      const double tolerance = std::max(1e-12, 2e-14 * whole[c.node[i]] / c.weight[i]);
      EXPECT_NEAR(c.weight[i], other.weight[j] / std::pow(motion.scale, D - 1), 1e-13);
      EXPECT_NEAR(c.gap[i], other.gap[j] / motion.scale, tolerance);
      const Point<D> turned = motion.turned(c.normal[i]);
      for (int k = 0; k < D; ++k) EXPECT_NEAR(turned[k], other.normal[j][k], tolerance);
      ASSERT_EQ(c.row[i + 1] - c.row[i], other.row[j + 1] - other.row[j]);
      for (Offset k = c.row[i]; k < c.row[i + 1]; ++k) {
        const auto first = other.column.begin() + other.row[j], last = other.column.begin() + other.row[j + 1];
        const auto q = std::lower_bound(first, last, master_number[c.column[k]]);
        ASSERT_TRUE(q != last && *q == master_number[c.column[k]]);
        EXPECT_NEAR(c.value[k], other.value[q - other.column.begin()], tolerance);
      }
    }
  }
}

TYPED_TEST(Invariance, ThreadsDoNotMatter) {
  constexpr int D = TypeParam::value;
  Random random(29);
  Surface<D> slave = wavy<D>(random, 0, 1, D == 2 ? 3000 : 40, 0.05);
  const Surface<D> master = wavy<D>(random, -0.2, 0.9, D == 2 ? 2500 : 30, 0);
  slave.flip();
  const auto c = couple<D>(slave.side(), master.side(), within(1));
  for (const int threads : {1, 2, 3}) {
    Crew crew(threads);
    const auto other = couple<D>(slave.side(), master.side(), within(1), &crew);
    EXPECT_EQ(c.node, other.node);
    EXPECT_EQ(c.weight, other.weight);
    EXPECT_EQ(c.normal, other.normal);
    EXPECT_EQ(c.gap, other.gap);
    EXPECT_EQ(c.row, other.row);
    EXPECT_EQ(c.column, other.column);
    EXPECT_EQ(c.value, other.value);
    EXPECT_EQ(c.deepest.place, other.deepest.place);
  }
}

// A round master under a round slave of the same radius: weights tend to the area of the arc or the cap, gaps to zero.
TYPED_TEST(Invariance, WeightsAndGapsOnCurvedSurfacesAreOfSecondOrder) {
  constexpr int D = TypeParam::value, K = D - 1;
  Random random(31);
  // The cap over a disc, in 2D an interval, of a radius: the grid's square mapped to it.
  const double rim = 0.6;
  const auto cap = [&](int cells) {
    Surface<D> out = flat<D>(grid<K>(-1, 1, cells), random);
    for (Point<D>& x : out.points) {
      double largest = 0, norm = 0;
      for (int k = 0; k < K; ++k) largest = std::max(largest, std::abs(x[k])), norm += x[k] * x[k];
      norm = std::sqrt(norm);
      for (int k = 0; k < K; ++k) x[k] *= norm > 0 ? rim * largest / norm : 0;
      x[K] = std::sqrt(1 - rim * rim * largest * largest);
    }
    return out;
  };
  const double half = std::asin(rim);
  const double area = D == 2 ? 2 * half : 2 * std::numbers::pi * (1 - std::cos(half));
  // Vertices are moved at random: the order shows over several meshes.
  std::vector<double> area_error, gap_error;
  for (const int cells : {16, 32, 64, 128}) {
    Surface<D> slave = cap(cells);
    slave.flip();
    // The master goes on beyond the rim.
    const Surface<D> master = graph<D>(grid<K>(-0.68, 0.68, cells + cells / 3, 0.1), random,
                                       [](const Plane<K>& y) { return std::sqrt(1 - dot(y, y)); });
    const auto c = couple<D>(slave.side(), master.side(), within(0.5));
    EXPECT_EQ(c.nodes(), static_cast<Index>(slave.points.size()));
    area_error.push_back(std::abs(total_weight(c) - area));
    double square = 0;
    for (Index p = 0; p < c.nodes(); ++p) square += c.weight[p] * c.gap[p] * c.gap[p];
    gap_error.push_back(std::sqrt(square));
  }
  const auto order = [](const std::vector<double>& error) { return std::log2(error.front() / error.back()) / 3; };
  EXPECT_GT(order(area_error), 1.9);
  EXPECT_GT(order(gap_error), 1.8);
}

// The master covers a strip of the last faces, down to nothing: what is there is exact, or said to be lumped, or left
// out.
TYPED_TEST(Invariance, ThinStripsAreExactOrLumpedOrLeftOut) {
  constexpr int D = TypeParam::value;
  Random random(37);
  Surface<D> slave = flat<D>(grid<D - 1>(0, 1, 4), random);
  slave.flip();
  const std::vector<double> whole = lumped_areas(slave);
  for (double wanted = 1e-2; wanted > 1e-17; wanted /= 3) {
    SCOPED_TRACE(wanted);
    Surface<D> master = flat<D>(grid<D - 1>(-0.1, 1.1, 3), random);
    for (auto& x : master.points) x[0] = x[0] < 0 ? -0.1 : (x[0] + 0.1) / 1.2 * (0.35 + wanted) - 0.1;
    double edge = 0;  // rounded
    for (const auto& x : master.points) edge = std::max(edge, x[0]);
    const double strip = edge - 0.25;
    const auto c = couple<D>(slave.side(), master.side(), within(1));
    double covered = 0;
    for (const double weight : c.weight) {
      EXPECT_GT(weight, 0);
      covered += weight;
    }
    // Nodes of which less than CoupleOptions::least_cover is covered are left out, with that.
    double left_out = 0;
    for (const Index p : c.alone)
      if (slave.points[p][0] < 0.6) left_out += CoupleOptions().least_cover * whole[p];
    EXPECT_LE(covered, edge + 1e-13);
    EXPECT_GE(covered, edge - left_out - 1e-13);
    for (Index p = 0; p < c.nodes(); ++p) {
      const double x = slave.points[c.node[p]][0];
      EXPECT_LE(x, 0.5);
      EXPECT_NEAR(row_value(c, p, [](Index) { return 1.0; }), 1, 1e-12);
      EXPECT_NEAR(c.gap[p], 0, 1e-12);
      if (c.lumped == 0) {
        // Places within the strip are rounded by up to a half epsilon, which is amplified on the way to the far corner.
        const double rounding = std::numeric_limits<double>::epsilon() / 2 / strip;
        EXPECT_NEAR(row_value(c, p, [&](Index q) { return master.points[q][0]; }), x, rounding + 1e-12);
      }
    }
    const bool lumped = c.lumped > 0;
    if (strip > 1e-5) {
      EXPECT_FALSE(lumped);
    }
    if (strip < 1e-7 && strip > 1e-13) {
      EXPECT_TRUE(lumped);
    }
  }
}

}  // namespace
}  // namespace signorini::test
