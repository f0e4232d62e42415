// What single elements and faces are: measures, gradients, nearest points, and what they stand for around an axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "core/base/error.hpp"
#include "core/fem/elements/checked_element.hpp"
#include "core/fem/elements/gradient.hpp"
#include "core/fem/elements/nearest_on_face.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using std::numbers::pi;

/// What a refusal says; empty: none.
template <class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

template <int D>
void expect_checked() {
  Mesh<D> mesh = distorted_mesh<D>(2);
  double sum = 0;
  for (const Simplex<D>& element : mesh.elements) sum += checked_element(mesh, element, "scene.toml:3: body").measure;
  EXPECT_NEAR(sum, 1, 1e-13);
  Simplex<D> turned = mesh.elements.front();
  flip<D>(turned);
  const std::string text = complaint([&] { checked_element(mesh, turned, "scene.toml:3: body"); });
  EXPECT_EQ(text.find(D == 2 ? "scene.toml:3: body: element with area -" : "scene.toml:3: body: element with volume -"),
            0u)
      << text;
  for (Point<D>& x : mesh.points) x[D - 1] = 0;  // flat: its volume is zero, which is not positive
  EXPECT_NE(complaint([&] { checked_element(mesh, mesh.elements.front(), "b"); }), "");
}

TEST(Elements, InvertedOrFlatAreRefusedWithTheirPlace) {
  expect_checked<2>();
  expect_checked<3>();
}

// A midpoint pulled far beyond a corner turns the element inside out near that corner, and not at the others.
TEST(Elements, CurvedOnesAreRefusedWhereTheyAreInverted) {
  std::array<Point<2>, 6> node{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}}};
  const std::array<double, 3> first{1, 0, 0}, second{0, 1, 0};
  const ElementMap<2, 2, 2> straight(node);
  EXPECT_DOUBLE_EQ((checked_element<2, 2>(straight, first, "b").measure), 0.5);
  node[3] = {-0.4, 0};
  const ElementMap<2, 2, 2> curved(node);
  EXPECT_NE(complaint([&] { checked_element<2, 2>(curved, first, "b"); }), "");
  EXPECT_EQ(complaint([&] { checked_element<2, 2>(curved, second, "b"); }), "");
}

/// Pairs of nodes that an element has in common.
template <int P, int D>
std::size_t counted_pairs(const Nodes<D>& nodes) {
  std::set<std::array<Index, 2>> pairs;
  for (const auto& element : nodes.template elements<P>())
    for (const Index a : nodes.of(element))
      for (const Index b : nodes.of(element))
        if (a < b) pairs.insert({a, b});
  return pairs.size();
}

template <int D>
void expect_estimated_pairs() {
  const MeshHierarchy<D> meshes = hierarchy(unit_mesh<D>(2), 1);
  const Nodes<D> linear(meshes.finest()), quadratic(meshes.finest(), 2);
  // Euler's formula is exact but for a constant number and rounding of halves.
  EXPECT_NEAR(static_cast<double>(estimated_pairs(linear)), static_cast<double>(counted_pairs<1>(linear)), 3);
  EXPECT_NEAR(static_cast<double>(estimated_pairs(quadratic)), static_cast<double>(counted_pairs<2>(quadratic)), 3);
}

TEST(Elements, PairsOfNodesAreCountedByEulersFormula) {
  expect_estimated_pairs<2>();
  expect_estimated_pairs<3>();
}

template <int D>
void expect_gradient() {
  const Mesh<D> mesh = distorted_mesh<D>(2);
  Eigen::Matrix<double, D, D> G = Eigen::Matrix<double, D, D>::Random();
  std::vector<double> u;
  for (const Point<D>& x : mesh.points) {
    const Eigen::Matrix<double, D, 1> v = G * vector<D>(x);
    u.insert(u.end(), v.begin(), v.end());
  }
  for (const Simplex<D>& element : mesh.elements) {
    const auto g = gradient<D, D>(linear_element(mesh, element).gradient, element, u);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) EXPECT_NEAR(g[i][j], G(i, j), 1e-12);
  }
}

TEST(Elements, RowsOfAGradientAreTheDerivativesOfAComponent) {
  expect_gradient<2>();
  expect_gradient<3>();
}

