// Two bodies that may touch: their sides, what is in front of what, who is the slave, and which unknowns are jumps.
#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/fem/conditions/paired_nodes.hpp"
#include "core/fem/pairs/added_gap.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/pairs/slave_choice.hpp"
#include "core/mesh/join.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Contact of two bodies, with something added to their distance.
template <int D>
ObstacleTerm<D> touching(std::function<double(const double*)> added = [](const double*) { return 0.0; }) {
  ObstacleTerm<D> out = term<D>(
      [=](const SurfaceVertex& v) {
        std::array<double, D> away;
        std::copy_n(v.away, D, away.begin());
        return bound<D>(away, -(v.gap + added(v.position)), infinity);
      },
      "up/bottom", "obstacle.0");
  out.other = Selection{"low/top", {}, "obstacle.0"};
  return out;
}

/// A unit block over another one with other cells, that far apart.
template <int D>
Mesh<D> blocks(double gap, Index cells = 2, Index cells_below = 3) {
  Mesh<D> up = unit_mesh<D>(cells);
  for (Point<D>& x : up.points) x[D - 1] += 1 + gap;
  return join<D>({unit_mesh<D>(cells_below), std::move(up)}, {"low", "up"}, {0, 0});
}

template <int D>
struct Pair {
  explicit Pair(double gap) : mesh(blocks<D>(gap)), nodes(mesh) { model.obstacles = {touching<D>()}; }
  std::vector<FixedDirections<D>> fixes() const { return collect_fixes<D, D>(nodes, model); }
  PairedFaces faces() const { return paired_faces(mesh, model.obstacles[0], 1); }
  Mesh<D> mesh;
  Nodes<D> nodes;
  Model<D> model;
};

/// A displacement of the upper body alone; of all of it in the same way.
template <int D>
std::vector<double> moved_up(const Pair<D>& pair, std::function<Point<D>(const Point<D>&)> by) {
  std::vector<double> u(pair.mesh.points.size() * D, 0);
  for (Index p = 0; p < pair.mesh.vertices(); ++p)
    if (const Point<D>& x = pair.mesh.points[p]; x[D - 1] > 1 || (x[D - 1] == 1 && p >= unit_mesh<D>(3).vertices()))
      std::ranges::copy(by(x), u.begin() + p * D);
  return u;
}

