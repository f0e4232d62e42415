// Quadratic elements: quadratic functions are reproduced, constant pressures pass, distances of curved faces are those
// of the faces.
#include <gtest/gtest.h>

#include "tests/core/mortar/quadratic_surfaces.hpp"

namespace signorini::test {
namespace {

constexpr double height = 0.03;

template <int D>
struct Pair {
  QuadraticSurface<D> slave, master;
  double covered;
  std::string name;
};

template <int D>
Pair<D> pair(Random& random, std::array<double, 2> on_slave, int slave_cells, std::array<double, 2> on_master,
             int master_cells) {
  constexpr int K = D - 1;
  Surface<D> above = flat<D>(grid<K>(on_slave[0], on_slave[1], slave_cells, 0.2), random, height);
  above.flip();
  const double side = std::min(on_slave[1], on_master[1]) - std::max(on_slave[0], on_master[0]);
  return {quadratic(above), quadratic(flat<D>(grid<K>(on_master[0], on_master[1], master_cells, 0.2), random)),
          std::pow(side, K), std::to_string(slave_cells) + ":" + std::to_string(master_cells)};
}

/// Ratios of mesh sizes from 1 to 7.3, both ways; slave and master overhanging, so that little or much of the slave's
/// last faces is covered.
template <int D>
std::vector<Pair<D>> pairs() {
  Random random(5);
  std::vector<Pair<D>> out;
  using Cells = std::vector<std::array<int, 2>>;
  const Cells cells = D == 2 ? Cells{{4, 4}, {4, 8}, {3, 22}, {8, 4}, {22, 3}, {5, 7}} : Cells{{2, 2}, {1, 7}, {5, 3}};
  for (const double end : {1.0, 0.96, 0.83, 0.78, 0.7})
    for (const auto& [s, m] : cells) {
      out.push_back(pair<D>(random, {-0.31, 1.17}, s, {0, end}, m));
      out.push_back(pair<D>(random, {0, end}, s, {-0.23, 1.41}, m));
    }
  return out;
}

/// Calls check(pair, coupling, motion) for all of them, inclined.
template <int D, class Check>
void each_pair(const Check& check) {
  Random random(2);
  for (Pair<D>& p : pairs<D>()) {
    const Similarity<D> motion = random_similarity<D>(random);
    motion.apply(p.slave.cut);
    motion.apply(p.master.cut);
    for (const Pairing pairing : {Pairing::normal, Pairing::closest}) {
      SCOPED_TRACE(p.name);
      check(p, couple<D>(p.slave.side(), p.master.side(), within(0.1, pairing)), motion);
      if (testing::Test::HasFailure()) return;
    }
  }
}

template <class N>
class Quadratic : public testing::Test {};
TYPED_TEST_SUITE(Quadratic, Dimensions);

/// The value of a row for coefficients on the master, and on the slave where a node of it is in the row.
template <int D>
double row_value(const MortarCoupling<D>& c, Index p, const std::vector<double>& master,
                 const std::vector<double>& slave) {
  double sum = 0;
  for (Offset k = c.row[p]; k < c.row[p + 1]; ++k)
    sum += c.value[k] * (c.is_own(c.column[k]) ? slave : master)[c.column[k]];
  return sum;
}

/// Surfaces with numbers of their own: those of the slave come after those of the master.
template <int D>
void number_apart(Pair<D>& p) {
  const auto first = static_cast<Index>(p.master.cut.points.size());
  std::vector<Point<D>> points = p.master.cut.points;
  points.insert(points.end(), p.slave.cut.points.begin(), p.slave.cut.points.end());
  for (auto& face : p.slave.cut.faces)
    for (Index& v : face) v += first;
  for (auto& ends : p.slave.ends)
    for (Index& v : ends) v += first;
  for (auto& face : p.slave.element)
    for (Index& v : face) v += first;
  p.slave.ends.insert(p.slave.ends.begin(), static_cast<std::size_t>(first), {0, 0});
  p.slave.cut.points = points;
}

TYPED_TEST(Quadratic, RowsReproduceQuadraticFunctions) {
  constexpr int D = TypeParam::value;
  each_pair<D>([](Pair<D> pair, const MortarCoupling<D>&, const Similarity<D>& motion) {
    number_apart(pair);
    const auto c = couple<D>(pair.slave.side(), pair.master.side(), within(0.1));
    ASSERT_GT(c.nodes(), 0);
    Point<D> up{};
    up[D - 1] = height;
    up = motion.turned(up);
    const auto expect_reproduced = [&](const auto& f, double tolerance) {
      const auto above = [&](const Point<D>& x) { return f(difference<D>(x, up)); };
      const std::vector<double> master = pair.master.coefficients(f), slave = pair.slave.coefficients(above);
      for (Index p = 0; p < c.nodes(); ++p) EXPECT_NEAR(row_value(c, p, master, slave), slave[c.node[p]], tolerance);
    };
    // Rounding within what is covered of a face is amplified on the way to its corners, of quadratic functions more so.
    expect_reproduced([](const Point<D>& x) { return 1 + x[0] - 2 * x[1]; }, 1e-10);
    if (c.lumped == 0)
      expect_reproduced([](const Point<D>& x) { return x[0] * x[1] + 3 * x[0] * x[0] - x[1] * x[1]; }, 1e-8);
    for (Index p = 0; p < c.nodes(); ++p) {
      EXPECT_GT(c.weight[p], 0);
      EXPECT_NEAR(c.gap[p], height * c.part(p), 1e-10);
      for (int k = 0; k < D; ++k) EXPECT_NEAR(c.normal[p][k], -up[k] / height, 1e-10);
    }
  });
}

// Forces of a constant pressure are those of its integrals on the master, and on the slave, nodes that are left alone
// counted in; the slave's are opposite.
TYPED_TEST(Quadratic, ForcesOfAConstantPressureBalance) {
  constexpr int D = TypeParam::value;
  each_pair<D>([](Pair<D> pair, const MortarCoupling<D>&, const Similarity<D>&) {
    number_apart(pair);
    const auto c = couple<D>(pair.slave.side(), pair.master.side(), within(0.1));
    std::vector<double> on_master(pair.master.cut.points.size()), on_slave(pair.slave.cut.points.size());
    for (Index p = 0; p < c.nodes(); ++p) {
      on_slave[c.node[p]] += c.weight[p];
      for (Offset k = c.row[p]; k < c.row[p + 1]; ++k)
        if (c.is_own(c.column[k]))
          on_slave[c.column[k]] -= c.weight[p] * c.value[k];
        else
          on_master[c.column[k]] += c.weight[p] * c.value[k];
    }
    const auto total = [](const std::vector<double>& forces) {
      return std::accumulate(forces.begin(), forces.end(), 0.0);
    };
    EXPECT_NEAR(total(on_slave), pair.covered, 1e-12);
    EXPECT_NEAR(total(on_master), pair.covered, 1e-12);
    const auto whole = [&](const QuadraticSurface<D>& surface, const std::vector<double>& forces) {
      const std::vector<double> areas = surface.areas();
      if (total(areas) > pair.covered * (1 + 1e-9)) return;
      for (std::size_t q = 0; q < forces.size(); ++q) EXPECT_NEAR(forces[q], areas[q], 1e-12);
    };
    whole(pair.master, on_master);
    whole(pair.slave, on_slave);
    // A motion of both by any linear field does no work.
    for (int k = 0; k < D; ++k) {
      double work = 0, across = 0;
      for (std::size_t p = 0; p < on_slave.size(); ++p) work += on_slave[p] * pair.slave.cut.points[p][k];
      for (std::size_t q = 0; q < on_master.size(); ++q) work -= on_master[q] * pair.master.cut.points[q][k];
      for (Index p = 0; p < c.nodes(); ++p) across -= c.weight[p] * c.gap[p] * c.normal[p][k];
      EXPECT_NEAR(work, across, 1e-12);
    }
  });
}

// The same mesh on both sides: every row is one node.
TYPED_TEST(Quadratic, TheSameMeshOnBothSidesGivesTheIdentity) {
  constexpr int D = TypeParam::value;
  Random random(7);
  const Surface<D> linear = flat<D>(grid<D - 1>(0, 1, 6, 0.2), random);
  QuadraticSurface<D> master = quadratic(linear), slave = master;
  slave.cut.flip();
  // Flipped parts are those of flipped elements with their corners exchanged.
  constexpr auto& children = RedRefinement<D - 1>::children;
  for (std::size_t e = 0; e < slave.element.size(); ++e) {
    auto& node = slave.element[e];
    std::swap(node[0], node[1]);
    if constexpr (D == 3) std::swap(node[4], node[5]);
    for (std::size_t child = 0; child < children.size(); ++child)
      for (int i = 0; i < D; ++i) slave.cut.faces[e * children.size() + child][i] = node[children[child][i]];
  }
  const auto c = couple<D>(slave.side(), master.side(), within(1));
  EXPECT_EQ(c.nodes(), static_cast<Index>(slave.cut.points.size()));
  for (Index p = 0; p < c.nodes(); ++p)
    for (Offset k = c.row[p]; k < c.row[p + 1]; ++k) EXPECT_NEAR(c.value[k], c.column[k] == c.node[p] ? 1 : 0, 1e-11);
}

/// Largest error of the distance, along the slave's normals, between two round surfaces, and of the normals.
template <int D>
std::array<double, 2> errors(int cells) {
  const double radius = 2, other = 5, apart = 0;
  constexpr int K = D - 1;
  const auto square = [](const auto& y) {
    double sum = 0;
    for (int k = 0; k < K; ++k) sum += y[k] * y[k];
    return sum;
  };
  const auto bottom = [&](const auto& y) { return apart + radius - std::sqrt(radius * radius - square(y)); };
  const auto top = [&](const auto& y) { return std::sqrt(other * other - square(y)) - other; };
  const auto lifted = [](const auto& onto) {
    return [onto](Point<D> x) {
      x[K] = onto(x);
      return x;
    };
  };
  Random random(1);
  Surface<D> above = graph<D>(grid<K>(-0.5, 0.5, cells), random, bottom);
  above.flip();
  const auto slave = quadratic(above, lifted(bottom));
  const auto master = quadratic(graph<D>(grid<K>(-0.8, 0.8, cells + 1), random, top), lifted(top));
  const auto c = couple<D>(slave.side(), master.side(), within(1));
  const auto distance = [&](const Point<D>& x) {  // from the upper one's middle, through x, to the lower ball
    Point<D> n = x;
    n[K] -= apart + radius;
    for (double& v : n) v /= radius;
    Point<D> from = x;
    from[K] += other;
    double b = 0, cc = -other * other;
    for (int k = 0; k < D; ++k) b += n[k] * from[k], cc += from[k] * from[k];
    return -b - std::sqrt(b * b - cc);
  };
  const std::vector<double> exact = slave.coefficients(distance);
  std::array<std::vector<double>, D> normals;
  for (int k = 0; k < D; ++k)
    normals[k] = slave.coefficients([&](const Point<D>& x) { return (x[k] - (k == K ? apart + radius : 0)) / radius; });
  std::array<double, 2> worst{};
  for (Index p = 0; p < c.nodes(); ++p) {
    const Point<D>& x = slave.cut.points[c.node[p]];
    bool inside = true;  // faces at the edge look past the master
    for (int k = 0; k < K; ++k) inside = inside && std::abs(x[k]) < 0.26;
    if (!inside) continue;
    // The mean of the normals, along which the distance is measured, is a little shorter or longer than they are.
    double normal = 0;
    for (int k = 0; k < D; ++k) normal += std::pow(normals[k][c.node[p]], 2);
    worst[0] = std::max(worst[0], std::abs(c.gap[p] - exact[c.node[p]] / std::sqrt(normal)));
    double off = 0;
    for (int k = 0; k < K; ++k) off += std::pow(c.normal[p][k] - x[k] / radius, 2);
    worst[1] = std::max(worst[1], std::sqrt(off));
  }
  return worst;
}

TYPED_TEST(Quadratic, DistancesAndNormalsOfRoundSurfacesAreOfHigherOrder) {
  constexpr int D = TypeParam::value;
  const auto coarse = errors<D>(6), fine = errors<D>(12);
  if (std::getenv("SHOW"))
    std::printf("distance %.2e %.2e, normals %.2e %.2e\n", coarse[0], fine[0], coarse[1], fine[1]);
  EXPECT_LT(fine[0], 2e-5);
  EXPECT_GT(std::log2(coarse[0] / fine[0]), 2.2);
  EXPECT_GT(std::log2(coarse[1] / fine[1]), 1.5);
}

}  // namespace
}  // namespace signorini::test