/// A face of no special shape, and the distances of points from a fine sampling of it.
template <int D>
void expect_nearest() {
  std::array<Point<D>, D> corner;
  if constexpr (D == 2)
    corner = {{{0.2, -0.1}, {1.3, 0.4}}};
  else
    corner = {{{0.2, -0.1, 0.3}, {1.3, 0.4, 0.1}, {0.5, 1.1, -0.2}}};
  std::vector<Point<D>> samples;
  constexpr int parts = D == 2 ? 2000 : 120;
  for (int a = 0; a <= parts; ++a)
    for (int b = 0; b <= (D == 2 ? 0 : parts - a); ++b) {
      Point<D> x{};
      const std::array<double, 3> weight{1 - static_cast<double>(a + b) / parts, static_cast<double>(a) / parts,
                                         static_cast<double>(b) / parts};
      for (int k = 0; k < D; ++k)
        for (int i = 0; i < D; ++i) x[i] += weight[k] * corner[k][i];
      samples.push_back(x);
    }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> between(-1.5, 2.5);
  for (int trial = 0; trial < 60; ++trial) {
    Point<D> x;
    for (double& c : x) c = between(random);
    const Point<D> found = nearest_on_face(corner, x);
    double least = infinity, off = infinity;
    for (const Point<D>& s : samples) {
      least = std::min(least, length<D>(difference<D>(s, x)));
      off = std::min(off, length<D>(difference<D>(s, found)));
    }
    const double distance = length<D>(difference<D>(found, x));
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 0.02);
    EXPECT_LE(off, 0.01);  // it is on the face
    std::array<Point<D>, D> other = corner;
    std::ranges::rotate(other, other.begin() + 1);
    EXPECT_LE(length<D>(difference<D>(nearest_on_face(other, x), found)), 1e-13);
  }
}

TEST(Elements, NearestPointsOfFacesAreNoFartherThanAnyOther) {
  expect_nearest<2>();
  expect_nearest<3>();
}

TEST(Elements, NearestPointsAreFeetInsideAndCornersBeyond) {
  const std::array<Point<3>, 3> face{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(nearest_on_face(face, {0.25, 0.25, -3}), (Point<3>{0.25, 0.25, 0}));
  EXPECT_EQ(nearest_on_face(face, {-1, -2, 1}), (Point<3>{0, 0, 0}));
  EXPECT_EQ(nearest_on_face(face, {0.5, -2, 1}), (Point<3>{0.5, 0, 0}));
  EXPECT_EQ(nearest_on_face(std::array<Point<2>, 2>{{{0, 0}, {2, 0}}}, {3, 1}), (Point<2>{2, 0}));
}

/// Measures of a tube of radii a and b by Pappus.
TEST(Revolution, MeasuresAreThoseOfTheWholeBody) {
  const double a = 0.5, b = 2, h = 3;
  const Mesh<2> mesh = rectangle({a, 0}, {b, h}, {3, 2});
  double volume = 0, by_ring = 0, plane = 0;
  for (const Simplex<2>& element : mesh.elements) {
    const double measure = linear_element(mesh, element).measure;
    volume += measure * mean_circumference<2>(Plane::axisymmetric, mesh, element);
    by_ring += ring_measure<1, 2, 2>(mesh, element);
    plane += measure * mean_circumference<2>(Plane::strain, mesh, element);
  }
  EXPECT_NEAR(volume, pi * (b * b - a * a) * h, 1e-12);
  EXPECT_NEAR(by_ring, volume, 1e-12);
  EXPECT_NEAR(plane, (b - a) * h, 1e-13);
  double surface = 0, rings = 0;
  for (const Face<2>& face : mesh.boundary) {
    surface += length<2>(area_normal(mesh, face)) * mean_circumference<2>(Plane::axisymmetric, mesh, face.vertices);
    rings += ring_measure<1, 2, 1>(mesh, face.vertices);
  }
  EXPECT_NEAR(surface, 2 * pi * (a + b) * h + 2 * pi * (b * b - a * a), 1e-12);
  EXPECT_NEAR(rings, surface, 1e-12);
  EXPECT_DOUBLE_EQ(circumference<2>(Plane::axisymmetric, {a, 7}), 2 * pi * a);
  EXPECT_EQ(circumference<2>(Plane::stress, {a, 7}), 1);
}

// The integral of r times a hat function over a triangle is (2 r_k + the others) / 12 of its area.
TEST(Revolution, HatFunctionsShareTheCircumferenceByTheirOwnRadii) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {2, 0.5}, {0.7, 3}};
  const std::array<Index, 3> corners{0, 1, 2}, other{2, 0, 1};
  const double radius[] = {0, 2, 0.7};
  double sum = 0, shares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double hat = hat_circumference<2>(Plane::axisymmetric, mesh, corners, k);
    EXPECT_NEAR(hat, 2 * pi * (radius[k] + 2.7) / 12, 1e-14);
    EXPECT_DOUBLE_EQ(hat, (hat_circumference<2>(Plane::axisymmetric, mesh, other, (k + 1) % 3)));
    EXPECT_DOUBLE_EQ((hat_circumference<2>(Plane::strain, mesh, corners, k)), 1.0 / 3);
    sum += hat;
    const double share = circumference_share<1, 2, 2>(mesh, corners, k);
    EXPECT_NEAR(share, hat / mean_circumference<2>(Plane::axisymmetric, mesh, corners), 1e-14);
    shares += share;
  }
  EXPECT_NEAR(sum, (mean_circumference<2>(Plane::axisymmetric, mesh, corners)), 1e-14);
  EXPECT_NEAR(shares, 1, 1e-14);
}

