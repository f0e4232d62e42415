// From what obstacles say at nodes to bounds of coefficients, and what a single node makes of several of them.
#include "core/fem/conditions/bounds.hpp"

#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/constraints/bound_combiner.hpp"
#include "core/constraints/local_problem.hpp"
#include "core/fem/conditions/bound_bends.hpp"
#include "core/fem/conditions/bound_coefficients.hpp"
#include "core/fem/conditions/model_places.hpp"
#include "core/mesh/refine.hpp"
#include "core/sdk/given_friction.hpp"
#include "core/sdk/given_friction_solver.hpp"
#include "core/solver/functional.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A lower bound as a function of the place, along the last axis.
template <int B>
ObstacleTerm<B> floor(std::function<double(const double*)> lower, std::optional<std::string> part = "bottom") {
  std::array<double, B> up{};
  up[B - 1] = 1;
  return term<B>([=](const SurfaceVertex& v) { return bound<B>(up, lower(v.position), infinity); }, part);
}

template <int D, int B>
std::vector<Bound<B>> collected(const Nodes<D>& nodes, const Model<B>& model) {
  std::vector<FunctionalNumbers<B>> numbers;
  return collect_bounds(nodes, model, numbers);
}

template <int D, int B>
std::string complaint(const Mesh<D>& mesh, const Model<B>& model, Exit status) {
  try {
    collected(Nodes<D>(mesh), model);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    return error.what();
  }
  return "";
}

template <int D>
void expect_collected() {
  const Mesh<D> mesh = unit_mesh<D>(2);
  const Nodes<D> nodes(mesh);
  Model<D> model;
  model.obstacles = {floor<D>([](const double* x) { return x[0] > 0.75 ? -infinity : -x[0]; }),
                     floor<D>([](const double*) { return -1.0; }, "left")};
  std::size_t of_bottom = 0, of_left = 0;
  for (const Point<D>& x : mesh.points) of_bottom += x[D - 1] == 0 && x[0] < 0.75, of_left += x[0] == 0;
  const std::vector<Bound<D>> bounds = collected(nodes, model);
  EXPECT_EQ(bounds.size(), of_bottom + of_left);  // those that are infinite on both sides are no bounds
  EXPECT_TRUE(std::ranges::is_sorted(bounds, {}, &Bound<D>::vertex));
  for (const Bound<D>& b : bounds) {
    EXPECT_EQ(b.lower, b.obstacle == 0 ? -nodes.at(b.vertex)[0] : -1);
    EXPECT_EQ(b.upper, infinity);
    EXPECT_EQ(b.data, -1);
  }
}

TEST(Bounds, AreThoseOfAllObstaclesByAscendingNode) {
  expect_collected<2>();
  expect_collected<3>();
}

TEST(Bounds, ThatNothingSatisfiesAreNoSolution) {
  const Mesh<2> mesh = unit_mesh<2>(1);
  Model<1> model;
  model.obstacles = {floor<1>([](const double*) { return infinity; })};
  EXPECT_THAT(complaint(mesh, model, Exit::no_solution), AllOf(HasSubstr("obstacle.0"), HasSubstr("(0, 0)")));
}

TEST(Bounds, OfAnObstacleThatFailsAreItsError) {
  class Failing final : public TestObstacle<1> {
   public:
    Failing() : TestObstacle<1>({}) {}
    void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<1>*, Status& status) const noexcept override {
      status.fail(static_cast<int>(Exit::input), "knows nothing");
    }
  };
  Model<1> model;
  model.obstacles = {{std::make_shared<Failing>(), {}, "obstacle.7"}};
  EXPECT_THAT(complaint(unit_mesh<2>(1), model, Exit::input), AllOf(HasSubstr("obstacle.7"), HasSubstr("nothing")));
}

/// Bounds of one node and what is prescribed there, combined.
struct Combined {
  explicit Combined(std::vector<Bound<2>> some, std::optional<FixedDirections<2>> fixed = {})
      : bounds(std::move(some)), fixes(fixed ? std::vector{*fixed} : std::vector<FixedDirections<2>>()) {
    for (std::size_t k = 0; k < 9; ++k) model.obstacles.push_back(floor<2>([](const double*) { return 0.0; }));
    combiner.emplace(places, bounds, fixes);
    out = combiner->combine(bounds.data(), bounds.data() + bounds.size(), fixes.empty() ? nullptr : fixes.data(), held);
  }
  const Mesh<2> mesh = unit_mesh<2>(1);
  const Nodes<2> nodes{mesh};
  Model<2> model;
  std::vector<Bound<2>> bounds, held;
  std::vector<FixedDirections<2>> fixes;
  const ModelPlaces<2, 2> places{nodes, model};
  std::optional<BoundCombiner<2>> combiner;
  std::vector<CombinedBound<2>> out;
};

