// Bodies that prescribed values do not hold: how they may move, whether obstacles hold them, and where they come to
// rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "core/solver/local_coordinates.hpp"
#include "driver/components.hpp"
#include "driver/motions/free_motions.hpp"
#include "driver/motions/limit_analysis.hpp"
#include "driver/motions/loose_body.hpp"
#include "driver/motions/slabs.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "tests/support/dense.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// The elastic body of a scene, discretized.
template <int D>
class Body {
 public:
  explicit Body(const std::string& text) : scene_(parse_scene(text, "test.toml", ".")), registry_(all_components()) {
    load_plugins(scene_, registry_);
    meshes_ = build_hierarchy<D>(scene_, D);
    nodes_.emplace(meshes_.finest());
    model = build_model<D>(scene_, D, registry_, 1.0);
    discretization = discretize<D, D>(*nodes_, model);
  }
  const Nodes<D>& nodes() const { return *nodes_; }
  LooseBody<D, D> loose() const { return {*nodes_, model, discretization}; }
  FreeMotions<D, D> free() const { return {*nodes_, model, discretization}; }
  std::vector<double> zero() const { return std::vector<double>(discretization.problem.b.size(), 0); }
  std::vector<double> global(const std::vector<double>& x) const { return to_global(discretization.problem, x); }

  Model<D> model;
  Discretization<D> discretization;

 private:
  Scene scene_;
  Registry registry_;
  MeshHierarchy<D> meshes_;
  std::optional<Nodes<D>> nodes_;
};

/// A unit block, turned or not, with whatever else.
template <int D>
std::string block(const std::string& rest) {
  return D == 2 ? tables::block("block", "[0, 0]", "[1, 1]", "[2, 2]") + rest
                : tables::block("block", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]") + rest;
}

/// Above a plane with a gap of 0.1, under its weight.
template <int D>
std::string resting(const std::string& weight = "-1") {
  return D == 2 ? block<2>(tables::load("block", "[0, " + weight + "]") +
                           tables::plane("block", "bottom", "[0, -0.1]", "[0, 1]"))
                : block<3>(tables::load("block", "[0, 0, " + weight + "]") +
                           tables::plane("block", "bottom", "[0, 0, -0.1]", "[0, 0, 1]"));
}

/// A friction type against a plane through zero with that slope; `weight` along -y.
std::string on_slope(double slope, double friction) {
  return block<2>(tables::load("block", "[0, -1]") +
                  fmt::format("[[obstacle]]\ntype = \"coulomb\"\nfriction = {}\nbody = \"block\"\non = \"bottom\"\n"
                              "shape = \"plane\"\npoint = [0, 0]\nnormal = [{}, 1]\n",
                              friction, -slope));
}

template <class Work>
std::string no_solution(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::no_solution);
    return error.what();
  }
  return "";
}

template <int D>
void expect_free_motions() {
  const Body<D> body(resting<D>());
  const FreeMotions<D, D> free = body.free();
  ASSERT_EQ(free.free.cols(), D == 2 ? 3 : 6);
  EXPECT_FALSE(free.none());
  EXPECT_LT((free.free.transpose() * free.free - Eigen::MatrixXd::Identity(free.free.cols(), free.free.cols())).norm(),
            1e-13);
  const auto A = sparse(body.discretization.problem.A);
  std::vector<double> x = body.zero();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.01 * std::sin(static_cast<double>(i));
  const auto gaps = free.gaps(x);
  EXPECT_EQ(gaps.size(), D == 2 ? 3u : 9u);
  Eigen::VectorXd c = Eigen::VectorXd::LinSpaced(free.free.cols(), 0.3, -0.5);
  std::vector<double> moved = x;
  free.add(free.free * c, moved);
  const Eigen::VectorXd way = vector(moved) - vector(x);
  EXPECT_GT(way.norm(), 0.1);
  EXPECT_LT((A * way).norm(), 1e-12);  // without energy
  double work = 0;
  const std::vector<double> u = body.global(moved), before = body.global(x);
  for (std::size_t i = 0; i < u.size(); ++i) work += body.discretization.load[i] * (u[i] - before[i]);
  EXPECT_NEAR(free.work.dot(c), work, 1e-12);
  EXPECT_GE(free.most_work * c.norm(), std::abs(work));
  const auto after = free.gaps(moved);
  ASSERT_EQ(after.size(), gaps.size());
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    EXPECT_EQ(after[k].vertex, gaps[k].vertex);
    EXPECT_NEAR(after[k].lower, gaps[k].lower - gaps[k].row.dot(c), 1e-13);
    EXPECT_EQ(after[k].upper, infinity);
    EXPECT_EQ(after[k].normal, 0);  // no friction
  }
  std::vector<double> deep = body.zero();
  free.add(free.free * free.work.normalized(), deep);  // falls through
  for (const auto& room : free.rooms(deep)) EXPECT_EQ(room.lower, 0);
  EXPECT_GT(free.gaps(deep)[0].lower, 0);
}