TEST(Revolution, QuadraticSharesArePositiveAndSumToOne) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {2, 0.5}, {0.7, 3}, {1, 0.25}, {0.35, 1.5}, {1.35, 1.75}};
  const Family<2> nodes{0, 1, 2, 3, 4, 5};
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double share = circumference_share<2, 2, 2>(mesh, nodes, k);
    EXPECT_GT(share, 0);
    sum += share;
  }
  EXPECT_NEAR(sum, 1, 1e-14);
}

// Arcs of a meridian make a sphere: of fourth order in their length.
TEST(Revolution, QuadraticArcsMakeASphere) {
  const double R = 1.5;
  const auto area = [&](int arcs) {
    Mesh<2> mesh;
    for (int k = 0; k <= 2 * arcs; ++k) {
      const double angle = pi * k / (2 * arcs) - pi / 2;
      mesh.points.push_back({R * std::cos(angle), R * std::sin(angle)});
    }
    double sum = 0;
    for (Index k = 0; k < arcs; ++k) sum += ring_measure<2, 2, 1>(mesh, {2 * k, 2 * k + 2, 2 * k + 1});
    return sum;
  };
  const double exact = 4 * pi * R * R, coarse = area(4) - exact, fine = area(8) - exact;
  EXPECT_LT(std::abs(coarse), 1e-3 * exact);
  EXPECT_GT(std::abs(coarse / fine), 12);
}

// u_r = c r has the hoop strain c everywhere, also next to the axis.
TEST(Revolution, HoopStrainOfASwellingBodyIsUniform) {
  const double c = 0.3;
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {2, 0.5}, {0, 3}, {1, 0.25}, {0, 1.5}, {1, 1.75}};
  const Family<2> nodes{0, 1, 2, 3, 4, 5};
  const std::array<Index, 3> corners{0, 1, 2};
  double mean = 0;
  for (const Index v : corners) mean += c * mesh.points[v][0] / 3;
  EXPECT_NEAR((mean * hoop_factor<2>(Plane::axisymmetric, mesh, corners)), c, 1e-15);
  EXPECT_EQ((hoop_factor<2>(Plane::stress, mesh, corners)), 0);
  const ElementMap<2, 2, 2> map(mesh, nodes);
  for (const auto& [barycentric, weight] : quadrature5<2>()) {
    const auto values = hoop_values<2, 2>(Plane::axisymmetric, map(barycentric), barycentric);
    double strain = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a) strain += values[a] * c * mesh.points[nodes[a]][0];
    EXPECT_NEAR(strain, c, 1e-14);
    EXPECT_EQ((hoop_values<2, 2>(Plane::strain, map(barycentric), barycentric)), (std::array<double, 6>{}));
  }
}

}  // namespace
}  // namespace signorini::testing