FixedDirections<2> fixed_along(const std::array<double, 2>& d, double value) {
  FixedDirections<2> out;
  out.count = 1;
  std::ranges::copy(d, out.direction[0]);
  out.value[0] = value;
  return out;
}

TEST(BoundCombiner, IntersectsBoundsAlongOneLine) {
  const Combined c({{0, 0, {0.6, 0.8}, -1, 5}, {0, 1, {-0.6, -0.8}, -3, 0.5}});
  ASSERT_EQ(c.out.size(), 1u);
  const double sign = c.out[0].direction[1] > 0 ? 1 : -1;
  const double lower = sign > 0 ? c.out[0].lower : -c.out[0].upper, upper = sign > 0 ? c.out[0].upper : -c.out[0].lower;
  EXPECT_EQ(lower, -0.5);
  EXPECT_EQ(upper, 3);
  EXPECT_EQ(sign > 0 ? c.out[0].lower_obstacle : c.out[0].upper_obstacle, 1);  // each bound knows whose it is
  EXPECT_EQ(sign > 0 ? c.out[0].upper_obstacle : c.out[0].lower_obstacle, 1);
  EXPECT_TRUE(c.combiner->facets().empty());
}

TEST(BoundCombiner, TakesTheNearestIndependentDirectionsAsCoordinates) {
  const Combined c({{0, 0, {0, 1}, -3, infinity}, {0, 1, {1, 0}, -1, infinity}, {0, 2, {0.6, 0.8}, -2, infinity}});
  ASSERT_EQ(c.out.size(), 2u);
  EXPECT_EQ(c.out[0].lower_obstacle, 1);
  EXPECT_EQ(c.out[1].lower_obstacle, 2);
  ASSERT_EQ(c.combiner->facets().size(), 1u);  // a plane has no third one
  EXPECT_EQ(c.combiner->facets()[0].lower_obstacle, 0);
}

// The limit is 0.02 of a direction's length.
TEST(BoundCombiner, LeavesNearlyParallelDirectionsToFaces) {
  for (const double angle : {0.019, 0.021}) {
    const Combined c({{0, 0, {0, 1}, -1, infinity}, {0, 1, {std::sin(angle), std::cos(angle)}, -2, infinity}});
    EXPECT_EQ(c.out.size(), angle > 0.02 ? 2u : 1u);
    EXPECT_EQ(c.combiner->facets().size(), angle > 0.02 ? 0u : 1u);
  }
}

// 0.6 x + 0.8 y >= -1 with x = 0.5 leaves y >= -1.3 / 0.8.
TEST(BoundCombiner, ReducesBoundsToWhatIsFree) {
  const Combined c({{0, 0, {0.6, 0.8}, -1, 2}}, fixed_along({1, 0}, 0.5));
  ASSERT_EQ(c.out.size(), 1u);
  EXPECT_NEAR(c.out[0].direction[0], 0, 1e-15);
  EXPECT_NEAR(c.out[0].direction[1], 1, 1e-15);
  EXPECT_NEAR(c.out[0].lower, -1.3 / 0.8, 1e-14);
  EXPECT_NEAR(c.out[0].upper, 1.7 / 0.8, 1e-14);
  EXPECT_TRUE(c.held.empty());
}

TEST(BoundCombiner, HoldsWhatIsPrescribedAtTheBound) {
  const Combined touching({{0, 0, {0, 1}, -0.25, infinity}}, fixed_along({0, 1}, -0.25));
  EXPECT_TRUE(touching.out.empty());
  ASSERT_EQ(touching.held.size(), 1u);
  EXPECT_EQ(touching.held[0].lower, -0.25);
  EXPECT_TRUE(Combined({{0, 0, {0, 1}, -0.25, infinity}}, fixed_along({0, 1}, 0.1)).held.empty());
}

