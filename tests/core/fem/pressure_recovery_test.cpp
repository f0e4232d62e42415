// Pressures from means: exact means in, the pressure at nodes out.
#include "core/fem/recovery/pressure_recovery.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// The bottom of a unit square or cube under a pressure.
template <int D>
class Bottom {
 public:
  Bottom(Index cells, int order, const std::function<double(const Point<D>&)>& pressure) : pressure_(pressure) {
    if (order == 1)
      mesh_ = distorted_mesh<D>(cells);
    else
      refine_uniformly(distorted_mesh<D>(cells / 2), mesh_);
    nodes_.emplace(mesh_, order);
    Model<D> model;
    Selection on;
    on.where = expression([](const Site& s) { return s.x[D - 1] < 1e-9 ? 1.0 : 0.0; });
    model.obstacles = {{nullptr, on, ""}};
    const ContactSurface<D, D> surface(*nodes_, model, 0);
    for (Index p = 0; p < nodes_->size(); ++p) {
      if (nodes_->at(p)[D - 1] > 1e-9) continue;
      ContactNode<D> node{};
      node.vertex = p;
      node.direction[D - 1] = 1;
      node.area = surface.area(node);
      node.pressure = surface.mean(node, pressure);
      node.contact = node.pressure > 1e-12;
      contact_.push_back(node);
    }
    resolved_ = recover_pressure(*nodes_, surface, 0, 0, contact_).resolved;
  }

  bool resolved() const { return resolved_; }

  /// Of the recovered pressure over the mean, at nodes that bear at least half of the largest mean.
  double least_part() const {
    double largest = 0, out = infinity;
    for (const ContactNode<D>& node : contact_) largest = std::max(largest, node.pressure);
    for (const ContactNode<D>& node : contact_)
      if (node.pressure > 0.5 * largest) out = std::min(out, node.recovered / node.pressure);
    return out;
  }

  /// The largest difference at nodes up to a distance from the middle.
  double error(double radius) const {
    double out = 0;
    for (const ContactNode<D>& node : contact_) {
      const Point<D>& x = nodes_->at(node.vertex);
      if (distance(x) < radius) out = std::max(out, std::abs(node.recovered - pressure_(x)));
    }
    return out;
  }
  /// At these nodes.
  std::vector<double> recovered(double radius) const {
    std::vector<double> out;
    for (const ContactNode<D>& node : contact_)
      if (distance(nodes_->at(node.vertex)) < radius) out.push_back(node.recovered);
    return out;
  }
  static double distance(const Point<D>& x) {
    double sum = 0;
    for (int i = 0; i < D - 1; ++i) sum += (x[i] - 0.5) * (x[i] - 0.5);
    return std::sqrt(sum);
  }

 private:
  std::function<double(const Point<D>&)> pressure_;
  Mesh<D> mesh_;
  std::optional<Nodes<D>> nodes_;
  std::vector<ContactNode<D>> contact_;
  bool resolved_ = false;
};

template <int D>
void expect_hertz(int order, double most) {
  const auto hertz = [](const Point<D>& x) {
    return std::sqrt(std::max(0.16 - std::pow(Bottom<D>::distance(x), 2), 0.0)) / 0.4;
  };
  const double error = Bottom<D>(12, order, hertz).error(0.1);
  EXPECT_LE(error, most) << D << "D, order " << order;
}

/// With five nodes from the middle to the edge. Means alone are too small by up to 1 %, for they know the curvature.
TEST(PressureRecovery, KnowsThatMeansOfCurvedPressuresAreSmaller) {
  expect_hertz<2>(2, 0.002);
  expect_hertz<3>(2, 0.003);
}

/// A pressure of 1 that scatters by a fifth, from one face of the other body to the next: 3.7 nodes, all in contact.
template <int D>
void expect_mean(double most) {
  const auto scattered = [](const Point<D>& x) {
    double out = 1;
    for (int i = 0; i < D - 1; ++i) out += 0.2 / (D - 1) * std::sin(2 * std::numbers::pi * 24 / 3.7 * x[i]);
    return out;
  };
  double off = 0;
  for (const double recovered : Bottom<D>(24, 1, scattered).recovered(0.2))
    off = std::max(off, std::abs(recovered - 1));
  EXPECT_LE(off, most) << D << "D";
}

TEST(PressureRecovery, LooksFartherWhereForcesScatter) {
  expect_mean<2>(0.012);
  expect_mean<3>(0.012);
}

template <int D>
void expect_sane_on_coarse_meshes() {
  const auto hertz = [](const Point<D>& x) {
    return std::sqrt(std::max(0.16 - std::pow(Bottom<D>::distance(x), 2), 0.0)) / 0.4;
  };
  for (const int order : {1, 2})
    for (const int cells : {2, 4, 6, 8, 12}) {
      const Bottom<D> bottom(cells, order, hertz);
      EXPECT_GT(bottom.least_part(), 0.3) << D << "D, order " << order << ", " << cells << " cells";
      if (cells == 12) EXPECT_TRUE(bottom.resolved());
    }
  const auto narrow = [](const Point<D>& x) {
    return std::sqrt(std::max(0.01 - std::pow(Bottom<D>::distance(x), 2), 0.0));
  };
  EXPECT_FALSE(Bottom<D>(8, 1, narrow).resolved()) << "about one element from the middle to the edge";
}

/// What is fitted inside may be zero at a node that bears much.
TEST(PressureRecovery, NodesThatBearMuchHavePressure) {
  expect_sane_on_coarse_meshes<2>();
  expect_sane_on_coarse_meshes<3>();
}

