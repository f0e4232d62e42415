#include "core/fem/elements/probe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What is wrong with a probe, "" if it is found.
template <int D>
std::string complaint(const Mesh<D>& mesh, const Point<D>& x) {
  try {
    locate<D>(mesh, x, "scene.toml:20: probe.0");
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
}

template <int D>
void expect_probe_of_linear_field() {
  const Mesh<D> mesh = distorted_mesh<D>(3);
  const auto linear = [](const Point<D>& x) { return 1 + 2 * x[0] - 3 * x[1] + (D == 3 ? x[D - 1] : 0); };
  std::vector<double> u;
  for (const auto& x : mesh.points) u.push_back(linear(x));
  const auto expect_value = [&](const Point<D>& at, const Point<D>& nearest) {
    EXPECT_NEAR((evaluate<1, D>(mesh, locate<D>(mesh, at, "probe.0"), u)[0]), linear(nearest), 1e-13);
  };
  Point<D> inside;
  inside.fill(0.37);
  inside[0] = 0.61;
  expect_value(inside, inside);
  expect_value(mesh.points[mesh.vertices() / 2], mesh.points[mesh.vertices() / 2]);
  Point<D> rounded = inside, nearest = inside;
  rounded[1] = 1 + 1e-8;
  nearest[1] = 1;
  expect_value(rounded, nearest);
}

TEST(Probe, FindsElementsAroundPoints) {
  expect_probe_of_linear_field<2>();
  expect_probe_of_linear_field<3>();
}

template <int D>
void expect_refused_outside() {
  const Mesh<D> mesh = distorted_mesh<D>(3);
  for (const double away : {1e-4, 0.01, 0.1, 2.0}) {  // cells are a quarter or a third wide
    Point<D> outside;
    outside.fill(0.37);
    outside[1] = 1 + away;
    EXPECT_THAT(complaint<D>(mesh, outside), AllOf(HasSubstr("scene.toml:20: probe.0: point (0.37, "),
                                                   HasSubstr("nearest point of the body is (0.37, 1")));
    outside[0] = 1 + away;  // beside an edge or a corner
    EXPECT_THAT(complaint<D>(mesh, outside), HasSubstr("lies outside the body"));
  }
}

TEST(Probe, OutsideFlatFacesIsRefused) {
  expect_refused_outside<2>();
  expect_refused_outside<3>();
}

/// A regular polygon around the origin, of triangles that meet there; on the unit circle or flat.
Mesh<2> polygon(Index sides, bool curved) {
  Mesh<2> mesh;
  mesh.points.push_back({0, 0});
  for (Index k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    mesh.points.push_back({std::cos(angle), std::sin(angle)});
    mesh.elements.push_back({0, k + 1, (k + 1) % sides + 1});
  }
  mesh.boundary = find_boundary<2>(mesh.vertices(), mesh.elements);
  if (!curved) return mesh;
  mesh.curves = {{.center = {0, 0}, .radius = 1}};
  for (auto& face : mesh.boundary) face.curve = 0;
  return mesh;
}

TEST(Probe, BetweenAFaceAndItsCurveIsFound) {
  for (const bool curved : {true, false})
    for (const Index sides : {6, 16, 100}) {
      const Mesh<2> mesh = polygon(sides, curved);
      const double turn = 2 * std::numbers::pi / sides, h = 2 * std::sin(turn / 2);
      const Point<2> middle{std::cos(turn / 2), std::sin(turn / 2)};
      const Point<2> beyond{(1 + h * h) * middle[0], (1 + h * h) * middle[1]};
      const bool smooth = curved || sides > 12;
      EXPECT_EQ(complaint<2>(mesh, middle).empty(), smooth) << sides;
      EXPECT_THAT(complaint<2>(mesh, beyond), HasSubstr("lies outside the body")) << sides;
    }
}

// Values are those at the point itself, not at the nearest one of a flat face; beyond a shape the distance from it is
// told.
TEST(Probe, BetweenAFaceAndItsCurveReadsThere) {
  const Mesh<2> mesh = polygon(6, true);
  const auto linear = [](const Point<2>& x) { return 1 + 2 * x[0] - 3 * x[1]; };
  std::vector<double> u;
  for (const auto& x : mesh.points) u.push_back(linear(x));
  const double angle = std::numbers::pi / 7;
  for (const double r : {0.9, 1.0, 1 + 1e-4}) {
    const Point<2> x{r * std::cos(angle), r * std::sin(angle)};
    EXPECT_NEAR((evaluate<1, 2>(mesh, locate<2>(mesh, x, ""), u)[0]), linear(x), 1e-13) << r;
  }
  EXPECT_THAT(complaint<2>(mesh, {1.03 * std::cos(angle), 1.03 * std::sin(angle)}),
              AllOf(HasSubstr("lies outside the body"), HasSubstr("0.03 away")));
}

}  // namespace
}  // namespace signorini::testing