TEST(BoundCombiner, RefusesContradictions) {
  EXPECT_THROW(Combined({{0, 0, {0, 1}, -0.25, infinity}}, fixed_along({0, 1}, -0.3)), Error);
  EXPECT_THROW(Combined({{0, 0, {0, 1}, 1, infinity}, {0, 1, {0, -1}, 1, infinity}}), Error);
  // Three half planes: two of them leave something, all leave nothing.
  const Bound<2> a{0, 0, {1, 0}, 1, infinity}, b{0, 1, {0, 1}, 1, infinity},
      c{0, 2, {-std::sqrt(0.5), -std::sqrt(0.5)}, -1, infinity};
  EXPECT_NO_THROW(Combined({a, b}));
  EXPECT_NO_THROW(Combined({a, c}));
  EXPECT_THROW(Combined({a, b, c}), Error);
}

/// A quadratic body over a lower bound; its nodes, and the bounds there.
template <int D>
struct Quadratic {
  explicit Quadratic(std::function<double(const double*)> lower)
      : meshes(hierarchy(unit_mesh<D>(2), 1)), nodes(meshes.finest(), 2) {
    model.obstacles = {floor<1>(lower)};
    bounds = collected(nodes, model);
  }
  MeshHierarchy<D> meshes;
  Nodes<D> nodes;
  Model<1> model;
  std::vector<Bound<1>> bounds;
};

double smooth(const double* x) { return 1 - 2 * x[0] + 3 * x[0] * x[0]; }

template <int D>
void expect_bends() {
  const Quadratic<D> q(smooth);
  const auto bends = bound_bends(q.nodes, q.model, q.bounds);
  ASSERT_EQ(bends.size(), q.bounds.size());
  int midpoints = 0;
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const auto [a, b] = q.nodes.ends(q.bounds[k].vertex);
    const double way = q.nodes.at(a)[0] - q.nodes.at(b)[0];
    EXPECT_NEAR(bends[k].lower, 3 * way * way / 2, 1e-13);  // second difference of 3 x^2
    EXPECT_EQ(bends[k].upper, 0);
    midpoints += a != b;
  }
  EXPECT_GT(midpoints, 0);
}

TEST(BoundBends, AreSecondDifferencesOfSmoothBounds) {
  expect_bends<2>();
  expect_bends<3>();
}

// A kink, or a jump, within the first of two edges: there it is no quadratic function.
TEST(BoundBends, KnowNoKinksAndJumps) {
  for (const double at : {0.1, 0.2, 0.3})
    for (const bool jumps : {false, true}) {
      const Quadratic<2> q([=](const double* x) { return x[0] < at ? 0.0 : jumps ? 1.0 : x[0] - at; });
      for (const BoundBend& bend : bound_bends(q.nodes, q.model, q.bounds)) EXPECT_EQ(bend.lower, 0) << at << jumps;
    }
}

// Where halves of an edge bend otherwise than all of it the bend is at most twice theirs, scaled by length.
TEST(BoundBends, AreAtMostTwiceThoseOfAPart) {
  const auto steep = [](double x) { return std::exp(12 * x); };
  const Quadratic<2> q([=](const double* x) { return steep(x[0]); });
  const auto bends = bound_bends(q.nodes, q.model, q.bounds);
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const auto [a, b] = q.nodes.ends(q.bounds[k].vertex);
    if (a == b) continue;
    const double from = std::min(q.nodes.at(a)[0], q.nodes.at(b)[0]);  // it bends least there
    const double whole = steep(from) - 2 * steep(from + 0.25) + steep(from + 0.5),
                 part = 4 * (steep(from) - 2 * steep(from + 0.125) + steep(from + 0.25));
    EXPECT_LT(2 * part, 0.5 * whole);
    EXPECT_NEAR(bends[k].lower, 2 * part, 1e-12 * whole);
  }
}

TEST(BoundBends, AreZeroWhereAnEndHasNoBound) {
  const Quadratic<2> q([](const double* x) { return x[0] == 0 ? -infinity : smooth(x); });
  const auto bends = bound_bends(q.nodes, q.model, q.bounds);
  int none = 0, some = 0;
  for (std::size_t k = 0; k < bends.size(); ++k) {
    const auto [a, b] = q.nodes.ends(q.bounds[k].vertex);
    if (a != b) ++(q.nodes.at(a)[0] == 0 || q.nodes.at(b)[0] == 0 ? none : some);
    EXPECT_EQ(bends[k].lower != 0, a != b && q.nodes.at(a)[0] != 0 && q.nodes.at(b)[0] != 0);
  }
  EXPECT_EQ(none, 1);
  EXPECT_EQ(some, 1);
}