template <int D>
std::string complaint(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

template <int D>
void expect_sides() {
  const Pair<D> pair(0.1);
  const PairedFaces faces = pair.faces();
  EXPECT_EQ(faces.slave.size(), D == 2 ? 2u : 12u);
  EXPECT_EQ(faces.master.size(), D == 2 ? 3u : 24u);
  EXPECT_TRUE(std::ranges::is_sorted(faces.slave));
  for (const Index f : faces.slave)
    EXPECT_NEAR((centroid<D>(pair.mesh, pair.mesh.boundary[f].vertices)[D - 1]), 1.1, 1e-14);
  const auto all = faces_of_body(pair.mesh, *pair.model.obstacles[0].on, 1);
  for (const Index f : all) EXPECT_GT((centroid<D>(pair.mesh, pair.mesh.boundary[f].vertices)[D - 1]), 1.09);
  EXPECT_TRUE(std::ranges::includes(all, faces.slave));
  EXPECT_FALSE(of_one_body(pair.model.obstacles[0]));
  ObstacleTerm<D> twice = pair.model.obstacles[0];
  twice.other = Selection{"up/top", {}, ""};
  EXPECT_TRUE(of_one_body(twice));
  twice.other = twice.on;
  EXPECT_THAT(complaint<D>([&] { paired_faces(pair.mesh, twice, 1); }),
              AllOf(HasSubstr("obstacle.0"), HasSubstr("1.1")));
  EXPECT_NEAR(longest_edge(pair.mesh, pair.mesh.boundary[faces.slave[0]]), D == 2 ? 0.5 : std::hypot(0.5, 1.0 / 3),
              1e-14);
}

TEST(PairedSides, AreTheFacesOfBothBodies) {
  expect_sides<2>();
  expect_sides<3>();
}

template <int D>
void expect_coupling() {
  const double gap = 0.1;
  const Pair<D> pair(gap);
  const PairedFaces faces = pair.faces();
  const auto found = couple_sides(pair.nodes, pair.model, pair.model.obstacles[0], faces.slave, faces.master);
  EXPECT_EQ(found.nodes(), D == 2 ? 3 : 12);
  for (Index k = 0; k < found.nodes(); ++k) {
    EXPECT_NEAR(found.distance(k), gap, 1e-13);
    EXPECT_NEAR(found.normal[k][D - 1], -1, 1e-14);
  }
  const auto u = moved_up<D>(pair, [](const Point<D>&) {
    Point<D> by{};
    by[D - 1] = 0.25;
    return by;
  });
  const auto points = displaced_points(pair.nodes, u);
  for (Index p = 0; p < pair.mesh.vertices(); ++p)
    EXPECT_NEAR(points[p][D - 1] - pair.mesh.points[p][D - 1], pair.mesh.points[p][D - 1] > 1 ? 0.25 : 0, 1e-15);
  const auto displaced = couple_displaced(pair.nodes, pair.model, 0, u);
  for (Index k = 0; k < displaced.nodes(); ++k) EXPECT_NEAR(displaced.distance(k), gap + 0.25, 1e-13);
}

TEST(PairedSides, SeeEachOtherWhereDisplacementsTakeThem) {
  expect_coupling<2>();
  expect_coupling<3>();
}

template <int D>
void expect_overlap() {
  const Pair<D> pair(-0.05);
  const auto depth = [&](double added) {
    ObstacleTerm<D> term = touching<D>([=](const double*) { return added; });
    const auto found = start_overlap(pair.mesh, term, pair.faces(), 1);
    return found ? found->depth : -1;
  };
  EXPECT_NEAR(depth(0), 0.05, 1e-12);
  EXPECT_NEAR(depth(0.02), 0.03, 1e-12);
  EXPECT_EQ(depth(0.06), 0);
  const auto plain =
      overlap_of_sides<D>(pair.mesh, touching<D>([](const double*) { return 9.0; }), pair.faces(), 1, pair.mesh.points);
  ASSERT_TRUE(plain);
  EXPECT_NEAR(plain->depth, 0.05, 1e-12);
  ObstacleTerm<D> own = touching<D>();
  own.other = Selection{"up/top", {}, ""};
  EXPECT_FALSE(start_overlap(pair.mesh, own, pair.faces(), 1));    // nothing is known of one body
  EXPECT_NO_THROW(refuse_unseen_overlap(pair.nodes, pair.model));  // faces see it
}

TEST(PairedSides, KnowHowDeepBodiesOverlap) {
  expect_overlap<2>();
  expect_overlap<3>();
}

// A thin block stands in another one. Its side looks past all that may touch it.
TEST(PairedSides, RefuseAnOverlapThatNoFacesSee) {
  Mesh<2> up = rectangle({0.4, 0.4}, {0.6, 1.4}, {2, 4});
  const Mesh<2> mesh = join<2>({unit_mesh<2>(3), std::move(up)}, {"low", "up"}, {0, 0});
  Model<2> model;
  model.obstacles = {touching<2>()};
  EXPECT_NO_THROW(refuse_unseen_overlap(Nodes<2>(mesh), model));
  model.obstacles[0].on->part = "up/left";
  const std::string text = complaint<2>([&] { refuse_unseen_overlap(Nodes<2>(mesh), model); });
  EXPECT_THAT(text, AllOf(HasSubstr("obstacle.0"), HasSubstr("overlap at the start")));
}

TEST(FreeNormal, IsWhatFixesLeaveOfANormal) {
  FixedDirections<2> fixed;
  fixed.vertex = 4;
  fixed.count = 1;
  fixed.direction[0][0] = 1;
  fixed.value[0] = 0.5;
  const std::vector<FixedDirections<2>> fixes{fixed};
  EXPECT_EQ(fixed_at(fixes, Index{4}), &fixes[0]);
  EXPECT_EQ(fixed_at(fixes, Index{3}), nullptr);
  const auto whole = free_normal<2>(fixes, 3, {0.6, 0.8});
  EXPECT_EQ(whole->direction, (Point<2>{0.6, 0.8}));
  EXPECT_EQ(whole->part, 1);
  const auto left = free_normal<2>(fixes, 4, {0.6, 0.8});
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->direction[0], 0, 1e-15);
  EXPECT_NEAR(left->direction[1], 1, 1e-15);
  EXPECT_NEAR(left->part, 0.8, 1e-15);
  EXPECT_NEAR(left->prescribed, 0.3, 1e-15);
  EXPECT_FALSE(free_normal<2>(fixes, 4, {-1, 0}));
}

