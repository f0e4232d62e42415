// The faces an obstacle acts on as its nodes see them, what is pressed of them, and tractions and sets made of that.
#include <gtest/gtest.h>

#include <numbers>

#include "core/fem/recovery/coincidence_set.hpp"
#include "core/fem/recovery/contact_surface.hpp"
#include "core/fem/recovery/pressed_faces.hpp"
#include "core/fem/recovery/pressure_recovery.hpp"
#include "core/fem/recovery/traction_recovery.hpp"
#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using std::numbers::pi;

template <int B>
Model<B> acting_on(std::optional<std::string> part) {
  Model<B> out;
  out.obstacles = {term<B>([](const SurfaceVertex&) { return LocalConstraint<B>{}; }, std::move(part))};
  return out;
}

/// A node that is pressed along a direction.
template <int D>
ContactNode<D> pressed(Index vertex, const Point<D>& direction) {
  ContactNode<D> out{};
  out.vertex = vertex;
  out.direction = direction;
  out.contact = true;
  out.pressure = 1;
  return out;
}

template <int D>
Point<D> axis(int k, double sign = 1) {
  Point<D> out{};
  out[k] = sign;
  return out;
}

/// The bottom of the unit square or cube, turned: areas add up, means of linear functions are values at middles.
template <int D>
void expect_surface(int order) {
  Mesh<D> mesh;
  refine_uniformly(distorted_mesh<D>(2), mesh);
  rotate_mesh(mesh);
  const Nodes<D> nodes(mesh, order);
  const ContactSurface<D, D> surface(nodes, acting_on<D>("bottom"), 0);
  EXPECT_FALSE(surface.in_body());
  const auto linear = [](const Point<D>& x) { return 2 + 3 * x[0] - x[D - 1]; };
  Point<D> up;
  for (int i = 0; i < D; ++i) up[i] = rotation<D>()(i, D - 1);
  double area = 0, integral = 0, middles = 0;
  for (const Index p : signorini::surface(nodes, surface.all_faces()).nodes) {
    const ContactNode<D> node = pressed<D>(p, up);
    area += surface.area(node);
    integral += surface.area(node) * surface.mean(node, linear);
    middles += surface.area(node) * linear(surface.middle(node));
    for (const Index face : surface.faces(node)) EXPECT_TRUE(std::ranges::binary_search(surface.all_faces(), face));
  }
  Point<D> centre;
  Eigen::Matrix<double, D, 1> half = Eigen::Matrix<double, D, 1>::Constant(0.5);
  half[D - 1] = 0;
  Eigen::Map<Eigen::Matrix<double, D, 1>>(centre.data()) = rotation<D>() * half;
  EXPECT_NEAR(area, 1, 1e-13);
  EXPECT_NEAR(integral, linear(centre), 1e-13);
  EXPECT_NEAR(middles, linear(centre), 1e-13);
}

TEST(ContactSurface, SharesItsAreaAmongItsNodes) {
  for (const int order : {1, 2}) {
    expect_surface<2>(order);
    expect_surface<3>(order);
  }
}

// At the corner of a square pressed from below, from the side, along the diagonal and from nowhere.
TEST(ContactSurface, CountsFacesWithin60Degrees) {
  const Mesh<2> mesh = unit_mesh<2>(4);  // heights 1/5
  const Nodes<2> nodes(mesh);
  const ContactSurface<2, 2> surface(nodes, acting_on<2>("boundary"), 0);
  const auto area = [&](double degrees) {
    return surface.area(pressed<2>(0, {std::sin(degrees * pi / 180), std::cos(degrees * pi / 180)}));
  };
  const double below = 0.125, left = 0.1;
  EXPECT_NEAR(area(0), below, 1e-15);
  EXPECT_NEAR(area(29), below, 1e-15);
  EXPECT_NEAR(area(31), below + left, 1e-15);
  EXPECT_NEAR(area(59), below + left, 1e-15);
  EXPECT_NEAR(area(61), left, 1e-15);
  EXPECT_NEAR(area(180), below + left, 1e-15);  // where there is none all do
  EXPECT_EQ(surface.faces(pressed<2>(0, {0, 1})).size(), 1u);
  EXPECT_TRUE(surface.faces(pressed<2>(6, {0, 1})).empty());  // inside
}

TEST(ContactSurface, OfAScalarOnTheWholeBodyHasVolumes) {
  const Mesh<3> mesh = distorted_mesh<3>(2);
  const Nodes<3> nodes(mesh);
  const ContactSurface<3, 1> body(nodes, acting_on<1>({}), 0), bottom(nodes, acting_on<1>("bottom"), 0);
  EXPECT_TRUE(body.in_body());
  EXPECT_FALSE(bottom.in_body());
  EXPECT_FALSE(acts_on_faces(acting_on<1>({}).obstacles[0]));
  EXPECT_TRUE(acts_on_faces(acting_on<2>({}).obstacles[0]));
  double sum = 0;
  for (Index p = 0; p < nodes.size(); ++p) {
    ContactNode<1> node{};
    node.vertex = p;
    sum += body.area(node);
  }
  EXPECT_NEAR(sum, 1, 1e-13);
}

