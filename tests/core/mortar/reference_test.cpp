// Random pairs of surfaces against the coupling computed by other means; dual functions against a quadrature rule.
#include "tests/core/mortar/reference.hpp"

#include <gtest/gtest.h>

#include "core/mortar/face_integrals.hpp"

namespace signorini::test {
namespace {

template <class N>
class RandomPairs : public testing::Test {};
TYPED_TEST_SUITE(RandomPairs, Dimensions);

template <int D>
void expect_reference(const Surface<D>& slave, const Surface<D>& master, double size) {
  const auto c = couple<D>(slave.side(), master.side(), within(10 * size));
  const Reference<D> reference(slave, master);
  const std::vector<double> whole = lumped_areas(slave);
  std::size_t expected = 0;
  for (const auto& [p, node] : reference.nodes) expected += node.weight > 1e-10 * whole[p];
  EXPECT_EQ(c.node.size(), expected);
  for (Index i = 0; i < c.nodes(); ++i) {
    ASSERT_TRUE(reference.nodes.contains(c.node[i])) << c.node[i];
    const ReferenceNode<D>& node = reference.nodes.at(c.node[i]);
    const double area = whole[c.node[i]];
    EXPECT_NEAR(c.weight[i], node.weight, 1e-12 * area);
    double largest = 1;  // slivers have large weights of both signs
    for (Offset k = c.row[i]; k < c.row[i + 1]; ++k) largest = std::max(largest, std::abs(c.value[k]));
    EXPECT_NEAR(row_value(c, i, [](Index) { return 1.0; }), 1, 1e-14 * largest);
    if (node.condition > 1e8) continue;                       // the reference is no better
    const double tolerance = 1e-12 + 1e-13 * node.condition;  // of the matrices that the reference inverts
    EXPECT_NEAR(c.gap[i], node.gap, tolerance * size);
    for (int k = 0; k < D; ++k) EXPECT_NEAR(c.normal[i][k], node.normal[k], tolerance);
    std::map<Index, double> row;
    for (Offset k = c.row[i]; k < c.row[i + 1]; ++k) row[c.column[k]] = c.value[k];
    for (const auto& [q, value] : node.row) EXPECT_NEAR(row[q], value, tolerance) << node.condition;
    for (const auto& [q, value] : row) EXPECT_NEAR(value, node.row.contains(q) ? node.row.at(q) : 0, tolerance);
  }
}

// Rough surfaces over rectangles of random size and place, one turned against the other. Of every four pairs one has
// its nodes on a lattice, so that nodes lie on nodes and edges on edges; one lies so that next to nothing overlaps.
template <int D>
void try_pair(Random& random, int trial) {
  constexpr int K = D - 1;
  Grid<K> on_slave = grid<K>(0, 1, 1), on_master = on_slave;
  for (int k = 0; k < K; ++k) {
    on_slave.cells[k] = 1 + random.below(4);
    on_master.cells[k] = 2 + random.below(5);  // no plane, of which slaves take the normal
    on_master.from[k] = random.between(-0.5, 0.7);
    on_master.to[k] = on_master.from[k] + random.between(0.2, 1);
  }
  if (trial % 4 == 1)
    for (int k = 0; k < K; ++k) {
      on_slave.cells[k] = 4;
      on_master.from[k] = 0.25 * (random.below(6) - 2);
      on_master.cells[k] = 2 + 2 * random.below(2);
      on_master.to[k] = on_master.from[k] + 1;
    }
  else
    on_slave.jitter = on_master.jitter = 0.2;
  if (trial % 4 == 2) on_master.from[0] = 1 - std::pow(10, random.between(-12, -2)), on_master.to[0] = 1.5;
  double roughness = random.between(0.01, 0.15);  // of the least cell: no face hides another one, and none is a plane
  constexpr double without_edges = 0.02;          // of that, the master's: its faces turn by less than edges do
  for (int k = 0; k < K; ++k)
    for (const Grid<K>& g : {on_slave, on_master})
      if (const double cell = (g.to[k] - g.from[k]) / g.cells[k]; cell < 1) roughness *= cell;
  const auto rough = [&](const Plane<K>&) { return roughness * random.between(-1, 1); };
  const auto less = [&](const Plane<K>& y) { return without_edges * rough(y); };
  Surface<D> slave = graph<D>(on_slave, random, rough), master = graph<D>(on_master, random, less);
  slave.flip();
  if constexpr (D == 3)
    if (trial % 4 == 0) {
      const double angle = random.between(0, 6), c = std::cos(angle), s = std::sin(angle);
      for (auto& x : slave.points) x = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    }
  const Similarity<D> motion = random_similarity<D>(random, std::pow(10, random.between(-5, 5)));
  motion.apply(slave);
  motion.apply(master);
  expect_reference<D>(slave, master, motion.scale);
}

TYPED_TEST(RandomPairs, AreCoupledAsByQuadrature) {
  constexpr int D = TypeParam::value;
  Random random(11);
  for (int trial = 0; trial < (D == 2 ? 2000 : 400) && !testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    try_pair<D>(random, trial);
  }
}

template <class N>
class DualFunctions : public testing::Test {};
TYPED_TEST_SUITE(DualFunctions, Dimensions);

/// Calls use(barycentric, weight) for the points of a rule of degree 5 on a piece of a frame's face.
template <int D, class Use>
void each_point(const mortar::FaceFrame<D>& frame, const mortar::Piece<D - 1>& piece, const Use& use) {
  each_simplex(piece, [&](const std::array<Point<D - 1>, D>& simplex) {
    for (const auto& point : quadrature5<D - 1>()) {
      Point<D - 1> y{};
      for (int i = 0; i < D; ++i)
        for (int k = 0; k < D - 1; ++k) y[k] += point.barycentric[i] * simplex[i][k];
      std::array<double, D> at;
      for (int i = 0; i < D; ++i) at[i] = frame.shape[i](y);
      use(at, point.weight * mortar::signed_measure<D - 1>(simplex));
    }
  });
}

/// Faces covered by random pieces, from all of them to strips of `least` of their width.
template <int D, int P>
void expect_biorthogonal(double least) {
  constexpr int K = D - 1;
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::array<Point<D>, D> corner;
    for (auto& x : corner)
      for (double& c : x) c = random.between(-1, 1);
    Surface<D> face{{corner.begin(), corner.end()}, {{}}};
    std::iota(face.faces[0].begin(), face.faces[0].end(), 0);
    const mortar::Side<D> side(face.side());
    if (side.area[0] < 0.1) continue;
    const mortar::FaceFrame<D> frame(corner, side.normal[0]);
    const double strip = std::pow(least, random.between(0, 1));
    mortar::Affine<K> past = frame.shape[trial % D];
    past.at -= 1 - strip;  // a strip near one corner, or near all of it
    std::vector<mortar::CoveredPoint<K>> covered;
    for (int part = 0; part < 2; ++part) {
      mortar::Affine<K> half = frame.shape[(trial + 1) % D];
      half.at -= K == 1 ? 0.3 * strip : 0.3;
      const auto piece = clipped(clipped(mortar::Piece<K>(frame.corner), past), part ? half : -half);
      if (piece.empty() || measure(piece) <= 1e-13) continue;
      each_point<D>(frame, piece, [&](const auto& at, double weight) { covered.push_back({at, weight}); });
    }
    if (covered.empty()) continue;
    const mortar::DualBasis<K, P> dual(covered);
    EXPECT_FALSE(dual.lumped()) << strip;
    for (std::size_t p = 0; p < dual.nodes; ++p)
      for (std::size_t q = 0; q < dual.nodes; ++q) {
        double sum = 0, size = 0, alone = 0;
        for (const auto& point : covered) {
          const auto phi = basis<P>(point.at);
          const double product = point.weight * dual.share()[p] * dual(point.at)[p] * phi[q];
          sum += product;
          size += std::abs(product);
          alone += point.weight * phi[p];
        }
        EXPECT_GE(dual.share()[p], P == 1 ? 0 : -1);
        EXPECT_NEAR(dual.share()[p], alone, 1e-14);
        EXPECT_NEAR(sum, p == q ? dual.share()[p] : 0, 1e-15 + 1e-12 * size / std::pow(strip, P))
            << trial << " strip " << strip;
      }
  }
}

TYPED_TEST(DualFunctions, AreBiorthogonalToTheTraceBasis) { expect_biorthogonal<TypeParam::value, 1>(1e-5); }
TYPED_TEST(DualFunctions, AreBiorthogonalToTheTraceBasisOfQuadraticElements) {
  expect_biorthogonal<TypeParam::value, 2>(0.01);
}

}  // namespace
}  // namespace signorini::test