// The function with the bounds as coefficients is the obstacle at all nodes.
template <int D>
void expect_coefficients() {
  const Quadratic<D> q(smooth);
  std::vector<Bound<1>> bounds = q.bounds;
  bound_coefficients<D, 1>(q.nodes, q.model, {}, bounds);
  std::vector<double> coefficient(q.nodes.size());
  for (const Bound<1>& b : bounds) coefficient[b.vertex] = b.lower;
  const std::vector<double> value = q.nodes.at_vertices(coefficient, 1);
  for (const Bound<1>& b : bounds)
    EXPECT_NEAR(value[q.nodes.vertex(b.vertex)], smooth(q.nodes.at(b.vertex).data()), 1e-13);
}

TEST(BoundCoefficients, MakeTheQuadraticFunctionThroughTheBounds) {
  expect_coefficients<2>();
  expect_coefficients<3>();
}

TEST(BoundCoefficients, OfLinearElementsAreTheBounds) {
  const Mesh<2> mesh = unit_mesh<2>(4);
  Model<1> model;
  model.obstacles = {floor<1>(smooth)};
  std::vector<Bound<1>> bounds = collected(Nodes<2>(mesh), model);
  bound_coefficients<2, 1>(Nodes<2>(mesh), model, {}, bounds);
  for (const Bound<1>& b : bounds) EXPECT_EQ(b.lower, smooth(mesh.points[b.vertex].data()));
}

// What is prescribed above the obstacle is as far above it as a coefficient, however the obstacle bends.
TEST(BoundCoefficients, KeepTheirDistanceToWhatIsPrescribed) {
  const Quadratic<2> q(smooth);
  std::vector<FixedDirections<1>> fixes;
  std::vector<double> value(q.nodes.size());
  const auto prescribed = [](const Point<2>& x) { return 2 + std::sin(4 * x[0]); };
  for (Index p = 0; p < q.nodes.size(); ++p) {
    FixedDirections<1> fixed;
    fixed.vertex = p;
    fixed.count = 1;
    fixed.direction[0][0] = 1;
    fixed.value[0] = q.nodes.coefficient(p, [&](Index k) { return prescribed(q.nodes.at(k)); });
    fixes.push_back(fixed);
  }
  std::vector<Bound<1>> bounds = q.bounds;
  bound_coefficients<2, 1>(q.nodes, q.model, fixes, bounds);
  for (const Bound<1>& b : bounds)
    EXPECT_NEAR(fixes[b.vertex].value[0] - b.lower,
                prescribed(q.nodes.at(b.vertex)) - smooth(q.nodes.at(b.vertex).data()), 1e-13);
}

/// Friction with the bound 0.3 on what slides along x, above y = -0.1.
class Sliding final : public FunctionalObstacle<2, GivenFriction<2>, GivenFrictionSolver<2>, GivenFrictionModel<2>> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {2, {{"normal", 2, 1}, {"tangential", 1, 1}}, 1}; }
  void assemble(const SurfaceVertex*, std::size_t count, LocalConstraint<2>* out, Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      out[k] = bound<2>({0, 1}, -0.1, infinity);
      out[k].data[0] = 0.3;
    }
  }
};

class OfOneNode : public ::testing::Test {
 protected:
  OfOneNode() {
    model_.poisson = 0.2;
    model_.obstacles = {{std::make_shared<Sliding>(), Selection{"bottom", {}, ""}, "obstacle.0"}};
    discretization_ = discretize(mesh_, model_);
    const DiscreteProblem<2>& problem = discretization_.problem;
    local_.emplace(*model_.obstacles[0].obstacle, functional::view(problem), 1);
    M_ = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
        problem.A.diagonal(problem.constraints.vector[1]));
  }
  /// Local coordinates: across the obstacle first.
  double energy(const std::array<double, 2>& v, const std::array<double, 2>& x, const std::array<double, 2>& r) const {
    const Eigen::Vector2d d(v[0] - x[0], v[1] - x[1]);
    return 0.5 * d.dot(M_ * d) - r[0] * d[0] - r[1] * d[1] + 0.3 * std::abs(v[1]);
  }

  const Mesh<2> mesh_ = unit_mesh<2>(3);
  Model<2> model_;
  Discretization<2> discretization_;
  std::optional<LocalProblem<2>> local_;
  Eigen::Matrix2d M_;
};