TEST(ContactSurface, OfABodyOfRevolutionIsThatOfRings) {
  const Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {4, 2});
  Model<2> model = acting_on<2>("bottom");
  model.plane = Plane::axisymmetric;
  const Nodes<2> nodes(mesh);
  const ContactSurface<2, 2> surface(nodes, model, 0);
  double area = 0;
  for (Index p = 0; p < 5; ++p) area += surface.area(pressed<2>(p, {0, 1}));
  EXPECT_NEAR(area, 4 * pi, 1e-13);
}

TEST(ContactSurface, KnowsWallsBesideIt) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<2> model = acting_on<2>("bottom");
  model.fixes = {fix<2>("left", {0.0, std::nullopt})};
  const Nodes<2> nodes(mesh);
  const ContactSurface<2, 2> surface(nodes, model, 0);
  ASSERT_EQ(surface.walls().size(), 1u);
  EXPECT_TRUE(surface.lies_on(surface.walls()[0], 0));
  EXPECT_FALSE(surface.lies_on(surface.walls()[0], 1));
}

/// All nodes of the bottom; those up to some x are pressed.
template <int D>
struct Bottom {
  explicit Bottom(double up_to, Model<D> of = acting_on<D>("bottom"), Index cells = 6)
      : mesh(unit_mesh<D>(cells)), nodes(mesh), model(std::move(of)), surface(nodes, model, 0) {
    for (const Index p : signorini::surface(nodes, surface.all_faces()).nodes) {
      ContactNode<D>& node = contact.emplace_back(pressed<D>(p, axis<D>(D - 1)));
      node.contact = nodes.at(p)[0] < up_to + 1e-9;
      node.area = surface.area(node);
    }
  }
  PressedFaces<D, D> faces(double least = 0) { return {nodes, surface, 0, least, contact}; }

  Mesh<D> mesh;
  Nodes<D> nodes;
  Model<D> model;
  ContactSurface<D, D> surface;
  std::vector<ContactNode<D>> contact;
};

template <int D>
void expect_pressed() {
  Bottom<D> bottom(0.5);
  const PressedFaces<D, D> faces = bottom.faces();
  ASSERT_EQ(static_cast<std::size_t>(faces.size()), bottom.contact.size());
  int some = 0;
  for (Index k = 0; k < faces.size(); ++k) {
    const double x = bottom.nodes.at(faces.node(k).vertex)[0];
    EXPECT_EQ(faces.pressed(k), x < 0.51);
    EXPECT_EQ(faces.inside(k), x < 0.49) << x;
    for (const Index other : faces.around(k)) EXPECT_NE(other, k);
    EXPECT_FALSE(faces.at_end(k));
    some += faces.inside(k);
    // With nothing but flat faces contact ends half way between nodes.
    if (!faces.pressed(k)) {
      EXPECT_EQ(faces.reach(k), 0.5);
    }
  }
  EXPECT_GT(some, 2);
  EXPECT_FALSE(faces.pressed(unreachable));
  // The faces around those it presses: one row beyond.
  double measure = 0;
  for (const Index f : faces.faces()) measure += length<D>(area_normal(bottom.mesh, bottom.mesh.boundary[f]));
  EXPECT_NEAR(measure, 0.5 + 1.0 / 6, 1e-13);
  EXPECT_TRUE(bottom.faces(10).faces().empty());  // no force is as large as that
}

TEST(PressedFaces, AreThoseAroundPressedNodes) {
  expect_pressed<2>();
  expect_pressed<3>();
}