template <int D>
void expect_exact(int order) {
  const auto linear = [](const Point<D>& x) { return 2 + x[0] - (D == 3 ? 0.5 * x[1] : 0); };
  EXPECT_LE((Bottom<D>(8, order, linear).error(0.3)), 1e-12) << D << "D, order " << order;
}

TEST(PressureRecovery, LinearPressuresAreExact) {
  for (const int order : {1, 2}) {
    expect_exact<2>(order);
    expect_exact<3>(order);
  }
}

/// What a plane at x = 0 is to the body.
enum class Side { end, mirror, wall, inclined_wall };

/// The pressures recovered on the bottom of a body under one that falls from the plane on.
template <int D>
std::vector<double> recovered_beside(Side side, int order) {
  Mesh<D> mesh;
  refine_uniformly(distorted_mesh<D>(5), mesh);
  if (side == Side::mirror) mesh.mirrors = {{.axis = 0, .at = 0}};
  const Nodes<D> nodes(mesh, order);
  const auto where = [](int axis) {
    Selection on;
    on.where = expression([axis](const Site& s) { return s.x[axis] < 1e-9 ? 1.0 : 0.0; });
    return on;
  };
  Model<D> model;
  model.obstacles = {{nullptr, where(D - 1), ""}};
  if (side == Side::wall || side == Side::inclined_wall) {
    Fix<D> fix{.on = where(0)};
    fix.value[0] = Field(0);
    model.fixes = {fix};
  }
  const ContactSurface<D, D> surface(nodes, model, 0);
  std::vector<ContactNode<D>> contact;
  for (Index p = 0; p < nodes.size(); ++p) {
    if (nodes.at(p)[D - 1] > 1e-9) continue;
    ContactNode<D> node{};
    node.vertex = p;
    node.contact = true;
    if (side == Side::inclined_wall) node.direction[0] = 0.1;
    node.direction[D - 1] = 1;
    node.area = surface.area(node);
    node.pressure = surface.mean(node, [](const Point<D>& x) { return 2 + std::cos(4 * x[0]); });
    contact.push_back(node);
  }
  recover_pressure(nodes, surface, 0, 0, contact);
  std::vector<double> out(contact.size());
  std::ranges::transform(contact, out.begin(), &ContactNode<D>::recovered);
  return out;
}

template <int D>
void expect_walls_are_mirrors() {
  for (const int order : {1, 2}) {
    const auto end = recovered_beside<D>(Side::end, order), mirror = recovered_beside<D>(Side::mirror, order);
    EXPECT_NE(end, mirror);
    const auto wall = recovered_beside<D>(Side::wall, order);
    ASSERT_EQ(wall.size(), mirror.size());
    for (std::size_t k = 0; k < wall.size(); ++k) EXPECT_NEAR(wall[k], mirror[k], 1e-12);
  }
}

/// A fix that keeps a flat part on its plane is a plane of symmetry.
TEST(PressureRecovery, GoesOnBeyondWallsAsBeyondPlanesOfSymmetry) {
  expect_walls_are_mirrors<2>();
  expect_walls_are_mirrors<3>();
}

/// The obstacle's image has an edge there.
TEST(PressureRecovery, EndsAtWallsThatAnObstacleIsInclinedTo) {
  const auto end = recovered_beside<2>(Side::end, 1), wall = recovered_beside<2>(Side::inclined_wall, 1);
  for (std::size_t k = 0; k < wall.size(); ++k) EXPECT_NEAR(wall[k], end[k], 1e-12);
}

/// On the bottom of a square: another body is in front of what is left of `end`, with a pressure of 1, and of so little
/// of one node that its force makes a hundred of it.
void expect_none_from_hardly_covered(double end, Index last_pressed) {
  const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {10, 10});
  const Nodes<2> nodes(mesh);
  Selection on;
  on.where = expression([](const Site& s) { return s.x[1] < 1e-9 ? 1.0 : 0.0; });
  Model<2> model;
  model.obstacles = {{nullptr, on, ""}};
  const ContactSurface<2, 2> surface(nodes, model, 0);
  std::vector<ContactNode<2>> contact;
  for (Index p = 0; p < nodes.size(); ++p) {
    const Point<2>& x = nodes.at(p);
    if (x[1] > 1e-9) continue;
    ContactNode<2> node{};
    node.vertex = p;
    node.direction = {0, 1};
    node.covered = x[0] < end ? 1 : 0.1;
    const auto column = static_cast<Index>(std::lround(10 * x[0]));
    node.contact = last_pressed < 0 ? node.hardly_covered() : column <= last_pressed;
    node.area = surface.area(node);
    node.recovered = node.pressure = node.contact ? node.hardly_covered() ? 100 : 1 : 0;
    contact.push_back(node);
    if (node.hardly_covered()) break;
  }
  const RecoveredPressure found = recover_pressure(nodes, surface, 0, 0, contact);
  EXPECT_TRUE(std::isfinite(found.area));
  EXPECT_GE(found.area, 0);
  if (last_pressed < 0) return;
  for (const ContactNode<2>& node : contact) EXPECT_LE(node.recovered, 1 + 1e-12);
  EXPECT_NEAR(found.area, end, 0.1);
}

TEST(PressureRecovery, ForcesAtNodesThatAreHardlyCoveredAreNoPressures) {
  expect_none_from_hardly_covered(0.55, 6);
  expect_none_from_hardly_covered(0.55, -1);  // it alone is pressed
}

}  // namespace
}  // namespace signorini::testing