template <int D>
void expect_added_gap() {
  const Pair<D> pair(0.1);
  const auto by_place = touching<D>([](const double* x) { return 0.5 + x[0]; });
  Point<D> normal{};
  normal[D - 1] = -1;
  Point<D> place{};
  place[0] = 0.25;
  EXPECT_NEAR(added_gap<D>(by_place, place, normal), 0.75, 1e-15);
  const PairedFaces faces = pair.faces();
  const std::vector<double> all = added_gaps(pair.nodes, by_place, faces.slave);
  ASSERT_EQ(all.size(), pair.mesh.points.size());
  for (Index v = 0; v < pair.mesh.vertices(); ++v) {
    const Point<D>& x = pair.mesh.points[v];
    EXPECT_NEAR(all[v], std::abs(x[D - 1] - 1.1) < 1e-12 ? 0.5 + x[0] : 0, 1e-14);
  }
  EXPECT_NEAR(added_on_face<D>(pair.mesh, by_place, place, faces.slave[0]), 0.75, 1e-15);
}

TEST(AddedGap, IsWhatTheObstacleAddsToTheDistance) {
  expect_added_gap<2>();
  expect_added_gap<3>();
}

TEST(AddedGap, IsZeroWhereTheObstacleFailsOrBoundsNothing) {
  class Failing final : public TestObstacle<2> {
   public:
    Failing() : TestObstacle<2>({}) {}
    void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<2>* c, Status& status) const noexcept override {
      *c = bound<2>({0, 1}, -7, infinity);
      status.fail(2, "no");
    }
  };
  ObstacleTerm<2> failing;
  failing.obstacle = std::make_shared<Failing>();
  EXPECT_EQ(added_gap<2>(failing, {0, 0}, {0, -1}), 0);
  const auto open = term<2>([](const SurfaceVertex&) { return bound<2>({0, 1}, -infinity, infinity); }, "up/bottom");
  EXPECT_EQ(added_gap<2>(open, {0, 0}, {0, -1}), 0);
}