TEST(FreeMotions, HaveNoEnergyAndTheWorkAndRoomThatTheySay) {
  expect_free_motions<2>();
  expect_free_motions<3>();
}

TEST(FreeMotions, AreThoseThatFixesLeave) {
  const Body<2> held(resting<2>() + tables::fix("block", "top", "[0.1, 0.2]"));
  EXPECT_TRUE(held.free().none());
  EXPECT_TRUE(held.loose().held());
  EXPECT_FALSE(Body<2>(resting<2>()).loose().held());
}

TEST(FreeMotions, KnowFriction) {
  const Body<2> body(on_slope(0, 0.3));
  const FreeMotions<2, 2> free = body.free();
  for (Index slot = 0; slot < body.discretization.problem.constraints.size(); ++slot) {
    EXPECT_EQ(free.coefficient_of_friction(slot), 0.3);
    EXPECT_EQ(free.normal_component(slot), 0);
  }
  for (const auto& room : free.gaps(body.zero())) EXPECT_EQ(room.normal, 1);
  const Body<2> smooth(resting<2>());
  EXPECT_EQ(smooth.free().coefficient_of_friction(0), 0);
  EXPECT_EQ(smooth.free().normal_component(0), -1);
}

TEST(LimitAnalysis, NamesTheMotionThatNothingEnds) {
  for (const char* weight : {"-1", "1"}) {
    const Body<2> body(resting<2>(weight));
    const Body<3> solid(resting<3>(weight));
    const auto of_body = body.free();
    const auto of_solid = solid.free();
    const LimitAnalysis<2, 2> flat(of_body);
    const LimitAnalysis<3, 3> space(of_solid);
    const bool falls = weight == std::string("1");  // upwards
    const auto told = [&](const char* along) {
      return falls ? testing::Matcher<std::string>(
                         AllOf(HasSubstr("body.0"), HasSubstr("unbounded below"), HasSubstr(along)))
                   : testing::Matcher<std::string>("");
    };
    EXPECT_THAT(no_solution([&] { flat.require_minimum(); }), told("translation along (0, 1)"));
    EXPECT_THAT(no_solution([&] { space.require_minimum(); }), told("translation along (0, 0, 1)"));
    EXPECT_EQ(flat.needs_friction(), falls);
    EXPECT_THAT(no_solution([&] { body.loose().require_minimum(); }), told("translation along (0, 1)"));
    EXPECT_EQ(body.loose().needs_friction(), falls);
  }
}

// A block on a slope of 0.2 stands where the coefficient of friction is more than that: the limit is sharp.
TEST(LimitAnalysis, KnowsTheConesOfFriction) {
  for (const double friction : {0.199, 0.201}) {
    const Body<2> body(on_slope(0.2, friction));
    const auto free = body.free();
    const LimitAnalysis<2, 2> analysis(free);
    EXPECT_TRUE(analysis.needs_friction());
    const std::string text = no_solution([&] { analysis.require_minimum(); });
    if (friction > 0.2)
      EXPECT_EQ(text, "");
    else
      EXPECT_THAT(text, AllOf(HasSubstr("friction does not hold the body"), HasSubstr("translation along (-0.98")));
  }
  const Body<2> flat(on_slope(0, 0.3));
  const auto free = flat.free();
  EXPECT_FALSE((LimitAnalysis<2, 2>(free).needs_friction()));
}

// It falls by the gap, and stands with all of its weight on the plane.
template <int D>
void expect_fall() {
  const Body<D> body(resting<D>());
  std::vector<double> x = body.zero();
  const std::vector<double> way = body.global(body.loose().fall(x));
  ASSERT_EQ(way.size(), x.size());
  for (std::size_t i = 0; i < way.size(); ++i) EXPECT_NEAR(way[i], i % D == D - 1 ? -0.1 : 0, 1e-8);
  const std::vector<double> u = body.global(x);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], i % D == D - 1 ? -0.1 : 0, 1e-8);
  const Constraints<D>& c = body.discretization.problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) EXPECT_TRUE(c.admits(slot, x.data() + Offset{c.vector[slot]} * D));
}

TEST(LooseBody, FallsOntoTheObstacle) {
  expect_fall<2>();
  expect_fall<3>();
}

