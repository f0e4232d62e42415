// A plane before something bent: distances and normals are the plane's.
#include "core/mortar/planes.hpp"

#include "tests/core/mortar/surfaces.hpp"

namespace signorini::test {
namespace {

template <class N>
class Planes : public testing::Test {
 protected:
  static constexpr int dim = N::value;
  using Place = Plane<dim - 1>;
  static constexpr double bend = 0.2;

  static double bowl(const Place& y) { return bend * y[0] * y[0]; }

  /// The lower surface of something bent, of 8 cells.
  static Surface<dim> bent() {
    Random random(1);
    Surface<dim> out = graph<dim>(grid<dim - 1>(-1, 1, 8), random, bowl);
    out.flip();
    return out;
  }
  static Surface<dim> plane(double from, double to) {
    Random random(2);
    return graph<dim>(grid<dim - 1>(from, to, 5), random, [](const Place&) { return 0.0; });
  }
  static std::vector<Index> numbers(const Surface<dim>& surface) {
    const mortar::Side<dim> side(surface.side());
    const mortar::Creases<dim> creases(side, 1);
    const mortar::Planes<dim> planes(creases);
    std::vector<Index> out;
    for (Index f = 0; f < std::ssize(surface.faces); ++f) out.push_back(planes.of(f));
    return out;
  }
};
TYPED_TEST_SUITE(Planes, Dimensions);

TYPED_TEST(Planes, GiveTheirNormalsAndDistancesToWhatIsBent) {
  constexpr int D = TypeParam::value;
  Surface<D> slave = this->bent(), master = this->plane(-1.3, 1.2);
  const std::vector<Point<D>> places = slave.points;
  Random random(3);
  const Similarity<D> motion = random_similarity<D>(random, 1e3);
  motion.apply(slave);
  motion.apply(master);
  const mortar::Side<D> side(master.side());
  const auto c = couple<D>(slave.side(), master.side(), within(2e3));
  ASSERT_EQ(c.nodes(), static_cast<Index>(slave.points.size()));
  for (Index p = 0; p < c.nodes(); ++p) {
    for (int k = 0; k < D; ++k) EXPECT_NEAR(c.normal[p][k], -side.normal[0][k], 1e-12);
    // The mean of something linear in a face by dual functions is its value at the node.
    EXPECT_NEAR(c.gap[p] / 1e3, this->bowl({places[c.node[p]][0]}), 1e-9);
  }
}

TYPED_TEST(Planes, LeaveThatItsOwnNormalsWhereTheyEnd) {
  constexpr int D = TypeParam::value;
  const Surface<D> slave = this->bent(), master = this->plane(-0.6, 1.1);
  const auto c = couple<D>(slave.side(), master.side(), within(2));
  for (Index p = 0; p < c.nodes(); ++p) {
    const double x = slave.points[c.node[p]][0];
    if (D == 3 && slave.points[c.node[p]][1] < -0.3) continue;  // it ends there, too
    if (std::abs(x + 0.5) < 1e-9) {
      EXPECT_LT(c.normal[p][0], -0.05);  // of a face whose slope is 0.25
    } else if (std::abs(x) < 0.3) {
      EXPECT_NEAR(c.normal[p][0], 0, 1e-12);
    }
  }
}

TYPED_TEST(Planes, LeaveOtherPlanesTheirs) {
  constexpr int D = TypeParam::value;
  Random random(4);
  Surface<D> slave = graph<D>(grid<D - 1>(-1, 1, 4), random, [](const auto& y) { return 0.3 + 0.1 * y[0]; });
  slave.flip();
  const auto c = couple<D>(slave.side(), this->plane(-2, 2).side(), within(2));
  ASSERT_EQ(c.nodes(), static_cast<Index>(slave.points.size()));
  for (Index p = 0; p < c.nodes(); ++p) EXPECT_NEAR(c.normal[p][0], 0.1 / std::hypot(1, 0.1), 1e-12);
}

TYPED_TEST(Planes, EndAtCreasesAndAreNoFacetsOfWhatIsRound) {
  constexpr int D = TypeParam::value;
  for (const Index plane : this->numbers(this->bent())) EXPECT_EQ(plane, -1);
  Random random(5);
  const Surface<D> roof = graph<D>(grid<D - 1>(-1, 1, 6), random, [](const auto& y) { return -0.4 * std::abs(y[0]); });
  const std::vector<Index> numbers = this->numbers(roof);
  for (std::size_t f = 0; f < numbers.size(); ++f) {
    double middle = 0;
    for (const Index v : roof.faces[f]) middle += roof.points[v][0];
    EXPECT_GE(numbers[f], 0);
    EXPECT_EQ(numbers[f] == numbers.front(), middle < 0);
  }
}

}  // namespace
}  // namespace signorini::test
