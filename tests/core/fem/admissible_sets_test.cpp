// What an obstacle admits at a node has to be the box of its bounds: one that derives from the interface itself, with a
// sweep of its own, is asked for it.
#include "core/constraints/admissible_sets.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "core/base/error.hpp"
#include "core/fem/conditions/model_places.hpp"
#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/projected_sweep.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// Gauss-Seidel that ends at the admissible point next to the minimiser, as it is for round matrices.
template <int B>
class OwnSet final : public Obstacle<B> {
 public:
  using Project = std::function<void(double* v)>;
  OwnSet(LocalConstraint<B> constraint, Project project) : constraint_(constraint), project_(std::move(project)) {}

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"set", B, 2}}}; }
  void assemble(const SurfaceVertex*, std::size_t count, LocalConstraint<B>* out, Status&) const noexcept override {
    std::fill_n(out, count, constraint_);
  }
  void sweep(const LevelView<B>& level, Index first, Index last, Order order) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    sweep_slots<B>(level, from, to, first, last, order, [&](Index slot) {
      relax<B>(level, level.constrained[slot]);
      project_(level.x + Offset{level.constrained[slot]} * B);
    });
  }
  void distance(const LevelView<B>&, Index, Index, double*, double*, Flags*) const noexcept override {}
  double natural_residual(const LevelView<B>&, Index, Index, const double*) const noexcept override { return 0; }

 private:
  LocalConstraint<B> constraint_;
  Project project_;
};

/// lower <= v <= upper in all components.
template <int B>
LocalConstraint<B> cube(double lower, double upper) {
  LocalConstraint<B> c;
  c.directions = B;
  for (int k = 0; k < B; ++k) {
    c.direction[k][k] = 1;
    c.lower[k] = lower;
    c.upper[k] = upper;
  }
  return c;
}

template <int B>
void to_ball(double radius, double* v) {
  const double length = block::norm<B>(v);
  for (int k = 0; k < B && length > radius; ++k) v[k] *= radius / length;
}

template <int B>
void to_cube(double lower, double upper, double* v) {
  for (int k = 0; k < B; ++k) v[k] = block::clamp(v[k], lower, upper);
}

template <int B>
void discretize_with(const LocalConstraint<B>& constraint, const typename OwnSet<B>::Project& project) {
  Model<B> model;
  model.obstacles = {{std::make_shared<OwnSet<B>>(constraint, project), Selection{"right", {}, ""}, "scene.toml:8: o"}};
  discretize(unit_mesh < B == 3 ? 3 : 2 > (2), model);
}

template <int B>
void expect_refused(const LocalConstraint<B>& constraint, const typename OwnSet<B>::Project& project) {
  try {
    discretize_with<B>(constraint, project);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), ::testing::StartsWith("scene.toml:8: o: the plugin's sweep ends at ("));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("of the node at (1, "));
  }
}

TEST(AdmissibleSets, BallsAreRefused) {
  for (const double r : {1e-6, 0.1, 20.0}) {
    expect_refused<2>(cube<2>(-r, r), [r](double* v) { to_ball<2>(r, v); });  // inside the box
    expect_refused<3>(cube<3>(-r, r), [r](double* v) { to_ball<3>(r, v); });
    expect_refused<2>(cube<2>(-r, r), [r](double* v) { to_ball<2>(std::sqrt(2.0) * r, v); });  // around it
    LocalConstraint<3> half = cube<3>(-infinity, infinity);                                    // hardly said at all
    half.lower[0] = -r;
    expect_refused<3>(half, [r](double* v) { to_ball<3>(r, v); });
  }
}

TEST(AdmissibleSets, ConesAndWhatIsCutOffAreRefused) {
  const auto cone = [](double* v) {
    if (v[0] < 0) v[0] = v[1] = 0;
    v[1] = block::clamp(v[1], -0.5 * v[0], 0.5 * v[0]);
  };
  LocalConstraint<2> half = cube<2>(-infinity, infinity);
  half.lower[0] = 0;
  expect_refused<2>(half, cone);
  expect_refused<3>(cube<3>(-1, 1), [](double* v) {
    to_cube<3>(-1, 1, v);
    const double over = (v[0] + v[1] + v[2] - 2.9) / 3;
    for (int k = 0; k < 3 && over > 0; ++k) v[k] -= over;
  });
}

TEST(AdmissibleSets, OtherBoundsThanThoseSaidAreRefused) {
  expect_refused<1>(cube<1>(0, infinity), [](double* v) { *v = std::max(*v, -0.01); });
  expect_refused<2>(cube<2>(-0.1, 0.2), [](double* v) { to_cube<2>(-0.1, 0.3, v); });
}

TEST(AdmissibleSets, BoxesAreAccepted) {
  for (const double scale : {1e-8, 1.0, 1e8}) {
    EXPECT_NO_THROW(discretize_with<1>(cube<1>(0, scale), [=](double* v) { to_cube<1>(0, scale, v); }));
    EXPECT_NO_THROW(discretize_with<2>(cube<2>(-scale, 0), [=](double* v) { to_cube<2>(-scale, 0, v); }));
    EXPECT_NO_THROW(discretize_with<3>(cube<3>(-scale, scale), [=](double* v) { to_cube<3>(-scale, scale, v); }));
  }
  LocalConstraint<3> plane = cube<3>(-infinity, infinity);  // turned: its direction is the first component
  plane.directions = 1;
  plane.direction[0][0] = 0.6, plane.direction[0][2] = 0.8;
  plane.lower[0] = -0.25;
  EXPECT_NO_THROW(discretize_with<3>(plane, [](double* v) { v[0] = std::max(v[0], -0.25); }));
}

/// A box whose sweep ends nowhere.
class NoNumber final : public BoxObstacle<2> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"no number", 2, 2}}}; }
  void assemble(const SurfaceVertex*, std::size_t count, LocalConstraint<2>* out, Status&) const noexcept override {
    std::fill_n(out, count, cube<2>(-1, 1));
  }
  void sweep(const LevelView<2>& level, Index first, Index last, Order order) const noexcept override {
    BoxObstacle<2>::sweep(level, first, last, order);
    level.x[2 * first] = std::numeric_limits<double>::quiet_NaN();
  }
};

// Boxes are asked when a solve has led to no number, not before.
TEST(AdmissibleSets, SweepsThatEndNowhereAreFoundWhenAllAreAsked) {
  Model<2> model;
  model.obstacles = {{std::make_shared<NoNumber>(), Selection{"right", {}, ""}, "scene.toml:8: o"}};
  const Mesh<2> mesh = unit_mesh<2>(2);
  const auto discretization = discretize(mesh, model);
  try {
    const Nodes<2> nodes(mesh);
    check_admissible_sets(ModelPlaces<2, 2>(nodes, model), discretization.problem, 1, true);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), ::testing::StartsWith("scene.toml:8: o: the plugin's sweep ends at (nan"));
  }
}

}  // namespace
}  // namespace signorini::testing