TEST(LooseBody, IsFarAwayBeyondLinearisedContact) {
  const Body<2> body(resting<2>());
  const auto moved = [&](double way, double turn) {
    std::vector<double> u;
    for (const Point<2>& x : body.nodes().mesh().points) u.insert(u.end(), {-turn * x[1], way + turn * x[0]});
    return to_local(body.discretization.problem, u);
  };
  EXPECT_FALSE(body.loose().is_far_away(moved(0, 0)));
  EXPECT_FALSE(body.loose().is_far_away(moved(40, 0.9)));
  EXPECT_TRUE(body.loose().is_far_away(moved(500, 0)));
  EXPECT_TRUE(body.loose().is_far_away(moved(0, 1.5)));
}

// Standing, it may slide as far as it likes: the mean of that is to be zero. What it stands on stays.
TEST(LooseBody, SettlesWhereMotionsCostNothing) {
  const Body<2> body(resting<2>());
  std::vector<double> u;
  for (std::size_t p = 0; p < body.nodes().mesh().points.size(); ++p) u.insert(u.end(), {3, -0.1});
  std::vector<double> x = to_local(body.discretization.problem, u);
  EXPECT_THAT(body.loose().settle(x), ElementsAre("translation along (1, 0)"));
  const std::vector<double> settled = body.global(x);
  for (std::size_t i = 0; i < settled.size(); ++i) EXPECT_NEAR(settled[i], i % 2 ? -0.1 : 0, 1e-8);
  const Body<2> guided(resting<2>() + "[[fix]]\nbody = \"block\"\non = \"left\"\nvalue = [0, \"free\"]\n");
  std::vector<double> y = to_local(guided.discretization.problem, settled);
  EXPECT_TRUE(guided.loose().settle(y).empty());
}

TEST(Slabs, AreStacked) {
  const std::vector<Eigen::RowVectorXd> rows{Eigen::RowVector3d(1, 2, 3), Eigen::RowVector3d(4, 5, 6)};
  EXPECT_EQ(stacked(rows, 3), (Eigen::MatrixXd{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(stacked({}, 3).cols(), 3);
}

// No point of a grid within all slabs is nearer to what is wanted.
TEST(Slabs, HaveANearestPoint) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Slab> slabs;
    for (int k = 0; k < 5; ++k)
      slabs.push_back({Eigen::RowVector2d(any(random), any(random)), -std::abs(any(random)),
                       k % 2 ? infinity : std::abs(any(random))});
    const Eigen::Vector2d wanted(2 * any(random), 2 * any(random));
    const auto admits = [&](const Eigen::VectorXd& v, double by) {
      return std::ranges::all_of(slabs, [&](const Slab& slab) {
        const double at = slab.row.dot(v);
        return at >= slab.lower - by && at <= slab.upper + by;
      });
    };
    const Eigen::VectorXd found = within(wanted, slabs), exact = exactly_within(wanted, slabs);
    EXPECT_TRUE(admits(found, 1e-7));
    EXPECT_TRUE(admits(exact, 1e-7));
    EXPECT_LT((exact - found).norm(), 1e-6);
    double least = infinity;
    for (double x = -2; x <= 2; x += 0.02)
      for (double y = -2; y <= 2; y += 0.02)
        if (const Eigen::Vector2d v(x, y); admits(v, 0)) least = std::min(least, (v - wanted).norm());
    EXPECT_LE((found - wanted).norm(), least + 1e-6);
  }
}

// Zero is next to the first one: the point stays off it as zero is, to the last digits.
TEST(Slabs, KeepDigitsAlongSidesThatZeroIsNextTo) {
  const Eigen::RowVector2d row(0.3, 0.7);
  const std::vector<Slab> slabs{{row, 0, infinity}, {Eigen::RowVector2d(1, 0), -infinity, 0.5}};
  const Eigen::VectorXd found = exactly_within(Eigen::Vector2d(2, -5), slabs);
  EXPECT_NEAR(row.dot(found), 0, 1e-16);
  EXPECT_LE(found[0], 0.5);
  EXPECT_GT(found.norm(), 0.1);
}

TEST(Slabs, AreLeftWhereNothingIsWithinThem) {
  const std::vector<Slab> apart{{Eigen::RowVector2d(1, 0), 1, infinity}, {Eigen::RowVector2d(1, 0), -infinity, -1}};
  EXPECT_EQ(nearest(Eigen::Vector2d(2, 3), apart, 1), Eigen::VectorXd::Zero(2));
  EXPECT_EQ(nearest(Eigen::Vector2d(2, 3), {}, infinity), Eigen::VectorXd::Zero(2));
  const std::vector<Slab> off{{Eigen::RowVector2d(1, 0), 1, infinity}};  // zero is not within
  const Eigen::VectorXd found = nearest(Eigen::Vector2d(-1, 3), off, 2);
  EXPECT_NEAR(found[0], 1, 1e-7);
  EXPECT_NEAR(found[1], 3, 1e-7);
}

}  // namespace
}  // namespace signorini::test
