// Flat interfaces: linear functions are reproduced, forces and moments balance, areas are exact, whatever the meshes.
#include <gtest/gtest.h>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"
#include "tests/core/mortar/surfaces.hpp"

namespace signorini::test {
namespace {

template <int D>
struct Pair {
  Surface<D> slave, master;
  double gap;      ///< of the slave above the master
  double covered;  ///< area
  std::string name;
};

// A slave over [a, b]^K above a master over [c, d]^K.
template <int D>
Pair<D> pair(Random& random, std::array<double, 2> on_slave, int slave_cells, std::array<double, 2> on_master,
             int master_cells, double jitter) {
  constexpr int K = D - 1;
  Pair<D> out{flat<D>(grid<K>(on_slave[0], on_slave[1], slave_cells, jitter), random, 0.03),
              flat<D>(grid<K>(on_master[0], on_master[1], master_cells, jitter), random), 0.03, 0,
              std::to_string(slave_cells) + ":" + std::to_string(master_cells)};
  out.slave.flip();
  const double side = std::min(on_slave[1], on_master[1]) - std::max(on_slave[0], on_master[0]);
  out.covered = std::pow(side, K);
  return out;
}

// Ratios of mesh sizes from 1 to 7.3, both ways; the same rectangle, slave and master overhanging, and both.
template <int D>
std::vector<Pair<D>> pairs(Random& random) {
  std::vector<Pair<D>> out;
  const std::vector<std::array<int, 2>> cells{{4, 4}, {4, 8}, {10, 73}, {8, 4}, {73, 10}, {5, 7}};
  const std::vector<std::array<std::array<double, 2>, 2>> places{
      {{{0, 1}, {0, 1}}}, {{{-0.31, 1.17}, {0, 1}}}, {{{0, 1}, {-0.23, 1.41}}}, {{{0, 1}, {0.37, 1.6}}}};
  for (const auto& [on_slave, on_master] : places)
    for (const auto& [s, m] : cells)
      for (const double jitter : {0.0, 0.2})
        if (D == 2 || s * m < 200 || jitter > 0) out.push_back(pair<D>(random, on_slave, s, on_master, m, jitter));
  return out;
}

template <int D>
class FlatInterface : public testing::Test {
 protected:
  // Calls check(pair, coupling, motion) for every pair as it is, inclined and far away, with both pairings.
  template <class Check>
  void each(const Check& check) {
    Random random(5);
    for (Pair<D>& p : pairs<D>(random)) {
      for (const double scale : {1.0, 1e-6}) {
        Pair<D> moved = p;
        const Similarity<D> motion = scale == 1 ? Similarity<D>{} : random_similarity<D>(random, scale);
        motion.apply(moved.slave);
        motion.apply(moved.master);
        moved.gap *= scale;
        moved.covered *= std::pow(scale, D - 1);
        for (const Pairing pairing : {Pairing::normal, Pairing::closest}) {
          SCOPED_TRACE(p.name);
          const auto c = couple<D>(moved.slave.side(), moved.master.side(), within(0.1 * scale, pairing));
          check(moved, c, motion);
          if (testing::Test::HasFailure()) return;
        }
      }
    }
  }
};

template <class N>
class Flat : public FlatInterface<N::value> {};
TYPED_TEST_SUITE(Flat, Dimensions);

TYPED_TEST(Flat, RowsReproduceLinearFunctions) {
  constexpr int D = TypeParam::value;
  this->each([](const Pair<D>& pair, const MortarCoupling<D>& c, const Similarity<D>& motion) {
    ASSERT_GT(c.nodes(), 0);
    Point<D> up{};
    up[D - 1] = 1;
    up = motion.turned(up);
    const std::vector<double> whole = lumped_areas(pair.slave);
    for (Index p = 0; p < c.nodes(); ++p) {
      EXPECT_NEAR(row_value(c, p, [](Index) { return 1.0; }), 1, 1e-14);
      // Where next to nothing of a face is covered rounding of the points themselves is amplified on the way to its
      // corners.
      const double cover = c.weight[p] / whole[c.node[p]];
      const double tolerance = motion.scale * std::max(1e-12, 2e-14 / std::sqrt(cover));
      for (int k = 0; k < D; ++k) {
        const double here = pair.slave.points[c.node[p]][k] - pair.gap * up[k];
        EXPECT_NEAR(row_value(c, p, [&](Index q) { return pair.master.points[q][k]; }), here, tolerance);
        EXPECT_NEAR(c.normal[p][k], -up[k], 1e-13);
      }
      EXPECT_NEAR(c.gap[p], pair.gap, tolerance) << cover;
    }
  });
}

TYPED_TEST(Flat, WeightsArePositiveAndTheirSumIsTheCoveredArea) {
  constexpr int D = TypeParam::value;
  this->each([](const Pair<D>& pair, const MortarCoupling<D>& c, const Similarity<D>&) {
    for (const double weight : c.weight) EXPECT_GT(weight, 0);
    EXPECT_NEAR(total_weight(c), pair.covered, 1e-12 * pair.covered);
    EXPECT_EQ(c.deepest.depth, 0);
    EXPECT_EQ(c.layered, 0);
    EXPECT_EQ(c.lumped, 0);
  });
}

// A constant pressure: the forces on both sides are opposite, so are their moments, and where the slave covers all of
// the master those on it are what the pressure on its own faces is.
TYPED_TEST(Flat, ForcesOfAConstantPressureBalance) {
  constexpr int D = TypeParam::value;
  this->each([](const Pair<D>& pair, const MortarCoupling<D>& c, const Similarity<D>& motion) {
    std::vector<double> on_master(pair.master.points.size());
    Eigen::Matrix<double, D, 1> slave_middle, master_middle;
    slave_middle.setZero(), master_middle.setZero();
    double on_slave = 0;
    for (Index p = 0; p < c.nodes(); ++p) {
      on_slave += c.weight[p];
      for (int k = 0; k < D; ++k) slave_middle[k] += c.weight[p] * pair.slave.points[c.node[p]][k];
      for (Offset k = c.row[p]; k < c.row[p + 1]; ++k) on_master[c.column[k]] += c.weight[p] * c.value[k];
    }
    double sum = 0, smallest = 0;
    for (std::size_t q = 0; q < on_master.size(); ++q) {
      sum += on_master[q];
      smallest = std::min(smallest, on_master[q]);
      for (int k = 0; k < D; ++k) master_middle[k] += on_master[q] * pair.master.points[q][k];
    }
    EXPECT_NEAR(sum, on_slave, 1e-13 * on_slave);
    EXPECT_GE(smallest, -1e-14 * on_slave);
    Eigen::Matrix<double, D, 1> up = motion.rotation.col(D - 1);
    const Eigen::Matrix<double, D, 1> arm = (slave_middle - master_middle) / on_slave - pair.gap * up;
    EXPECT_LE(arm.norm(), 1e-12 * motion.scale);
    const std::vector<double> alone = lumped_areas(pair.master);
    const double whole = std::accumulate(alone.begin(), alone.end(), 0.0);
    if (whole > pair.covered * (1 + 1e-9)) return;
    for (std::size_t q = 0; q < on_master.size(); ++q) EXPECT_NEAR(on_master[q], alone[q], 1e-13 * whole);
  });
}

// The same mesh on both sides: every row is one node.
TYPED_TEST(Flat, TheSameMeshOnBothSidesGivesTheIdentity) {
  constexpr int D = TypeParam::value;
  Random random(7);
  Surface<D> slave = flat<D>(grid<D - 1>(0, 1, 6, 0.2), random), master = slave;
  slave.flip();
  const Similarity<D> motion = random_similarity<D>(random, 3e4);
  motion.apply(slave);
  motion.apply(master);
  const auto c = couple<D>(slave.side(), master.side(), within(1));
  EXPECT_EQ(c.nodes(), static_cast<Index>(slave.points.size()));
  for (Index p = 0; p < c.nodes(); ++p)
    for (Offset k = c.row[p]; k < c.row[p + 1]; ++k) EXPECT_NEAR(c.value[k], c.column[k] == c.node[p] ? 1 : 0, 1e-11);
}

}  // namespace
}  // namespace signorini::test