template <int D>
void expect_pairs() {
  const double gap = 0.1;
  Pair<D> pair(gap);
  const auto pairs = pair_bodies(pair.nodes, pair.model, pair.fixes());
  ASSERT_TRUE(pairs);
  ASSERT_EQ(pairs->nodes.size(), D == 2 ? 3u : 12u);
  const Jumps<D>& jumps = *pairs->jumps;
  ASSERT_EQ(static_cast<std::size_t>(jumps.size()), pairs->nodes.size());
  for (Index k = 0; k < jumps.size(); ++k) {
    const PairedNode<D>& node = pairs->nodes[k];
    EXPECT_EQ(node.node, jumps.vector[k]);
    EXPECT_NEAR(pair.nodes.at(node.node)[D - 1], 1 + gap, 1e-14);
    EXPECT_NEAR(node.away[D - 1], 1, 1e-14);  // from the master to the slave
    EXPECT_NEAR(node.gap, gap, 1e-13);
    EXPECT_NEAR(node.covered, 1, 1e-12);
    // The mean of the master's positions is right below: weights reproduce linear functions.
    Point<D> below{};
    double sum = 0;
    const auto& rows = jumps.inverse;  // u_p - sum w_q u_q
    for (Offset j = rows.row[k]; j < rows.row[k + 1]; ++j) {
      if (rows.column[j] == node.node) continue;
      const double weight = -rows.at(j)[D * D - 1];  // along the last axis
      sum += weight;
      for (int i = 0; i < D; ++i) below[i] += weight * pair.nodes.at(rows.column[j])[i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(below[D - 1], 1, 1e-12);
    EXPECT_NEAR(below[0], pair.nodes.at(node.node)[0], 1e-12);
  }
  Model<D> alone;
  EXPECT_EQ(pair_bodies(pair.nodes, alone, {}), nullptr);
  // One that is moved past the other finds it as far off as before; gaps count from the undeformed bodies on.
  Point<D> shift{};
  shift[D - 1] = -0.05;
  for (const PairedNode<D>& node : pair_bodies(pair.nodes, pair.model, pair.fixes(), {shift})->nodes)
    EXPECT_NEAR(node.gap, gap, 1e-13);
}

TEST(PairBodies, PairsEachNodeWithWhatIsInFrontOfIt) {
  expect_pairs<2>();
  expect_pairs<3>();
}

TEST(PairBodies, LeavesOutWhatIsPrescribed) {
  Pair<2> pair(0);
  pair.model.fixes = {fix<2>("up/left", {0.0, 0.0})};
  EXPECT_EQ(pair_bodies(pair.nodes, pair.model, pair.fixes())->nodes.size(), 2u);
  pair.model.fixes = {fix<2>("up/left", {0.0, std::nullopt})};  // which is across the normal
  EXPECT_EQ(pair_bodies(pair.nodes, pair.model, pair.fixes())->nodes.size(), 3u);
  pair.model.fixes = {fix<2>("up/bottom", {std::nullopt, 0.0})};
  EXPECT_THAT(complaint<2>([&] { pair_bodies(pair.nodes, pair.model, pair.fixes()); }),
              AllOf(HasSubstr("obstacle.0"), HasSubstr("prescribed")));
}

TEST(PairBodies, RefusesBodiesDeepInEachOther) {
  Pair<2> shallow(-0.4), deep(-0.6);  // an element of the slave is 0.5 long
  EXPECT_NO_THROW(pair_bodies(shallow.nodes, shallow.model, {}));
  EXPECT_THAT(complaint<2>([&] { pair_bodies(deep.nodes, deep.model, {}); }), HasSubstr("overlap at the start"));
  deep.model.obstacles[0].resolve = true;
  EXPECT_NO_THROW(pair_bodies(deep.nodes, deep.model, {}));
}

TEST(PairBodies, RefuseWhatTwoObstaclesWithTheSameFacesLose) {
  Pair<2> pair(0);
  pair.model.obstacles.push_back(touching<2>());
  pair.model.obstacles[1].origin = "obstacle.1";
  const auto pairs = pair_bodies(pair.nodes, pair.model, {});
  EXPECT_THAT(complaint<2>([&] { refuse_lost<2>(pair.nodes, pair.model, *pairs); }),
              AllOf(HasSubstr("obstacle.1"), HasSubstr("expected one obstacle with the faces of both")));
}

template <int D>
void expect_slip() {
  const Pair<D> pair(0.1);
  const auto all = pair_bodies(pair.nodes, pair.model, pair.fixes());
  Point<D> way;
  for (int i = 0; i < D; ++i) way[i] = 0.2 - 0.3 * i;
  const auto u = moved_up<D>(pair, [&](const Point<D>&) { return way; });
  const Slip<D> slip = slip_past(pair.nodes, pair.model, 0, *all, *all, u);
  for (int i = 0; i < D; ++i) EXPECT_NEAR(slip.mean[i], way[i], 1e-13);
  EXPECT_NEAR(slip.length, D == 2 ? 0.5 : std::hypot(0.5, 1.0 / 3), 1e-13);
  PairedBodies<D> none;
  none.jumps = std::make_shared<const Jumps<D>>();
  EXPECT_EQ((slip_past(pair.nodes, pair.model, 0, *all, none, u).mean), slip.mean);  // then all count
}

TEST(SlipPast, IsTheWayOfTheSlave) {
  expect_slip<2>();
  expect_slip<3>();
}

// The upper block sinks by more on the left: there it touches.
template <int D>
void expect_near_contact() {
  const Pair<D> pair(0.1);
  const auto all = pair_bodies(pair.nodes, pair.model, pair.fixes());
  const auto sunk = [&](double most) {
    return moved_up<D>(pair, [=](const Point<D>& x) {
      Point<D> by{};
      by[D - 1] = -most * (1 - x[0]);
      return by;
    });
  };
  const auto near = near_contact(pair.nodes, pair.model, *all, sunk(0.1));
  ASSERT_FALSE(near->nodes.empty());
  for (const PairedNode<D>& node : near->nodes) EXPECT_EQ(pair.nodes.at(node.node)[0], 0);
  EXPECT_EQ(static_cast<std::size_t>(near->jumps->size()), near->nodes.size());
  EXPECT_TRUE(same_jumps(*near, *near));
  EXPECT_FALSE(same_jumps(*near, *all));
  EXPECT_EQ(near_contact(pair.nodes, pair.model, *all, sunk(0), all.get())->nodes.size(), all->nodes.size());
  EXPECT_FALSE(touches_elsewhere(pair.nodes, pair.model, *all, *near, sunk(0.15)));  // the middle comes near
  EXPECT_TRUE(touches_elsewhere(pair.nodes, pair.model, *all, *near, sunk(0.25)));   // and through
  EXPECT_FALSE(touches_elsewhere(pair.nodes, pair.model, *all, *all, sunk(0.25)));
  // Other gaps, the same jumps.
  PairedBodies<D> later = *all;
  for (PairedNode<D>& node : later.nodes) node.gap = 0.7;
  EXPECT_TRUE(same_jumps(later, *all));
  const auto renewed = with_new_gaps(later, *near);
  EXPECT_TRUE(same_jumps(*renewed, *near));
  EXPECT_EQ(renewed->jumps, near->jumps);
  for (const PairedNode<D>& node : renewed->nodes) EXPECT_EQ(node.gap, 0.7);
  later.nodes[0].away[0] = 0.1;
  EXPECT_FALSE(same_jumps(later, *all));
}

TEST(NearContact, IsWhereADisplacementTouches) {
  expect_near_contact<2>();
  expect_near_contact<3>();
}

/// Which of the blocks is chosen.
struct Choice {
  explicit Choice(Index cells = 2, Index cells_below = 2) : mesh(blocks<2>(0, cells, cells_below)) {
    model.obstacles = {touching<2>()};
    model.obstacles[0].slave = Slave::automatic;
  }
  SlaveChoice choose() const { return choose_slaves(Nodes<2>(mesh), model).at(0); }
  void set_moduli(double low, double up) {
    model.young = expression([=](const Site& s) { return s.x[1] < 1 ? low : up; });
  }
  Mesh<2> mesh;
  Model<2> model;
};

TEST(SlaveChoice, IsTheSofterBody) {
  for (const double factor : {3.0, 100.0}) {
    Choice c(2, 4);
    c.set_moduli(factor, 1);
    EXPECT_FALSE(c.choose().exchanged);
    EXPECT_THAT(c.choose().reason, AllOf(HasSubstr("softer"), HasSubstr("modulus 1 beside")));
    c.set_moduli(1, factor);
    EXPECT_TRUE(c.choose().exchanged);
  }
}

TEST(SlaveChoice, IsTheFinerBodyWhereModuliAreAlike) {
  Choice coarse_up(2, 4), fine_up(4, 2), same;
  coarse_up.set_moduli(1.5, 1);
  fine_up.set_moduli(1, 1.5);
  EXPECT_TRUE(coarse_up.choose().exchanged);
  EXPECT_FALSE(fine_up.choose().exchanged);
  EXPECT_THAT(fine_up.choose().reason, HasSubstr("finer"));
  EXPECT_FALSE(same.choose().exchanged);  // the first one
  same.set_moduli(1, 1.5);
  EXPECT_TRUE(same.choose().exchanged);  // what little there is decides
}

TEST(SlaveChoice, IsNoBodyThatIsPrescribedOrTaken) {
  Choice c;
  c.set_moduli(10, 1);
  c.model.fixes = {fix<2>("up/bottom", {0.0, 0.0})};
  EXPECT_TRUE(c.choose().exchanged);
  EXPECT_THAT(c.choose().reason, HasSubstr("prescribed"));
  c.model.fixes.clear();
  c.model.obstacles.push_back(term<2>(
      [](const SurfaceVertex&) {
        return bound<2>({1, 0}, -1, infinity);
      },
      "up/left", "obstacle.1"));
  EXPECT_TRUE(c.choose().exchanged);
  EXPECT_THAT(c.choose().reason, HasSubstr("obstacle.1"));
}

// A wedge whose side is in front of the other body up to its upper end, which is held.
TEST(SlaveChoice, DoesNotMindWhatIsPrescribedFarFromContact) {
  for (const double slope : {0.0, 1.0}) {
    Choice c(8, 2);
    for (Index v = unit_mesh<2>(2).vertices(); v < c.mesh.vertices(); ++v) {
      Point<2>& x = c.mesh.points[v];
      x[0] = 0.6 + 0.4 * x[0];  // narrower than the other body, which is below all of it
      x[1] += slope * (1 - x[0]);
    }
    c.model.fixes = {fix<2>("up/left", {0.0, 0.0})};
    EXPECT_EQ(c.choose().exchanged, slope == 0) << slope;
  }
}

TEST(SlaveChoice, IsWhatTheSceneSaysAndExchangesSides) {
  Choice c;
  c.set_moduli(10, 1);
  c.model.obstacles[0].slave = Slave::other;
  EXPECT_TRUE(c.choose().exchanged);
  c.model.obstacles[0].slave = Slave::body;
  EXPECT_FALSE(c.choose().exchanged);
  c.model.obstacles.push_back(term<2>([](const SurfaceVertex&) { return LocalConstraint<2>{}; }, "up/left"));
  const auto choices = choose_slaves(Nodes<2>(c.mesh), c.model);
  EXPECT_EQ(choices.at(1).reason, "");
  Model<2> model = c.model;
  exchange_sides({{true, ""}, {false, ""}}, model);
  EXPECT_EQ(*model.obstacles[0].on->part, "low/top");
  EXPECT_EQ(*model.obstacles[0].other->part, "up/bottom");
  EXPECT_EQ(*model.obstacles[1].on->part, "up/left");
}

TEST(PrescribedNodes, AreCountedByWhatIsPrescribed) {
  Pair<2> pair(0);
  pair.model.fixes = {fix<2>("up/left", {0.0, 0.0}), fix<2>("up/right", {0.0, std::nullopt})};
  const PairedFaces faces = pair.faces();
  const auto coupling = couple_sides(pair.nodes, pair.model, pair.model.obstacles[0], faces.slave, faces.master);
  const PrescribedNodes found = prescribed_nodes(pair.nodes, pair.fixes(), faces.slave, coupling);
  EXPECT_EQ(found.all, 3);
  EXPECT_EQ(found.normal, 1);
  EXPECT_EQ(found.some, 2);
  EXPECT_TRUE(found.without_friction());
  EXPECT_FALSE((PrescribedNodes{4, 0, 2}.without_friction()));
}

// Nodes that a fix holds along the surface are left out with friction, their share is their neighbours'.
TEST(PairedSides, WithFrictionLeaveOutWhatCannotSlide) {
  Pair<2> pair(0);
  const ObstacleTerm<2>& term = pair.model.obstacles[0];
  const PairedFaces faces = pair.faces();
  pair.model.fixes = {fix<2>("up/left", {0.01, std::nullopt})};
  Index lost = -1;
  const auto all = couple_sides(pair.nodes, pair.model, term, faces.slave, faces.master);
  const auto some = couple_whole_jumps<2>(pair.nodes, pair.model, term, faces, pair.fixes(), {}, {}, &lost);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(some.nodes(), all.nodes() - 1);
  double area = 0, whole = 0;  // own areas, and what is taken over
  for (Index k = 0; k < some.nodes(); ++k) area += some.weight[k] * (1 + some.taken[k] / some.covered[k]);
  for (const double w : all.weight) whole += w;
  EXPECT_NEAR(area, whole, 1e-13);
  pair.model.fixes = {fix<2>("up/bottom", {0.01, std::nullopt})};  // all of them: nobody is left to take over
  couple_whole_jumps<2>(pair.nodes, pair.model, term, faces, pair.fixes(), {}, {}, &lost);
  EXPECT_EQ(lost, 3);
}

}  // namespace
}  // namespace signorini::testing