/// Ends of the body's own surface, and a wall beyond which it goes on.
TEST(PressedFaces, EndAtRimsAndGoOnBeyondWalls) {
  Model<2> held = acting_on<2>("bottom");
  held.fixes = {fix<2>("left", {0.0, std::nullopt})};
  Bottom<2> free(1), beside(1, held);
  const PressedFaces<2, 2> faces = free.faces(), of_half = beside.faces();
  EXPECT_TRUE(faces.at_rim(0));
  EXPECT_TRUE(faces.at_rim(faces.size() - 1));
  EXPECT_FALSE(faces.at_rim(3));
  EXPECT_FALSE(of_half.at_rim(0));
  EXPECT_TRUE(of_half.at_rim(of_half.size() - 1));
  // Of its neighbours up to the second ring those beyond the wall are found as images.
  const auto all = [](Index) { return true; };
  EXPECT_EQ(faces.around(0, {2, 2, 0}, all).size(), 3u);
  const auto seen = of_half.around(0, {2, 2, 0}, all);
  EXPECT_EQ(seen.size(), 5u);
  for (const auto& reached : seen) {
    const Point<2> at = of_half.in_image(reached.image, beside.nodes.at(of_half.node(reached.node).vertex));
    EXPECT_NEAR(at[0], (reached.image ? -1 : 1) * beside.nodes.at(of_half.node(reached.node).vertex)[0], 1e-15);
    EXPECT_EQ(of_half.turned(reached.image, {1, 2}), (Point<2>{reached.image ? -1.0 : 1.0, 2}));
  }
  Point<2> direction{1, 2};
  of_half.keep_within(0, direction);
  EXPECT_EQ(direction, (Point<2>{0, 2}));
  EXPECT_NEAR(of_half.middle(0, beside.surface)[0], 0, 1e-15);  // the half beyond the wall counts
  EXPECT_GT(faces.middle(0, free.surface)[0], 0.01);
}

TEST(PressedFaces, EndWhereAnotherBodyDoes) {
  Bottom<2> bottom(1);
  bottom.contact[4].covered = 0.3;
  const PressedFaces<2, 2> faces = bottom.faces();
  EXPECT_TRUE(faces.at_end(3));
  EXPECT_EQ(faces.around(3), std::vector<Index>{2});
  EXPECT_FALSE(faces.inside(4));
}

// What lies at the rows of a plane that touches the surface are distances along it.
TEST(TangentPlane, KeepsDistancesAlongTheSurface) {
  Bottom<3> bottom(1);
  const PressedFaces<3, 3> faces = bottom.faces();
  const SurfaceSamples<3, 3> samples(bottom.nodes, bottom.surface, faces);
  const TangentPlane<3> plane = samples.plane_at(5);
  const Point<3>& origin = bottom.nodes.at(faces.node(5).vertex);
  const auto at = plane({origin[0] + 0.3, origin[1] - 0.4, origin[2] + 7});
  EXPECT_NEAR(std::hypot(at[0], at[1]), 0.5, 1e-14);
  const auto some = samples.around(5, {{5, 0}}, [](const auto&) { return 4.0; });
  ASSERT_EQ(some.size(), 1u);
}

/// Friction on all of the bottom: what each node bears and has, and the traction recovered.
template <int D>
std::vector<Point<D>> tractions(Bottom<D>& bottom, double coefficient,
                                const std::function<std::pair<Point<D>, bool>(const Point<D>&)>& of) {
  for (ContactNode<D>& node : bottom.contact) {
    const auto [traction, sticks] = of(bottom.surface.middle(node));
    node.friction = true;
    node.sticks = sticks;
    node.law = {coefficient, 0};
    node.recovered = node.pressure;
    for (int i = 0; i < D; ++i) node.tangential[i] = traction[i] * node.area;
  }
  recover_traction(bottom.nodes, bottom.surface, bottom.faces());
  std::vector<Point<D>> out;
  for (const ContactNode<D>& node : bottom.contact) out.push_back(node.traction);
  return out;
}

template <int D>
void expect_tractions() {
  const double mu = 0.4;
  Bottom<D> bottom(1);
  // All slips: as much as friction bears, along what there is of it.
  for (const Point<D>& t : tractions<D>(bottom, mu, [](const auto&) { return std::pair(axis<D>(0, -0.1), false); })) {
    EXPECT_NEAR(t[0], -mu, 1e-14);
    EXPECT_EQ(t[D - 1], 0);
  }
  // All sticks: linear tractions stay what they are, at nodes and not at middles.
  const auto linear = [](const Point<D>& x) { return 0.1 + 0.1 * x[0]; };
  const auto found =
      tractions<D>(bottom, mu, [&](const Point<D>& x) { return std::pair(axis<D>(0, linear(x)), true); });
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k][0], linear(bottom.nodes.at(bottom.contact[k].vertex)), 1e-10);
  // Never more than friction bears.
  for (const Point<D>& t :
       tractions<D>(bottom, 0.05, [&](const Point<D>& x) { return std::pair(axis<D>(0, linear(x)), true); }))
    EXPECT_NEAR(length<D>(t), 0.05, 1e-14);
}

TEST(TractionRecovery, IsAllThatFrictionBearsWhereItSlipsAndAFitWhereItSticks) {
  expect_tractions<2>();
  expect_tractions<3>();
}

