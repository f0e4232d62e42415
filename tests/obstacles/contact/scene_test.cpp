// From the text of a scene to the constraints of its contact obstacle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/component/settings.hpp"
#include "core/scene/rigid_shape.hpp"

namespace signorini {
namespace {

constexpr const char* ball = R"(
[[body]]
name = "ball"
shape = "ball"
center = [0, 0, 0]
radius = 1
size = 0.5
order = 1
young = 1
poisson = 0.3
[[fix]]
body = "ball"
where = "z > 0.5"
value = [0, 0, 0]
[[obstacle]]
type = "contact"
body = "ball"
on = "boundary"
)";

// The constraint of the scene's obstacle at one vertex.
LocalConstraint<3> constraint(const std::string& keys, const SurfaceVertex& vertex) {
  const Scene scene = parse_scene(ball + keys, "scene.toml", ".");
  const Scene::Obstacle& obstacle = scene.obstacles.at(0);
  Registry registry;
  PluginLoader(registry).require(obstacle.type);
  const auto settings =
      compile_settings("obstacle 'contact'", registry.entry("obstacle", "contact").options, obstacle.options,
                       obstacle.core_keys(), rigid_shape(obstacle.shape.value(), 3, 1, obstacle.source.table));
  Status status;
  const std::unique_ptr<Obstacle<3>> contact(registry.obstacle("contact").create3(*settings, status));
  LocalConstraint<3> c;
  if (contact) contact->assemble(&vertex, 1, &c, status);
  if (!status.ok()) throw Error(static_cast<Exit>(status.code), status.message);
  return c;
}

void expect(const LocalConstraint<3>& c, const Point<3>& direction, double lower) {
  EXPECT_EQ(c.directions, 1);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(c.direction[0][k], direction[k], 1e-9) << k;
  EXPECT_NEAR(c.lower[0], lower, 1e-12);
  EXPECT_EQ(c.upper[0], infinity);
}

const SurfaceVertex south = {{0.6, 0, -0.8}, {0.6, 0, -0.8}};

TEST(ContactScene, Plane) {
  expect(constraint("shape = 'plane'\npoint = [7, 0, -1]\nnormal = [0, 0, 3]", south), {0, 0, 1}, -0.2);
}

TEST(ContactScene, Sphere) {
  expect(constraint("shape = 'sphere'\ncenter = [0.6, 0, -3]\nradius = 2", south), {0, 0, 1}, -0.2);
  expect(constraint("shape = 'sphere'\ncenter = [0.6, 0, 0.2]\nradius = 2\ninside = true", south), {0, 0, 1}, -1);
}

TEST(ContactScene, SphereWithTheBodysNormal) {
  expect(constraint("shape = 'sphere'\ncenter = [0.6, 0, -3]\nradius = 2\nnormal = 'body'", south), {-0.6, 0, 0.8},
         -0.2);
}

TEST(ContactScene, Cylinder) {
  expect(constraint("shape = 'cylinder'\ncenter = [0.6, 9, -3]\naxis = [0, 5, 0]\nradius = 2", south), {0, 0, 1}, -0.2);
}

TEST(ContactScene, ExpressionWithItsGradientAsNormal) {
  // Distance to the plane through (0, 0, -1) with normal (0.6, 0, 0.8).
  expect(constraint("shape = 'expression'\ndistance = '0.6 * x + 0.8 * (z + 1)'", south), {0.6, 0, 0.8}, -0.52);
}

TEST(ContactScene, ExpressionWithANormalOrTheBodys) {
  expect(constraint("shape = 'expression'\ndistance = 'z + 1'\nnormal = ['x', 0, 0.8]", south), {0.6, 0, 0.8}, -0.2);
  expect(constraint("shape = 'expression'\ndistance = 'z + 1'\nnormal = 'body'", south), {-0.6, 0, 0.8}, -0.2);
}

TEST(ContactScene, UnknownKeysAndValuesAreErrorsThatNameThePlace) {
  const std::string plane = "shape = 'plane'\npoint = [7, 0, -1]\nnormal = [0, 0, 3]\n";
  const std::string sphere = "shape = 'sphere'\ncenter = [0, 0, -3]\nradius = 2\n";
  const std::vector<std::array<std::string, 2>> faults = {
      {plane + "pont = [0, 0, 0]", "did you mean 'point'?"},
      {plane + "friction = 1", "friction"},
      {sphere + "normal = 'bodi'", "obstacle | body"},
      {"shape = 'expression'\ndistance = 'log(z)'", "log(z)"},
  };
  for (const auto& [keys, found] : faults) {
    try {
      constraint(keys, south);
      ADD_FAILURE() << keys;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::input) << keys;
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("scene.toml:"), testing::HasSubstr(found))) << keys;
    }
  }
}

}  // namespace
}  // namespace signorini
