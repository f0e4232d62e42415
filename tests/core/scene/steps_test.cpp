// What of a scene changes from step to step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/reference_point.hpp"
#include "core/scene/uses_t.hpp"
#include "scenes.hpp"

namespace signorini {
namespace {

using test::ball;
using test::parse;
using testing::ElementsAre;

bool changes(const std::vector<std::string>& overrides) {
  const Scene scene = parse(ball, overrides);
  return uses_t(scene, scene.bodies[0]);
}

TEST(UsesT, SeesTWhereverItStands) {
  EXPECT_FALSE(changes({}));
  EXPECT_FALSE(changes({"fix.0.value=[0, 0, 'sin(x)']", "body.0.young='1 + x^2'"})) << "expressions without t";
  for (const char* key :
       {"body.0.young='1 + t'", "body.0.poisson='0.3 * t'", "fix.0.value=[0, 0, '-0.02 * t']",
        "fix.0.where='z > 0.5 * t'", "load.0.value=[0, 't', 0]", "obstacle.0.point=[0, 0, '-1 + t']",
        "obstacle.0.normal=['t', 0, 1]", "obstacle.0.bound='0.1 * t'", "obstacle.0.some_vector=[1, 't']"})
    EXPECT_TRUE(changes({key})) << key;
  EXPECT_FALSE(changes({"obstacle.0.kind='tame'", "obstacle.0.bound=0.1"})) << "a word is no expression";
}

std::array<double, 3> point(const std::vector<std::string>& overrides, double t) {
  return reference_point(parse(ball, overrides).obstacles[0], t);
}

TEST(ReferencePoint, IsThatOfTheShapeAtT) {
  EXPECT_THAT(point({"obstacle.0.point=[0.5, '0.2 * t', -1]"}, 0.5), ElementsAre(0.5, 0.1, -1));
  EXPECT_THAT(point({"obstacle.0.point=['7 + x', 2, -1]"}, 1), ElementsAre(7, 2, -1)) << "at the origin";
  EXPECT_THAT(point({"obstacle.0.point=['log(x)', 2, -1]"}, 1), ElementsAre(0, 0, 0)) << "unknown there";
}

}  // namespace
}  // namespace signorini