// Cattaneo and Mindlin: towards what slips, x > 0.5, the rest up to mu p falls like a square root.
TEST(TractionRecovery, ComesUpToWhatFrictionBearsLikeASquareRoot) {
  const double mu = 0.4, edge = 0.55;
  Bottom<2> bottom(1, acting_on<2>("bottom"), 20);
  const auto exact = [&](double x) { return x > edge ? mu : mu - 0.3 * std::sqrt(edge - x); };
  const auto found = tractions<2>(bottom, mu, [&](const Point<2>& x) {
    return std::pair(Point<2>{exact(x[0]), 0}, x[0] > edge ? false : true);
  });
  for (std::size_t k = 3; k + 3 < found.size(); ++k) {
    const double x = bottom.nodes.at(bottom.contact[k].vertex)[0];
    EXPECT_NEAR(found[k][0], exact(x), x < 0.5 ? 0.004 : 0.03) << x;
  }
}

TEST(TractionRecovery, LeavesNodesWithoutFrictionAlone) {
  Bottom<2> bottom(1);
  for (ContactNode<2>& node : bottom.contact) node.traction = {7, 7};
  recover_traction(bottom.nodes, bottom.surface, bottom.faces());
  for (const ContactNode<2>& node : bottom.contact) EXPECT_EQ(node.traction, (Point<2>{7, 7}));
}

/// A membrane that rests where x < edge, on what presses with a density: nodes get the integrals of their hat functions
/// over that set.
template <int D>
double resting(const Mesh<D>& mesh, double edge, double density, Index obstacle = 0) {
  const Nodes<D> nodes(mesh);
  const std::vector<double> volume = node_volumes(nodes);
  std::vector<double> force(volume.size(), 0);
  constexpr int parts = D == 2 ? 200 : 12;  // by a fine rule along x alone: cells are boxes
  for (const Simplex<D>& element : mesh.elements) {
    const double measure = linear_element(mesh, element).measure;
    double weight_sum = 0;
    std::array<double, D + 1> part{};
    for (int a = 0; a <= parts; ++a)
      for (int b = 0; a + b <= parts; ++b)
        for (int c = 0; c <= (D == 3 ? parts - a - b : 0); ++c) {
          std::array<double, D + 1> at{};
          const double n = parts + D + 1;
          at[0] = (a + 1) / n, at[1] = (b + 1) / n;
          if constexpr (D == 3) at[2] = (c + 1) / n;
          at[D] = 1;
          for (int i = 0; i < D; ++i) at[D] -= at[i];
          weight_sum += 1;
          if (combine<D>(mesh, element, at)[0] > edge) continue;
          for (int i = 0; i <= D; ++i) part[i] += at[i];
        }
    for (int i = 0; i <= D; ++i) force[element[i]] += density * measure * part[i] / weight_sum;
  }
  std::vector<ContactNode<1>> contact;
  for (Index p = 0; p < nodes.size(); ++p) {
    ContactNode<1> node{};
    node.vertex = p;
    node.obstacle = obstacle;
    node.contact = mesh.points[p][0] < edge;
    node.area = volume[p];
    node.pressure = force[p] / volume[p];
    contact.push_back(node);
  }
  return coincidence_set(nodes, 0, contact);
}

// All that presses is borne by nodes in contact but for what nodes beyond the edge would have: of second order.
TEST(CoincidenceSet, IsKnownUpToTheEdgeWithinElements) {
  const double edge = 0.53;
  const double coarse = resting<2>(rectangle({0, 0}, {1, 1}, {10, 4}), edge, 3),
               fine = resting<2>(rectangle({0, 0}, {1, 1}, {20, 4}), edge, 3),
               body = resting<3>(box({0, 0, 0}, {1, 1, 1}, {10, 2, 2}), edge, 0.2);
  EXPECT_NEAR(coarse, edge, 0.006);  // nodes alone are off by 0.02
  EXPECT_NEAR(fine, edge, 0.01);
  EXPECT_NEAR(body, edge, 0.01);
  EXPECT_EQ(resting<2>(rectangle({0, 0}, {1, 1}, {10, 4}), edge, 3, 1), 0);  // another obstacle's
}

TEST(CoincidenceSet, CountsNodesInFullWithoutADensityInside) {
  const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {4, 4});
  EXPECT_NEAR(resting<2>(mesh, 2, 1), 1, 1e-12);        // no edge at all
  EXPECT_NEAR(resting<2>(mesh, 0.1, 1), 0.125, 1e-12);  // a column of nodes, all at the edge
}

TEST(CoincidenceSet, TakesTheMedianOfDensities) {
  std::vector<double> odd{5, 1, 1000}, even{4, 1, 3, 900};
  EXPECT_EQ(median(odd), 5);
  EXPECT_EQ(median(even), 3);  // the lower one of two
  std::vector<double> one{7};
  EXPECT_EQ(median(one), 7);
}

}  // namespace
}  // namespace signorini::testing
