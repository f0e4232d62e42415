#include "core/fem/recovery/rigid_gap.hpp"

#include <gtest/gtest.h>

#include "core/geometry/shapes.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// Contact with a shape as the plugin has it: -u.n <= distance.
template <int D>
ObstacleTerm<D> rigid(std::shared_ptr<const DistanceFunction> shape, const std::string& part) {
  const auto rule = [shape](const SurfaceVertex& v) {
    Status status;
    const Distance d = shape->at(v.position, v.normal, status);
    std::array<double, D> n;
    std::copy_n(d.normal, D, n.begin());
    return bound<D>(n, -d.value, infinity);
  };
  ObstacleTerm<D> out = term<D>(rule, part);
  out.shape = shape;
  return out;
}

/// A node said to be in contact.
ContactNode<2> touching(Index node) {
  ContactNode<2> out{};
  out.vertex = node;
  out.contact = true;
  return out;
}

/// A disk under the square's bottom that touches it in the middle.
std::shared_ptr<const DistanceFunction> disk(double radius) {
  return geometry::sphere({0.5, -radius}, radius, false, 1, "disk");
}

TEST(DeformedContact, IsTheTrueDistanceOfTheMovedBoundary) {
  const double radius = 0.7;
  const Mesh<2> mesh = unit_mesh<2>(4);
  Model<2> model;
  model.obstacles = {rigid<2>(disk(radius), "bottom")};
  std::vector<double> u;
  for (const auto& x : mesh.points) u.insert(u.end(), {0.1 * x[0] * x[0], -0.2 * x[0]});
  // The linearised condition is said to hold with contact at two vertices.
  ContactState<2> state;
  state.obstacles.resize(1);
  double opening = 0, deepest = 0;
  for (Index p = 0; p < mesh.vertices(); ++p) {
    if (mesh.points[p][1] != 0) continue;
    const double x = mesh.points[p][0] + u[2 * p], y = u[2 * p + 1];
    const double distance = std::hypot(x - 0.5, y + radius) - radius;
    deepest = std::max(deepest, -distance);
    if (mesh.points[p][0] > 0.2) continue;
    state.nodes.push_back(touching(p));
    opening = std::max(opening, distance);
  }
  ASSERT_GT(opening, 0);
  ASSERT_GT(deepest, 0);
  const auto found = deformed_contact(mesh, model, 0, state, u);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->penetration, deepest, 1e-14);
  EXPECT_NEAR(found->opening, opening, 1e-14);
}

TEST(DeformedContact, OfAPlaneIsRoundingAndOfASphereIsOfSecondOrder) {
  const Mesh<2> mesh = unit_mesh<2>(4);
  const auto largest = [&](std::shared_ptr<const DistanceFunction> shape, double push) {
    Model<2> model;
    model.poisson = 0.3;
    model.fixes = {fix<2>("top", {push, -push})};
    model.obstacles = {rigid<2>(std::move(shape), "bottom")};
    const auto discrete = discretize(mesh, model);
    const auto x = solve_bounded(discrete.problem);
    const auto found =
        deformed_contact(mesh, model, 0, contact_state(mesh, model, discrete, x), to_global(discrete.problem, x));
    EXPECT_GT(found->displacement, 0.1 * push);
    return std::max(found->penetration, found->opening);
  };
  EXPECT_LT(largest(geometry::plane({0.0, 0.0}, {0.1, 1.0}, 1, "plane"), 0.01), 1e-15);
  const double one = largest(disk(0.7), 0.02), half = largest(disk(0.7), 0.01);
  EXPECT_GT(one, 1e-6);
  EXPECT_NEAR(std::log2(one / half), 2, 0.3);
}

TEST(StartDepth, TellsABodyInsideAndAReversedNormal) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  Model<3> model;
  const auto depth = [&](double height, double up, bool everywhere) {
    model.obstacles = {rigid<3>(geometry::plane({0.0, 0.0, height}, {0.0, 0.0, up}, 1, "plane"), "bottom")};
    return *start_depth(mesh, model, 0, everywhere);
  };
  for (const bool everywhere : {false, true}) {
    EXPECT_DOUBLE_EQ(depth(0.5, 1, everywhere).depth, 0.5);
    EXPECT_DOUBLE_EQ(depth(0.5, 1, everywhere).extent, 1);
    EXPECT_FALSE(depth(0.5, 1, everywhere).completely);
    EXPECT_DOUBLE_EQ(depth(-0.25, 1, everywhere).depth, -0.25);
    EXPECT_TRUE(depth(0, -1, everywhere).completely);
    EXPECT_FALSE(depth(0, 1, everywhere).completely);
  }
  EXPECT_DOUBLE_EQ(depth(0, -1, false).depth, 1);
  model.obstacles = {rigid<3>(geometry::expression(0.0, {0.0, 0.0, 1.0}, 3, 1, "touching"), "bottom")};
  EXPECT_FALSE(start_depth(mesh, model, 0, true)->completely);
  model.obstacles[0].shape = nullptr;
  EXPECT_FALSE(start_depth(mesh, model, 0, true));
}

/// Below y = 0 left of x = 0.5, and below a slope right of it.
class Ridge : public DistanceFunction {
 public:
  explicit Ridge(double slope) : normal_{slope / std::hypot(slope, 1), 1 / std::hypot(slope, 1)} {}
  Distance at(const double* x, const double*, Status&) const noexcept override {
    const double beyond = normal_[0] * (x[0] - 0.5) + normal_[1] * x[1];
    return x[1] >= beyond ? Distance{x[1], {0, 1, 0}} : Distance{beyond, {normal_[0], normal_[1], 0}};
  }

 private:
  double normal_[2];
};

// What an edge does is told from what curvature does by where the normal turns.
TEST(DeformedContact, TellsEdgesFromCurvature) {
  const Mesh<2> mesh = unit_mesh<2>(4);
  Model<2> model;
  std::vector<double> u;
  for (Index p = 0; p < mesh.vertices(); ++p) u.insert(u.end(), {0.03, 0.0});
  ContactState<2> state;
  state.obstacles.resize(1);
  for (Index p = 0; p < mesh.vertices(); ++p)
    if (mesh.points[p][1] == 0 && mesh.points[p][0] == 0.5) state.nodes.push_back(touching(p));
  ASSERT_EQ(state.nodes.size(), 1u);
  const auto over_edge = [&](std::shared_ptr<const DistanceFunction> shape) {
    model.obstacles = {rigid<2>(shape, "bottom")};
    const auto found = deformed_contact(Nodes(mesh), model, 0, state, u);
    EXPECT_GT(found->opening + found->penetration, 1e-4);
    return found->over_edge;
  };
  EXPECT_TRUE(over_edge(std::make_shared<Ridge>(0.36)));
  EXPECT_FALSE(over_edge(disk(0.7)));
  EXPECT_FALSE(over_edge(disk(0.05)));
}

}  // namespace
}  // namespace signorini::testing