TEST_F(OfOneNode, TheMinimiserHasLessEnergyThanAllAround) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  int stuck = 0, pressed = 0;
  for (int k = 0; k < 200; ++k) {
    const std::array<double, 2> x{0.1 * std::abs(any(random)), 0.2 * any(random)}, r{any(random), any(random)};
    const auto y = local_->minimiser(x, r);
    ASSERT_TRUE(local_->is_within_bounds(y, 0));
    stuck += y[1] == 0;
    pressed += y[0] == local_->lower(0);
    for (int side = 0; side < 8; ++side) {
      const double angle = side * std::numbers::pi / 4;
      const std::array<double, 2> z{std::max(y[0] + 1e-3 * std::cos(angle), -0.1), y[1] + 1e-3 * std::sin(angle)};
      EXPECT_LE(energy(y, x, r), energy(z, x, r) + 1e-15);
    }
    EXPECT_FALSE(local_->better_than(y, x, r, 1e-3));
    const auto better = local_->better_than({y[0] + 0.05, y[1] + 0.2}, x, r, 1e-3);
    ASSERT_TRUE(better);
    EXPECT_LT(energy(*better, x, r), energy({y[0] + 0.05, y[1] + 0.2}, x, r));
  }
  EXPECT_GT(stuck, 10);
  EXPECT_GT(pressed, 10);
}

TEST_F(OfOneNode, ForcesAndCorrectionsAreOfItsOwnStiffness) {
  const std::array<double, 2> d{0.3, -0.7}, f = local_->force(d), back = local_->correction(f);
  const Eigen::Vector2d wanted = M_ * Eigen::Vector2d(0.3, -0.7);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(f[i], wanted[i], 1e-14);
    EXPECT_NEAR(back[i], d[i], 1e-14);
  }
}

TEST_F(OfOneNode, FrictionIsConvexAndMovesStayWithinBounds) {
  EXPECT_NEAR(local_->change({0, 0.1}, {0, -0.4}), 0.3 * 0.3, 1e-15);
  EXPECT_NEAR(local_->slope({0, 0}, {0, -2}), 0.6, 1e-15);
  EXPECT_FALSE(local_->contradiction({0, 0.1}, {0, -0.4}));
  EXPECT_EQ(local_->moved({0, 0}, {-5, 3}), (std::array<double, 2>{-0.1, 3}));
  EXPECT_FALSE(local_->is_within_bounds({-0.2, 0}, 0.05));
  EXPECT_TRUE(local_->is_within_bounds({-0.2, 0}, 0.15));
}

/// -|v|: its slopes fall.
struct Concave {
  static double change(const Slot<1>&, const double* from, const double* to) { return std::abs(*from) - std::abs(*to); }
  static double slope(const Slot<1>&, const double* at, const double* step) {
    return *at == 0 ? -std::abs(*step) : (*at > 0 ? -*step : *step);
  }
  static void minimise(const Slot<1>&, const double*, const double*, const double* x, double* y) { *y = *x; }
  static void linearise(const Slot<1>&, const double*, const QuadraticModel<1>&) {}
};

TEST(LocalProblem, SeesWhatNoConvexFunctionSays) {
  class Hill final : public FunctionalObstacle<1, Concave> {
   public:
    ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 2}}, 0}; }
    void assemble(const SurfaceVertex*, std::size_t count, LocalConstraint<1>* out, Status&) const noexcept override {
      std::fill_n(out, count, bound<1>({1}, -5, 5));
    }
  };
  Model<1> model;
  model.obstacles = {{std::make_shared<Hill>(), Selection{"bottom", {}, ""}, "obstacle.0"}};
  const Mesh<2> mesh = unit_mesh<2>(2);
  const auto discretization = discretize(mesh, model);
  const LocalProblem<1> local(*model.obstacles[0].obstacle, functional::view(discretization.problem), 0);
  const auto found = local.contradiction({-1}, {1});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 2);  // uphill at the beginning
  EXPECT_EQ(found->change, 0);
  EXPECT_EQ(found->last, -2);
  EXPECT_FALSE(local.contradiction({1}, {2}));  // linear there
}

}  // namespace
}  // namespace signorini::testing
